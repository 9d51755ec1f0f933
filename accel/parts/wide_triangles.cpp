#include "accel/parts/wide_triangles.h"

#include <tbb/concurrent_vector.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace rayshoot {

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

}  // namespace

WideTriangles::WideTriangles(const Geometry<float>& geometry, std::span<const std::uint32_t> order,
                             const WideTree<float>& tree)
    : rows_(kRows * order.size() + kWideWidth) {
  tbb::concurrent_vector<WideChild> with_others;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tree.nodes.size(), 64), [&](const auto& part) {
    for (std::size_t node = part.begin(); node < part.end(); ++node)
      tree.nodes[node].for_each_leaf([&](std::uint32_t, WideChild leaf) {
        if (fill(geometry, order, leaf)) with_others.push_back(leaf);
      });
  });
  // What a kernel reads beyond the last leaf.
  std::fill_n(rows_.data() + kRows * order.size(), kWideWidth, kNaN);

  std::sort(with_others.begin(), with_others.end(),
            [](WideChild a, WideChild b) { return a.first() < b.first(); });
  has_others_ = !with_others.empty();
  for (const WideChild leaf : with_others) add_others(geometry, order, leaf);
}

/// Lay out the triangles of a leaf; whether it holds anything else.
bool WideTriangles::fill(const Geometry<float>& geometry, std::span<const std::uint32_t> order,
                         WideChild leaf) {
  const std::uint32_t count = leaf.count();
  float* const rows = rows_.data() + std::size_t{kRows} * leaf.first();
  bool others = false;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t object = order[leaf.first() + i];
    const bool is_triangle = geometry.kind(object) == ObjectKind::triangle;
    others |= !is_triangle;
    const Triangle<float> triangle =
        is_triangle ? geometry.triangle(object) : Triangle<float>{{kNaN, kNaN, kNaN}, {}, {}};
    const Vec3<float> corners[3] = {triangle.a, triangle.b, triangle.c};
    for (std::uint32_t row = 0; row < 9; ++row)
      rows[row * count + i] = corners[row / 3][static_cast<int>(row % 3)];
    rows[9 * count + i] = WideOthers::as_float(object);
  }
  return others;
}

void WideTriangles::add_others(const Geometry<float>& geometry, std::span<const std::uint32_t> order,
                               WideChild leaf) {
  const float number = WideOthers::as_float(others_.add(geometry, order, leaf));
  float* const rows = rows_.data() + std::size_t{kRows} * leaf.first();
  for (std::uint32_t i = 0; i < leaf.count(); ++i)
    if (std::isnan(rows[i])) rows[leaf.count() + i] = number;
}

}  // namespace rayshoot
