#pragma once

#include "accel/parts/pair_tree.h"
#include "accel/parts/sah_split.h"

namespace rayshoot {

/// Lower the expected cost (equation (3)) of a binary hierarchy: take subtrees out, each in turn, and put them where they cost
/// least (J. Bittner, M. Hapala & V. Havran, "Fast insertion-based optimization of bounding volume hierarchies", 2013; places
/// are sought in parallel after D. Meister & J. Bittner, "Parallel reinsertion for bounding volume hierarchy optimization",
/// 2018). Leaves stay together; `objects` are reordered as the new tree's leaves name them. The tree is the same
/// however many threads there are.
template <class Real>
PairTree<Real> reinserted(const PairTree<Real>& tree, std::span<BoxedObject<Real>> objects);

}  // namespace rayshoot
