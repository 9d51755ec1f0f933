// on_surface, STIFF 17: rays that start on a surface
//
// Construction  A cube, an octahedron and a sphere, with points whose floats are exactly on them: lattice
//               points of the flat faces, Pythagorean quadruples on the sphere. Origins stand there or some
//               ulps outwards, rays run outwards or inwards. Another setting starts on random points of
//               oblique triangles as a hit reports them: rounded, hence off the plane by up to an ulp.
// Property      Graded by the oracle, by which a ray begins behind t = 0: the surface it starts on is not hit
//               again, nor is the other side lost.
// Metric        Self-hits; the smallest offset without any.
// Size          Offsets of 0, 1 and 64 ulps in the short form, powers of two between from size 2.
// Anchor        Renderers offset by 1 to 8 ulps (mitsuba3 #1962); of 10^6 rays spawned with its error bounds
//               pbrt-v4 allows none to hit again.

#include <fmt/format.h>

#include <array>

#include "scenes/stiff/parts/scenes.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

/// A point on a surface, and which way is out.
struct SurfacePoint {
  Vec3d point, outward;
};

constexpr Vec3d kCubeAt{0, 0, 0}, kOctahedronAt{4, 0, 0}, kSphereAt{-4, 0, 0};
constexpr double kSphereRadius = 0.9375;

SurfacePoint on_cube(const RandomNumbers& random, std::uint64_t number) {
  const int axis = pick(random, number, 1, 0, 2);
  Vec3d point = snapped(point_in_cube(random, number, 2) * 0.5, 0x1p-10), outward{};
  outward[axis] = number & 4 ? 1 : -1;
  point[axis] = 0.5 * outward[axis];
  return {kCubeAt + point, outward};
}

SurfacePoint on_octahedron(const RandomNumbers& random, std::uint64_t number) {
  const int x = pick(random, number, 1, 0, 1024), y = pick(random, number, 2, 0, 1024 - x);
  const std::uint64_t bits = random.bits(number, 3);
  const Vec3d signs{bits & 1 ? 1.0 : -1.0, bits & 2 ? 1.0 : -1.0, bits & 4 ? 1.0 : -1.0};
  const Vec3d point{signs.x * x * 0x1p-10, signs.y * y * 0x1p-10, signs.z * (1024 - x - y) * 0x1p-10};
  return {kOctahedronAt + point, signs};
}

SurfacePoint on_sphere(const RandomNumbers& random, std::uint64_t number) {
  // Sums of three squares that make 15^2.
  constexpr std::array<Vec3d, 6> kPoints = {Vec3d{15, 0, 0}, {9, 12, 0}, {2, 10, 11},
                                            {5, 10, 10},     {2, 5, 14}, {11, 10, 2}};
  const Vec3d& p = kPoints[random.bits(number, 1) % kPoints.size()];
  const int turn = pick(random, number, 2, 0, 2);
  const std::uint64_t bits = random.bits(number, 3);
  Vec3d outward;
  for (int axis = 0; axis < 3; ++axis)
    outward[axis] = p[(axis + turn) % 3] * (bits >> axis & 1 ? 1 : -1) / 16;
  return {kSphereAt + outward, outward};
}

/// The point moved outwards by `ulps` floats along the axis that is most outward.
Vec3d moved_out(const SurfacePoint& at, int ulps) {
  Vec3d point = at.point;
  const Vec3d size{std::abs(at.outward.x), std::abs(at.outward.y), std::abs(at.outward.z)};
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  point[axis] = floats_above(point[axis], at.outward[axis] > 0 ? ulps : -ulps);
  return point;
}

Ray<double> ray_from_surface(int ulps, bool inwards, const RandomNumbers& random, std::uint64_t number) {
  const SurfacePoint at = number % 3 == 0   ? on_cube(random, number)
                          : number % 3 == 1 ? on_octahedron(random, number)
                                            : on_sphere(random, number);
  Vec3d direction = unit_direction(random, number, 10);
  if ((dot(direction, at.outward) < 0) != inwards) direction = -direction;
  return {.origin = moved_out(at, ulps), .direction = rounded(direction)};
}

std::shared_ptr<const Scene> solids_apart() {
  SceneBuilder builder;
  add_box(builder, kCubeAt - Vec3d{0.5, 0.5, 0.5}, kCubeAt + Vec3d{0.5, 0.5, 0.5});
  for (int octant = 0; octant < 8; ++octant) {
    const Vec3d x{octant & 1 ? 1.0 : -1.0, 0, 0}, y{0, octant & 2 ? 1.0 : -1.0, 0},
        z{0, 0, octant & 4 ? 1.0 : -1.0};
    builder.triangle(kOctahedronAt + x, kOctahedronAt + y, kOctahedronAt + z);
  }
  builder.sphere(kSphereAt, kSphereRadius);
  return share(std::move(builder), "on_surface(scene=solids)");
}

Ray<double> ray_from_hit(const Scene& scene, const RandomNumbers& random, std::uint64_t number) {
  const auto& [a, b, c] = scene.triangles[random.bits(number, 0) % scene.triangles.size()];
  const double u = random.uniform(number, 1), v = random.uniform(number, 2) * (1 - u);
  return {.origin = rounded(a + (b - a) * u + (c - a) * v),
          .direction = rounded(unit_direction(random, number, 3))};
}

std::vector<StiffSetting> settings(int size, std::uint64_t seed) {
  std::vector<StiffSetting> result;
  const auto scene = solids_apart();
  for (const int ulps : size > 1 ? std::vector{0, 1, 2, 4, 8, 16, 32, 64} : std::vector{0, 1, 64})
    for (const bool inwards : {false, true})
      result.push_back({.label = fmt::format("ulps={},side={}", ulps, inwards ? "in" : "out"),
                        .scene = scene,
                        .rays = ray_by_ray([=](const RandomNumbers& random, std::uint64_t number) {
                          return ray_from_surface(ulps, inwards, random, number);
                        }),
                        .stiffness_parameter = static_cast<double>(ulps),
                        .default_rays = 1000});
  const auto oblique = share(mixed_scene(seed, 0x1p-20), "on_surface(scene=mixed)");
  result.push_back({.label = "spawn=rounded_hit",
                    .scene = oblique,
                    .rays = ray_by_ray([oblique](const RandomNumbers& random, std::uint64_t number) {
                      return ray_from_hit(*oblique, random, number);
                    }),
                    .default_rays = 1000});
  return result;
}

}  // namespace

const StiffCase& stiff_on_surface() {
  static const StiffCase entry{
      .id = "on_surface",
      .number = 17,
      .title = "Rays that start on a surface",
      .construction = "origins exactly on a surface, 1 to 64 ulps off it, or on the rounded point of a hit",
      .property = "what lies at t = 0 is not hit; behind it everything is as it is",
      .metric = "self-hits; the smallest safe offset in ulps",
      .settings = settings};
  return entry;
}

}  // namespace rayshoot
