// rings, a pyramid of dodecahedra made of rings (Haines 1987)
//
// Purpose    Cylinders and spheres in equal numbers that overlap at every joint, in loose clusters before a
//            wall.
// Size       n = 5 size (size+1) (2 size+1) spheres and as many cylinders, and one polygon: 1 → 61, 3 → 841,
//            7 → 8401 (default), 9 → 17101.

#include <cmath>

#include "scenes/spd/database.h"

namespace rayshoot {

namespace {

/// Radius of the tubes; it is the same at every size.
constexpr double kTube = 0.07412;
constexpr int kRings = 6, kCorners = 5;

/// One pentagonal ring lies flat, the five others lean against it: the corners of all six, ring by ring.
std::array<Vec3d, kRings * kCorners> cluster() {
  std::array<Vec3d, kRings * kCorners> points;
  for (int k = 0; k < kCorners; ++k) {
    const double angle = spd::radians(72.0 * k);
    points[k] = Vec3d{std::cos(angle), std::sin(angle), 0} * (1 / (1 + kTube));
  }
  const double lean = 2 * std::acos(std::cos(spd::kPi / 3) / std::sin(spd::kPi / 5));
  for (int ring = 1; ring < kRings; ++ring) {
    const Affine place =
        compose(rotation({0, 0, 1}, spd::kPi * (2 * ring - 1) / 5), rotation({1, 0, 0}, lean));
    for (int k = 0; k < kCorners; ++k) points[kCorners * ring + k] = place(points[k]);
  }
  return points;
}

void emit(SceneBuilder& builder, const std::array<Vec3d, kRings * kCorners>& points, const Vec3d& offset) {
  const auto whole_cluster = builder.group();
  const Vec3d colours[kRings] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}, {1, 1, 0}};
  for (int ring = 0; ring < kRings; ++ring) {
    const auto whole_ring = builder.group();
    builder.material({colours[ring], 0.5, 0.2, shine_from_highlight_angle(37), 0, 0});
    for (int k = 0; k < kCorners; ++k) {
      const int previous = (k + kCorners - 1) % kCorners;
      const Vec3d corner = points[kCorners * ring + k] + offset;
      builder.cone(corner, kTube, points[kCorners * ring + previous] + offset, kTube);
      builder.sphere(corner, kTube);
    }
  }
}

void generate(const SceneOptions& options, const Arguments&, SceneBuilder& builder) {
  const double spacing = 1 / std::sin(spd::kPi / 8);
  spd::open(
      builder,
      {.from = {-1, -spacing, 0.5}, .at = {-1, 1 - spacing, 0.5}, .up = {0, 0, 1}, .angle = 45, .hither = 1},
      {{3, -spacing, 3}, {-4, -spacing, 1}, {2, -spacing, -4}});

  // The wall behind the clusters fills the field of view.
  builder.material({{1, 1, 1}, 1, 0, spd::kNoHighlight, 0, 0});
  const double y = spacing * (options.size + 1);
  const double w = 1.01 * (y + spacing) * std::tan(spd::kPi / 8);
  builder.polygon(std::array{Vec3d{w - 1, y, w + 0.5}, Vec3d{-w - 1, y, w + 0.5}, Vec3d{-w - 1, y, -w + 0.5},
                             Vec3d{w - 1, y, -w + 0.5}});

  // The clusters form a square pyramid with its apex towards the eye.
  const auto points = cluster();
  for (int depth = 0; depth < options.size; ++depth) {
    const auto layer = builder.group();
    for (int kz = 0; kz <= depth; ++kz) {
      const auto row = builder.group();
      for (int kx = 0; kx <= depth; ++kx)
        emit(builder, points, {2.0 * kx - depth, spacing * (depth + 1), 2.0 * kz - depth});
    }
  }
}

double object_count(const SceneOptions& options, const Arguments&) {
  const double s = options.size;
  return 1 + 5 * s * (s + 1) * (2 * s + 1) * (patches_of_sphere(options) + patches_of_cone(options));
}

}  // namespace

const SceneGenerator& scene_rings() {
  static const SceneGenerator generator{.id = "rings",
                                        .title = "Pyramid of ring clusters",
                                        .source = spd::kPaper,
                                        .default_size = 7,
                                        .min_size = 1,
                                        .purpose =
                                            "cylinders and spheres that overlap at every joint, in loose "
                                            "clusters; 1 + 10 size (size+1) (2 size+1)",
                                        .parameters = {},
                                        .object_count = object_count,
                                        .generate = generate};
  return generator;
}

}  // namespace rayshoot
