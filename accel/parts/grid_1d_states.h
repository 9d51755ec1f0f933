#pragma once

#include <algorithm>
#include <cstdint>
#include <unordered_map>

#include "scenes/geometry/box.h"

namespace rayshoot {

/// The table of traversal states of Jevans (1990, §4.1): voxels subdivided along the same axis at the same absolute
/// granularity share one. A state is a number here, by which every thread finds the variables of its own ray.
class TraversalStateTable {
 public:
  /// The state of that axis and absolute granularity, created when it is asked for first.
  std::uint32_t find(int axis, std::uint64_t absolute_granularity) {
    const auto next = static_cast<std::uint32_t>(states_[0].size() + states_[1].size() + states_[2].size());
    return states_[axis].try_emplace(absolute_granularity, next).first->second;
  }
  std::uint32_t created() const {
    return static_cast<std::uint32_t>(states_[0].size() + states_[1].size() + states_[2].size());
  }
  std::size_t bytes() const { return created() * (sizeof(std::uint64_t) + sizeof(std::uint32_t) + 24); }

 private:
  /// Granularities have no limit but that of coordinates, so the tables are hashed.
  std::unordered_map<std::uint64_t, std::uint32_t> states_[3];
};

/// Plane k of the subdivision of a box at an absolute granularity, 0 <= k <= granularity <= 2^52. The quotient is
/// rounded once, so a plane has the same position to the last bit at whatever granularity it is asked for: a voxel's
/// borders are planes of its parent and of its own subdivision alike. Positions never decrease with k.
template <class Real>
Real subdivision_plane(const Box<Real>& box, int axis, std::uint64_t k, std::uint64_t absolute_granularity) {
  if (k == absolute_granularity) return box.hi[axis];
  const double lo = box.lo[axis], hi = box.hi[axis];
  const double part = static_cast<double>(k) / static_cast<double>(absolute_granularity);
  return static_cast<Real>(std::min(lo + (hi - lo) * part, hi));
}

}  // namespace rayshoot
