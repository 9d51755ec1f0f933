// signed_zero, STIFF 23: zeros with a sign
//
// Construction  Boxes and octahedra with faces, edges and corners in the coordinate planes; rays along axes
//               and in coordinate planes, in all 18 directions with one or two zeros, with coordinates of
//               origins zero as well. All zeros are positive in the base; the other settings turn the signs
//               of those in directions, origins, vertices, or all.
// Property      The same object at the same distance.
// Metric        Rate of changed answers.
// Size          The same settings at every size.
// Anchor        A -0 in the direction made madmann91's bvh lose hits (#20) and tinybvh read slabs in the
//               wrong order (#282).

#include <array>

#include "scenes/stiff/parts/scenes.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

constexpr double kLattice = 0x1p-6;

/// +0 for either zero, or -0.
Vec3d with_zeros(const Vec3d& p, bool negative) {
  const auto zero = [&](double x) { return x == 0 ? (negative ? -0.0 : 0.0) : x; };
  return {zero(p.x), zero(p.y), zero(p.z)};
}

std::shared_ptr<const Scene> blocks(bool negative, std::uint64_t seed, const std::string& label) {
  const RandomNumbers random(seed);
  SceneBuilder builder;
  for (int octant = 0; octant < 8; ++octant) {
    const Vec3d signs{octant & 1 ? 1.0 : -1.0, octant & 2 ? 1.0 : -1.0, octant & 4 ? 1.0 : -1.0};
    const Vec3d size = snapped(point_in_cube(random, static_cast<std::uint64_t>(octant), 0) * 0.25, kLattice);
    const Vec3d far{signs.x * (0.5 + size.x), signs.y * (0.5 + size.y), signs.z * (0.5 + size.z)};
    add_box(builder, min(far, Vec3d{}), max(far, Vec3d{}));
    builder.triangle({2 * signs.x, 0, 0}, {0, 2 * signs.y, 0}, {0, 0, 2 * signs.z});
  }
  Scene scene = std::move(builder).finish();
  for (auto& [a, b, c] : scene.triangles)
    a = with_zeros(a, negative), b = with_zeros(b, negative), c = with_zeros(c, negative);
  return share(std::move(scene), "signed_zero(" + label + ")");
}

Ray<double> ray_with_zeros(bool in_origin, bool in_direction, const RandomNumbers& random,
                           std::uint64_t number) {
  const int zeros = pick(random, number, 0, 1, 2), first = pick(random, number, 1, 0, 2);
  Vec3d direction = snapped(point_in_cube(random, number, 2), kLattice);
  for (int axis = 0; axis < 3; ++axis)
    if (direction[axis] == 0) direction[axis] = kLattice;
  for (int i = 0; i < zeros; ++i) direction[(first + i) % 3] = 0;
  Vec3d origin = snapped(point_in_cube(random, number, 5) * 3, kLattice);
  for (int axis = 0; axis < 3; ++axis)
    if (pick(random, number, 8 + static_cast<std::uint64_t>(axis), 0, 1) == 0) origin[axis] = 0;
  return {.origin = with_zeros(origin, in_origin), .direction = with_zeros(direction, in_direction)};
}

std::vector<StiffSetting> settings(int, std::uint64_t seed) {
  struct Signs {
    const char* label;
    bool origin, direction, vertices;
  };
  constexpr std::array kSigns = {
      Signs{"negative=none", false, false, false}, Signs{"negative=directions", false, true, false},
      Signs{"negative=origins", true, false, false}, Signs{"negative=vertices", false, false, true},
      Signs{"negative=all", true, true, true}};
  std::vector<StiffSetting> result;
  for (const auto& [label, in_origin, in_direction, in_vertices] : kSigns)
    result.push_back({.label = label,
                      .scene = blocks(in_vertices, seed, label),
                      .rays = ray_by_ray([o = in_origin, d = in_direction](const RandomNumbers& random,
                                                                           std::uint64_t number) {
                        return ray_with_zeros(o, d, random, number);
                      }),
                      .property = result.empty() ? Property::as_oracle : Property::same_as_base,
                      .base = 0,
                      .stiffness_parameter = static_cast<double>(result.size()),
                      .default_rays = 1000});
  return result;
}

}  // namespace

const StiffCase& stiff_signed_zero() {
  static const StiffCase entry{.id = "signed_zero",
                               .number = 23,
                               .title = "Zeros with a sign",
                               .construction =
                                   "-0 in place of +0 in origins, directions or vertices; every octant with "
                                   "one and two zero components",
                               .property = "the same as with +0",
                               .metric = "rate of changed answers",
                               .settings = settings};
  return entry;
}

}  // namespace rayshoot
