// degenerate, STIFF 22: scenes that hardly exist
//
// Construction  Scenes of so few objects that structures have nothing to split; scenes of nothing but objects
//               without area, in a line or in a point; good triangles among such and among duplicates of
//               themselves; a scene in one plane, whose box has no volume; rays without a direction.
// Property      Scenes without area and rays without direction: no hit. The others: graded by the oracle.
// Metric        Pass or fail; best run under the address and undefined-behaviour sanitizers.
// Size          The same settings at every size.
// Anchor        Embree builds empty and degenerate scenes in its tests, and shoots no ray.

#include <fmt/format.h>

#include <array>

#include "scenes/stiff/parts/scenes.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

constexpr double kLattice = 0x1p-20;

Scene good_triangles(int count, std::uint64_t seed) {
  SceneBuilder builder;
  add_scattered(builder, {.triangles = count}, RandomNumbers(seed), 0.5, kLattice);
  return std::move(builder).finish();
}

/// Triangles, polygons, spheres and cones without area; in a line along the diagonal.
void add_nothings(SceneBuilder& builder, int count) {
  const Vec3d step = Vec3d{1, 1, 1} * 0x1p-6;
  for (int i = 0; i < count; ++i) {
    const Vec3d p = step * i;
    builder.triangle(p, p, p);
    builder.triangle(p, p + step, p + step * 2);
    builder.triangle(p, p + step, p);
    builder.polygon(std::array{p, p + step, p + step * 2, p + step});
    builder.polygon(std::array{p, p + step});
    builder.sphere(p, 0);
    builder.cone(p, 0, p + step, 0);
    builder.cone(p, 0.5, p, 0.5);
  }
}

Scene nothings(int count) {
  SceneBuilder builder;
  add_nothings(builder, count);
  return std::move(builder).finish();
}

/// Every triangle twice, with its corners in another order the second time, and nothings between.
Scene duplicates(std::uint64_t seed) {
  SceneBuilder builder;
  for (const auto& [a, b, c] : good_triangles(40, seed).triangles) {
    builder.triangle(a, b, c);
    builder.triangle(a, b, b);
    builder.triangle(b, c, a);
  }
  add_nothings(builder, 10);
  return std::move(builder).finish();
}

Scene flat(std::uint64_t seed) {
  SceneBuilder builder;
  const auto dropped = [](Vec3d p) {
    p.z = 0.25;
    return p;
  };
  for (const auto& [a, b, c] : good_triangles(80, seed).triangles)
    builder.triangle(dropped(a), dropped(b), dropped(c));
  return std::move(builder).finish();
}

Ray<double> any_ray(const RandomNumbers& random, std::uint64_t number) {
  return ray_to(snapped(point_in_cube(random, number, 0) * 2, kLattice),
                snapped(point_in_cube(random, number, 3), kLattice));
}

/// Straight down onto a flat scene, or within its plane.
Ray<double> flat_ray(const RandomNumbers& random, std::uint64_t number) {
  Ray<double> ray = any_ray(random, number);
  if (number % 3 == 1) ray.direction = {0, 0, ray.origin.z > 0.25 ? -1.0 : 1.0};
  if (number % 3 == 2) ray.origin.z = 0.25, ray.direction.z = 0;
  return ray;
}

Ray<double> pointless_ray(const RandomNumbers& random, std::uint64_t number) {
  return {.origin = snapped(point_in_cube(random, number, 0), kLattice), .direction = {0, 0, 0}};
}

std::vector<StiffSetting> settings(int, std::uint64_t seed) {
  std::vector<StiffSetting> result;
  const auto add = [&](const std::string& label, Scene scene, const RayMaker& ray, Property property) {
    result.push_back({.label = label,
                      .scene = share(std::move(scene), "degenerate(" + label + ")"),
                      .rays = ray_by_ray(ray),
                      .property = property,
                      .stiffness_parameter = static_cast<double>(result.size()),
                      .default_rays = 1000});
  };
  add("objects=0", {}, any_ray, Property::never_hit);
  for (const int count : {1, 2, 3, 5})
    add(
        fmt::format("objects={}", count), good_triangles(count, seed),
        [scene = good_triangles(count, seed)](const RandomNumbers& random, std::uint64_t number) {
          return lattice_ray(scene, random, number, kLattice, 1);
        },
        Property::as_oracle);
  add("shape=points_and_lines", nothings(20), any_ray, Property::never_hit);
  add("shape=point", nothings(1), any_ray, Property::never_hit);
  add("shape=duplicates", duplicates(seed), any_ray, Property::as_oracle);
  add("shape=flat", flat(seed), flat_ray, Property::as_oracle);
  add("rays=without_direction", mixed_scene(seed, kLattice), pointless_ray, Property::never_hit);
  return result;
}

}  // namespace

const StiffCase& stiff_degenerate() {
  static const StiffCase entry{
      .id = "degenerate",
      .number = 22,
      .title = "Degenerate scenes",
      .construction =
          "0, 1, 2, 3 and 5 objects; objects without area; duplicates; flat scenes, and scenes in a line",
      .property = "no crash, and misses where nothing is",
      .metric = "pass or fail, also under sanitizers",
      .settings = settings};
  return entry;
}

}  // namespace rayshoot
