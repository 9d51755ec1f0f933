#include "accel/parts/wide_triangles.h"

#include <bit>

namespace rayshoot {

WideTriangles::WideTriangles(const Geometry<float>& geometry, std::span<const std::uint32_t> order,
                             const WideTree<float>& tree)
    : rows_(kRows * order.size() + kWideWidth) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const auto fill = [&](std::uint32_t first, std::uint32_t count) {
    float* const rows = rows_.data() + std::size_t{kRows} * first;
    bool others = false;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t object = order[first + i];
      const bool is_triangle = geometry.kind(object) == ObjectKind::triangle;
      others |= !is_triangle;
      const Triangle<float> triangle =
          is_triangle ? geometry.triangle(object) : Triangle<float>{{nan, nan, nan}, {}, {}};
      const Vec3<float> corners[3] = {triangle.a, triangle.b, triangle.c};
      for (std::uint32_t row = 0; row < 9; ++row)
        rows[row * count + i] = corners[row / 3][static_cast<int>(row % 3)];
      rows[9 * count + i] = std::bit_cast<float>(object);
    }
    return others;
  };
  tree.for_each_leaf(
      [&](const Box<float>&, WideChild leaf) { has_others_ |= fill(leaf.first(), leaf.count()); });
}

}  // namespace rayshoot
