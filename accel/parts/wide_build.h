#pragma once

#include "accel/parts/sah_build.h"
#include "accel/parts/wide_tree.h"

namespace rayshoot {

/// What the builder of wide trees weighs.
struct WideCosts {
  /// Cost of one test in a leaf, in units of the test of a node's children.
  double leaf = 1;
  /// Objects that one such test decides.
  std::uint32_t objects_at_once = kWideWidth;
  std::uint32_t max_objects = kWideWidth;

  double of_leaf(std::uint32_t count) const {
    return leaf * static_cast<double>((count + objects_at_once - 1) / objects_at_once);
  }
};

/// The wide tree of least expected cost (equation (3)) that can be made of a binary tree by leaving out nodes and by
/// turning small subtrees into leaves.
template <class Real>
WideTree<Real> widened_tree(const PairTree<Real>& binary, const WideCosts& costs);

}  // namespace rayshoot
