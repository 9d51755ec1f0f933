#pragma once

#include "accel/core/technique.h"
#include "accel/parts/pair_tree.h"
#include "accel/parts/sah_split.h"

namespace rayshoot {

/// How a hierarchy of boxes is built: between bins of centres; so over clusters of objects, which become leaves;
/// by trying every split; or between bins, and then subtrees are moved to where they cost less.
enum class SahMethod { binned, fast, sweep, quality };

/// Parameters of the build; bvh_sah's manual page explains them.
struct SahConfig {
  SahMethod method = SahMethod::binned;
  std::size_t max_objects = 4;
  double traversal_cost = 1;
};

/// The parameter `build` of the techniques that are built so, and what it says.
Parameter sah_method_parameter();
SahMethod sah_method(const Arguments& arguments);

/// The objects of a geometry with their bounds.
template <class Real>
HugeVector<BoxedObject<Real>> boxed_objects(const Geometry<Real>& geometry);

/// What the boxed objects are called, one after the other.
template <class Real>
std::vector<std::uint32_t> names_of(std::span<const BoxedObject<Real>> objects);

/// The tree over boxed objects, which are reordered as its leaves name them. It is the same however many threads there are.
template <class Real>
PairTree<Real> sah_tree(std::span<BoxedObject<Real>> objects, const SahConfig& config);

}  // namespace rayshoot
