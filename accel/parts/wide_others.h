#pragma once

#include <bit>
#include <vector>

#include "accel/parts/wide_tree.h"

namespace rayshoot {

/// Polygons of four corners side by side: of each number that a test needs a row of `count`.
struct WideQuads {
  /// The first rows of the bounds' lower and upper planes and the first corner, along x, y and z; of the corners across the
  /// axis that the polygon is projected along, two for each; and of what the polygons are called.
  static constexpr std::uint32_t kLow = 0, kHigh = 3, kCorner = 6, kProjected = 9, kName = 17, kRows = 18;

  std::uint32_t count;
  const float* rows;
  /// Along x, y and z.
  const double* normals;
  /// One bit for each that is projected along x, and along y.
  unsigned along_x, along_y;

  const float* names() const { return rows + kName * count; }
};

/// What the leaves of a wide tree hold beside triangles: polygons of four corners, and a list of what is left.
class WideOthers {
 public:
  /// A number up to WideChild::kMostObjects among floats: one that no operation stumbles over, as it may over denormal ones.
  static float as_float(std::uint32_t number) { return std::bit_cast<float>(number | kExponent); }
  static std::uint32_t as_number(float number) { return std::bit_cast<std::uint32_t>(number) & ~kExponent; }

  /// Of a leaf that holds several such polygons.
  struct Leaf {
    std::uint32_t first_quad, quads;
    /// One bit for each polygon that is projected along x, and along y.
    std::uint8_t along_x, along_y;
    /// One bit for each object of the leaf that is neither a triangle nor one of the polygons.
    std::uint8_t loose;
  };

  /// Add what leaf holds beside triangles, given as places in the order; its number.
  std::uint32_t add(const Geometry<float>& geometry, std::span<const std::uint32_t> order, WideChild leaf);
  /// None where all that is no triangle is tested one by one.
  const Leaf* leaf(std::uint32_t number) const { return number == kNone ? nullptr : &leaves_[number]; }
  WideQuads quads(const Leaf& of) const {
    return {of.quads, rows_.data() + std::size_t{WideQuads::kRows} * of.first_quad,
            normals_.data() + std::size_t{3} * of.first_quad, of.along_x, of.along_y};
  }
  std::size_t bytes() const {
    return rows_.size() * sizeof(float) + normals_.size() * sizeof(double) + leaves_.size() * sizeof(Leaf);
  }

 private:
  static constexpr std::uint32_t kExponent = 1u << 30;

  static constexpr std::uint32_t kNone = WideChild::kMostObjects;

  void add_quad(const Geometry<float>& geometry, std::uint32_t object, std::uint32_t which, Leaf& leaf);

  std::vector<Leaf> leaves_;
  /// Of the polygons of all leaves; behind the last there is room for what a kernel reads beyond it.
  std::vector<float> rows_;
  std::vector<double> normals_;
  std::uint32_t quads_ = 0;
};

}  // namespace rayshoot
