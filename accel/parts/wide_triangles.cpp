#include "accel/parts/wide_triangles.h"

#include <tbb/parallel_for.h>

#include <atomic>
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
  std::atomic<bool> has_others = false;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tree.nodes.size(), 64), [&](const auto& part) {
    bool others = false;
    for (std::size_t node = part.begin(); node < part.end(); ++node)
      tree.nodes[node].for_each_leaf(
          [&](std::uint32_t, WideChild leaf) { others |= fill(leaf.first(), leaf.count()); });
    if (others) has_others = true;
  });
  has_others_ = has_others;
  // What a kernel reads beyond the last leaf.
  std::fill_n(rows_.data() + kRows * order.size(), kWideWidth, nan);
}

}  // namespace rayshoot
