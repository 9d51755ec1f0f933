#pragma once

#include "accel/parts/wide_others.h"

namespace rayshoot {

/// The triangles of the leaves of a wide tree. A leaf of n objects has ten rows of n numbers: the coordinates of all first
/// corners along x, y and z, of all second and third corners, and what the objects are called. What is no triangle has
/// a first corner that is no number along x, and along y stands where those of its leaf are found.
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
  /// Of a leaf with objects that are no triangles, one bit for each: those that are tested at once, if any are.
  const WideOthers::Leaf* others(WideChild which, unsigned bits) const {
    const auto one = static_cast<std::uint32_t>(std::countr_zero(bits));
    return others_.leaf(WideOthers::as_number(leaf(which)[which.count() + one]));
  }
  WideQuads quads(const WideOthers::Leaf& of) const { return others_.quads(of); }
  std::size_t bytes() const { return rows_.size() * sizeof(float) + others_.bytes(); }

 private:
  bool fill(const Geometry<float>& geometry, std::span<const std::uint32_t> order, WideChild leaf);
  void add_others(const Geometry<float>& geometry, std::span<const std::uint32_t> order, WideChild leaf);

  HugeVector<float> rows_;
  bool has_others_ = false;
  WideOthers others_;
};

}  // namespace rayshoot
