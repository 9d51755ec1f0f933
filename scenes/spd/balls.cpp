// balls, the sphereflake (Haines 1987)
//
// Purpose    Objects of widely varying size that touch one another, over a floor much larger than they are.
// Size       sum of 9^k spheres for k = 0 to size, and one floor polygon: 1 → 11, 2 → 92, 3 → 821, 4 → 7382,
//            5 → 66431.

#include <cmath>

#include "scenes/spd/database.h"

namespace rayshoot {

namespace {

/// The nine directions in which a sphere aligned with +z grows children: a trio, three times around the axis.
std::array<Vec3d, 9> child_directions() {
  const double q = std::numbers::sqrt2 / 2;
  const Affine tilt = rotation({q, -q, 0}, std::asin(2 / std::sqrt(6.0)));
  const Vec3d trio[] = {{q, q, 0}, {q, 0, -q}, {0, q, -q}};
  std::array<Vec3d, 9> directions;
  for (int turn = 0; turn < 3; ++turn)
    for (int k = 0; k < 3; ++k)
      directions[3 * turn + k] = rotation({0, 0, 1}, turn * 2 * spd::kPi / 3)(tilt(trio[k]));
  return directions;
}

/// The rotation that carries +z to the unit vector d.
Affine align_z_with(const Vec3d& d) {
  if (d.z >= 0.9999) return {};
  if (d.z <= -0.9999) return rotation({0, 1, 0}, spd::kPi);
  return rotation(normalized(Vec3d{-d.y, d.x, 0}), std::acos(d.z));
}

void grow(SceneBuilder& builder, const std::array<Vec3d, 9>& directions, const Vec3d& centre, double radius,
          const Vec3d& axis, int depth) {
  const auto sphere_with_children = builder.group();
  builder.sphere(centre, radius);
  if (depth == 0) return;
  const Affine align = align_z_with(axis);
  for (const Vec3d& direction : directions) {
    const Vec3d child_axis = align(direction);
    grow(builder, directions, centre + child_axis * (radius * 4 / 3), radius / 3, child_axis, depth - 1);
  }
}

void generate(const SceneOptions& options, const Arguments&, SceneBuilder& builder) {
  spd::open(builder, {.from = {2.1, 1.3, 1.7}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle = 45, .hither = 0.01},
            {{4, 3, 2}, {1, -4, 4}, {-3, 1, 5}});
  builder.material({{1, 0.75, 0.33}, 0.8, 0, spd::kNoHighlight, 0, 1});
  builder.polygon(
      std::array{Vec3d{12, 12, -0.5}, Vec3d{-12, 12, -0.5}, Vec3d{-12, -12, -0.5}, Vec3d{12, -12, -0.5}});
  builder.material({{1, 0.9, 0.7}, 0.5, 0.5, shine_from_highlight_angle(37), 0, 1});
  grow(builder, child_directions(), {0, 0, 0}, 0.5, {0, 0, 1}, options.size);
}

double object_count(const SceneOptions& options, const Arguments&) {
  const double spheres = (std::pow(9, options.size + 1) - 1) / 8;
  return 1 + spheres * patches_of_sphere(options);
}

}  // namespace

const SceneGenerator& scene_balls() {
  static const SceneGenerator generator{.id = "balls",
                                        .title = "Sphereflake",
                                        .source = spd::kPaper,
                                        .default_size = 4,
                                        .min_size = 1,
                                        .purpose =
                                            "touching spheres of widely varying size over a large floor; "
                                            "1 + sum of 9^k spheres",
                                        .parameters = {},
                                        .object_count = object_count,
                                        .generate = generate};
  return generator;
}

}  // namespace rayshoot
