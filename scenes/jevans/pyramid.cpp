// pyramid, a recursive tetrahedral pyramid (after Jevans 1990)
//
// Purpose    The control of Jevans' five scenes: few polygons of one size, evenly spread, the whole scene in view, so
//            that no subdivision technique has an edge. He calls it "similar to that seen in previous papers".
// Idea       A tetrahedron standing on the ground is replaced by four of half the size at its corners; the centre
//            stays empty. Unlike tetra, of which it is a turned copy, it stands upright.
// Size       4^size triangles: 4 → 256, 6 → 4096 (default, Jevans' number), 8 → 65536.

#include <array>

#include "scenes/core/registry.h"
#include "scenes/jevans/sculptor.h"

namespace rayshoot {

namespace {

using Corners = std::array<Vec3d, 4>;

/// A regular tetrahedron of height 1 on the ground, its apex above the origin.
Corners standing_tetrahedron() {
  Corners corners;
  const double radius = std::numbers::sqrt2 / 2;
  for (int k = 0; k < 3; ++k) corners[static_cast<std::size_t>(k)] = jevans::on_circle(k / 3.0) * radius;
  corners[3] = {0, 0, 1};
  return corners;
}

void divide(SceneBuilder& builder, const Corners& corners, int level) {
  const auto pyramid = builder.group();
  const auto& [a, b, c, apex] = corners;
  if (level == 1) {
    builder.triangle(a, c, b);
    builder.triangle(a, b, apex);
    builder.triangle(b, c, apex);
    builder.triangle(c, a, apex);
    return;
  }
  for (const Vec3d& kept : corners) {
    Corners smaller;
    for (std::size_t k = 0; k < 4; ++k) smaller[k] = (corners[k] + kept) * 0.5;
    divide(builder, smaller, level - 1);
  }
}

void generate(const SceneOptions& options, const Arguments&, SceneBuilder& builder) {
  builder.background({0.55, 0.7, 0.9});
  builder.view(
      {.from = {2.2, -2.5, 1.3}, .at = {0.1, -0.05, 0.42}, .up = {0, 0, 1}, .angle = 25, .hither = 0.01});
  builder.light({3, -4, 5});
  builder.light({6, 3, 2});
  builder.material({{0.95, 0.75, 0.4}, 0.9, 0, 100000, 0, 1});
  divide(builder, standing_tetrahedron(), options.size);
}

}  // namespace

const SceneGenerator& scene_pyramid() {
  static const SceneGenerator generator{
      .id = "pyramid",
      .title = "Recursive pyramid",
      .source = jevans::kPaper,
      .default_size = 6,
      .min_size = 1,
      .purpose = "few triangles of one size, evenly spread and all in view; 4^size triangles",
      .parameters = {},
      .object_count = [](const SceneOptions& options, const Arguments&) { return std::pow(4, options.size); },
      .generate = generate};
  return generator;
}

}  // namespace rayshoot
