// garbage, STIFF 21: random bits among good objects and rays
//
// Construction  An icosphere of 320 triangles among objects whose numbers are random bits read as floats:
//               not-a-numbers, infinities, denormals, anything; one garbage triangle in four has good corners
//               but one. Rays are good, or random finite bits, or hold one number that is not finite.
// Property      Good rays and finite ones: graded by the oracle, for which objects that are not finite do not
//               exist. A ray that is not finite has no points, and meets nothing.
// Metric        False misses of good objects, false hits; time and steps, which must stay bounded.
// Size          200 size^2 objects of garbage, at most 200,000.
// Anchor        Embree's build_garbage_geom builds such scenes and shoots no ray; its nan_test and inf_test
//               measure time alone, and only where a compile option is set, which Debian's is not.

#include <array>

#include "scenes/stiff/parts/scenes.h"
#include "scenes/stiff/parts/solids.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

Vec3d random_bits(const RandomNumbers& random, std::uint64_t number, std::uint64_t dimension) {
  return {float_of(random.bits(number, dimension)), float_of(random.bits(number, dimension + 1)),
          float_of(random.bits(number, dimension + 2))};
}

/// Random bits, with another exponent where they are not finite.
Vec3d random_finite_bits(const RandomNumbers& random, std::uint64_t number, std::uint64_t dimension) {
  Vec3d result = random_bits(random, number, dimension);
  for (int axis = 0; axis < 3; ++axis)
    if (!std::isfinite(result[axis])) result[axis] = 1;
  return result;
}

void add_garbage(SceneBuilder& builder, const TriangleMesh& good, const RandomNumbers& random,
                 std::uint64_t number) {
  const auto point = [&](std::uint64_t which) { return random_bits(random, number, 3 * which); };
  const auto radius = [&](std::uint64_t which) { return float_of(random.bits(number, 20 + which)); };
  const auto good_point = [&](std::uint64_t which) {
    return good.vertices[random.bits(number, 30 + which) % good.vertices.size()];
  };
  switch (number % 4) {
    case 0:
      return builder.triangle(good_point(0), good_point(1), point(0));
    case 1:
      return builder.triangle(point(0), point(1), point(2));
    case 2:
      return builder.sphere(point(0), radius(0));
    default:
      return builder.cone(point(0), radius(0), point(1), radius(1));
  }
}

Ray<double> good_ray(const Solid& solid, const RandomNumbers& random, std::uint64_t number) {
  const auto& vertices = solid.mesh.vertices;
  return ray_to(point_inside(solid, random, number, true),
                vertices[random.bits(number, 0) % vertices.size()]);
}

/// Random bits, every other one from a point near the solid, every fourth one to such a point.
Ray<double> finite_ray(const RandomNumbers& random, std::uint64_t number) {
  Ray<double> ray{.origin = random_finite_bits(random, number, 50),
                  .direction = random_finite_bits(random, number, 53)};
  if (number % 4 == 0) return ray_to(ray.origin, point_in_cube(random, number, 56));
  if (number % 2 == 0) ray.origin = rounded(point_in_cube(random, number, 56) * 2);
  return ray;
}

Ray<double> spoiled_ray(const Solid& solid, const RandomNumbers& random, std::uint64_t number) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr std::array kBad = {kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN()};
  Ray<double> ray = good_ray(solid, random, number);
  const int place = pick(random, number, 40, 0, 5);
  const double bad = kBad[random.bits(number, 41) % kBad.size()];
  (place < 3 ? ray.origin : ray.direction)[place % 3] = bad;
  return ray;
}

std::vector<StiffSetting> settings(int size, std::uint64_t seed) {
  const Solid solid = icosphere(2);
  const RandomNumbers random(seed);
  SceneBuilder good, garbage;
  add_mesh(good, solid.mesh);
  const int count = 200 * std::min(size, 31) * std::min(size, 31);
  for (int i = 0; i < count / 2; ++i) add_garbage(garbage, solid.mesh, random, static_cast<std::uint64_t>(i));
  add_mesh(garbage, solid.mesh);
  for (int i = count / 2; i < count; ++i)
    add_garbage(garbage, solid.mesh, random, static_cast<std::uint64_t>(i));
  const auto clean = share(std::move(good), "garbage(objects=good)");
  const auto dirty = share(std::move(garbage), "garbage(objects=garbage)");

  const auto good_rays =
      ray_by_ray([=](const auto& r, std::uint64_t number) { return good_ray(solid, r, number); });
  const auto spoiled =
      ray_by_ray([=](const auto& r, std::uint64_t number) { return spoiled_ray(solid, r, number); });
  std::vector<StiffSetting> result;
  const auto add = [&](const char* label, const auto& scene, const auto& rays, Property property) {
    result.push_back({.label = label,
                      .scene = scene,
                      .rays = rays,
                      .property = property,
                      .base = 0,
                      .stiffness_parameter = static_cast<double>(scene->size()),
                      .default_rays = 1000});
  };
  add("objects=good,rays=good", clean, good_rays, Property::always_hit);
  add("objects=garbage,rays=good", dirty, good_rays, Property::as_oracle);
  add("objects=good,rays=finite_bits", clean, ray_by_ray(finite_ray), Property::as_oracle);
  add("objects=garbage,rays=finite_bits", dirty, ray_by_ray(finite_ray), Property::as_oracle);
  add("objects=good,rays=not_finite", clean, spoiled, Property::never_hit);
  add("objects=garbage,rays=not_finite", dirty, spoiled, Property::never_hit);
  return result;
}

}  // namespace

const StiffCase& stiff_garbage() {
  static const StiffCase entry{.id = "garbage",
                               .number = 21,
                               .title = "Garbage among good objects and rays",
                               .construction = "objects and rays made of random bits, among good ones",
                               .property = "good objects are still found, and every query ends",
                               .metric = "false misses of good objects; crashes; work per ray",
                               .settings = settings};
  return entry;
}

}  // namespace rayshoot
