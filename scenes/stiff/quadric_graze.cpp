// quadric_graze, STIFF 24: tangents of spheres, cylinders and cones
//
// Construction  Spheres and cylinders of radius 5 through the integer point (3, 4, 0), with tangents along
//               (4, -3, w), and cones whose generator through that point is (3, 4, -5); 27 copies of each 32
//               apart. Origins are 2^k directions before the point, all integers: the ray touches exactly,
//               and misses or cuts when its origin is moved by a float. b^2 - ac loses all digits there.
// Property      Graded by the oracle, which compares the discriminant with 0 exactly. A ray that touches
//               hits.
// Metric        Rate of wrong answers by class, error of t in ulps, as functions of distance over radius.
// Size          k of 0, 8, 18 in the short form, all even k from size 2.
// Anchor        None: no suite known has curved objects with an exact oracle.

#include <fmt/format.h>

#include <array>

#include "scenes/stiff/parts/scenes.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

constexpr double kRadius = 5;
constexpr Vec3d kTouch{3, 4, 0};

Vec3d place_of_copy(std::uint64_t copy) {
  const auto coordinate = [&](std::uint64_t digit) { return 32.0 * (static_cast<double>(digit % 3) - 1); };
  return {coordinate(copy), coordinate(copy / 3), coordinate(copy / 9)};
}

std::shared_ptr<const Scene> copies(ObjectKind kind, double apex_radius, const std::string& label) {
  SceneBuilder builder;
  for (std::uint64_t copy = 0; copy < 27; ++copy) {
    const Vec3d at = place_of_copy(copy), base = at - Vec3d{0, 0, kRadius}, apex = at + Vec3d{0, 0, kRadius};
    if (kind == ObjectKind::sphere)
      builder.sphere(at, kRadius);
    else
      builder.cone(base, 2 * kRadius - apex_radius, apex, apex_radius);
  }
  return share(std::move(builder), "quadric_graze(" + label + ")");
}

/// `along_generator` is the direction in which the surface goes on straight, which a tangent may contain.
Ray<double> tangent(const Vec3d& along_generator, int exponent, const RandomNumbers& random,
                    std::uint64_t number) {
  const double lean = pick(random, number, 0, -3, 3);
  const Vec3d direction = Vec3d{4, -3, 0} + along_generator * lean;
  Vec3d origin = place_of_copy(random.bits(number, 1) % 27) + kTouch - direction * std::ldexp(1, exponent);
  // Half of the rays touch; the others pass on either side.
  const int ulps = number % 2 == 0 ? 0 : pick(random, number, 2, 0, 1) * 2 - 1;
  origin.x = floats_above(origin.x, ulps);
  return {.origin = origin, .direction = direction};
}

std::vector<StiffSetting> settings(int size, std::uint64_t) {
  struct Quadric {
    const char* name;
    ObjectKind kind;
    double apex_radius;
    Vec3d along_generator;
  };
  constexpr std::array kQuadrics = {Quadric{"sphere", ObjectKind::sphere, 0, {0, 0, 1}},
                                    Quadric{"cylinder", ObjectKind::cone, kRadius, {0, 0, 1}},
                                    Quadric{"cone", ObjectKind::cone, 0, {3, 4, -5}}};
  std::vector<int> exponents{0, 8, 18};
  if (size > 1) exponents = {0, 2, 4, 6, 8, 10, 12, 14, 16, 18};
  std::vector<StiffSetting> result;
  for (const auto& [name, kind, apex_radius, generator] : kQuadrics)
    for (const int exponent : exponents) {
      const std::string label = fmt::format("object={},distance=2^{}", name, exponent);
      result.push_back({.label = label,
                        .scene = copies(kind, apex_radius, label),
                        .rays = ray_by_ray([generator = generator, exponent](const RandomNumbers& random,
                                                                             std::uint64_t number) {
                          return tangent(generator, exponent, random, number);
                        }),
                        .stiffness_parameter = std::ldexp(1, exponent),
                        .default_rays = 500});
    }
  return result;
}

}  // namespace

const StiffCase& stiff_quadric_graze() {
  static const StiffCase entry{
      .id = "quadric_graze",
      .number = 24,
      .title = "Tangents of curved objects",
      .construction = "rays that touch spheres, cylinders and cones, from distances of 2^k radii",
      .property = "graded by the exact discriminant",
      .metric = "rate of wrong answers, error of t in ulps, against distance over radius",
      .settings = settings};
  return entry;
}

}  // namespace rayshoot
