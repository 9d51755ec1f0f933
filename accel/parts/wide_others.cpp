#include "accel/parts/wide_others.h"

namespace rayshoot {

namespace {

/// Fewer polygons are tested faster one by one.
constexpr std::uint32_t kWorthwhile = 3;

}  // namespace

std::uint32_t WideOthers::add(const Geometry<float>& geometry, std::span<const std::uint32_t> order,
                              WideChild leaf) {
  Leaf added{.first_quad = quads_};
  std::uint32_t quads[kWideWidth];
  unsigned others = 0, at_once = 0;
  for (std::uint32_t i = 0; i < leaf.count(); ++i) {
    const std::uint32_t object = order[leaf.first() + i];
    if (geometry.kind(object) == ObjectKind::triangle) continue;
    others |= 1u << i;
    if (geometry.kind(object) == ObjectKind::polygon && geometry.polygon(object).vertex_count == 4)
      quads[added.quads++] = object, at_once |= 1u << i;
  }
  if (added.quads < kWorthwhile) return kNone;
  added.loose = static_cast<std::uint8_t>(others & ~at_once);

  quads_ += added.quads;
  rows_.resize(std::size_t{WideQuads::kRows} * quads_ + kWideWidth);
  normals_.resize(std::size_t{3} * quads_ + kWideWidth);
  for (std::uint32_t i = 0; i < added.quads; ++i) add_quad(geometry, quads[i], i, added);
  leaves_.push_back(added);
  return static_cast<std::uint32_t>(leaves_.size() - 1);
}

void WideOthers::add_quad(const Geometry<float>& geometry, std::uint32_t object, std::uint32_t which,
                          Leaf& leaf) {
  const Polygon<float>& polygon = geometry.polygon(object);
  const auto corners = geometry.polygon_vertices(object);
  float* const rows = rows_.data() + std::size_t{WideQuads::kRows} * leaf.first_quad;
  const auto set = [&](std::uint32_t row, float value) { rows[row * leaf.quads + which] = value; };
  for (int axis = 0; axis < 3; ++axis) {
    const auto row = static_cast<std::uint32_t>(axis);
    set(WideQuads::kLow + row, polygon.box.lo[axis]);
    set(WideQuads::kHigh + row, polygon.box.hi[axis]);
    set(WideQuads::kCorner + row, corners[0][axis]);
    normals_[std::size_t{3} * leaf.first_quad + row * leaf.quads + which] = polygon.normal[axis];
  }
  for (std::uint32_t corner = 0; corner < 4; ++corner)
    for (int side = 0; side < 2; ++side)
      set(WideQuads::kProjected + 2 * corner + static_cast<std::uint32_t>(side),
          corners[corner][(polygon.dropped_axis + 1 + side) % 3]);
  set(WideQuads::kName, as_float(object));
  if (polygon.dropped_axis == 0) leaf.along_x |= static_cast<std::uint8_t>(1u << which);
  if (polygon.dropped_axis == 1) leaf.along_y |= static_cast<std::uint8_t>(1u << which);
}

}  // namespace rayshoot
