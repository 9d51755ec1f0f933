#pragma once

#include "accel/parts/wide_tree.h"

namespace rayshoot {

/// The triangles of the leaves of a wide tree. A leaf of n objects has ten rows of n numbers: the coordinates of all first
/// corners along x, y and z, of all second and third corners, and what the objects are called. What is no triangle has
/// corners that are not numbers.
class WideTriangles {
 public:
  static constexpr std::uint32_t kRows = 10;
  /// For each object.
  static constexpr std::size_t kBytes = kRows * sizeof(float);

  WideTriangles() = default;
  WideTriangles(const Geometry<float>& geometry, std::span<const std::uint32_t> order,
                const WideTree<float>& tree);

  const float* leaf(WideChild leaf) const { return rows_.data() + std::size_t{kRows} * leaf.first(); }
  const char* begin() const { return reinterpret_cast<const char*>(rows_.data()); }
  /// Whether some objects are no triangles.
  bool has_others() const { return has_others_; }
  std::size_t bytes() const { return rows_.size() * sizeof(float); }

 private:
  HugeVector<float> rows_;
  bool has_others_ = false;
};

}  // namespace rayshoot
