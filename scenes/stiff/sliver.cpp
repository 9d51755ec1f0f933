// sliver, STIFF 11: triangles of extreme aspect
//
// Construction  Triangles between points of a lattice of 2^-22: the long edge is a random lattice vector u
//               with coprime coordinates, and the third corner a lattice point v at an altitude of |u| / a
//               over it, found by Euclid's algorithm as a solution of u x v = D. Lattices hold slivers that
//               rounding a real one would destroy: up to a = 4e12. A third coordinate that is a sum of the
//               other two tilts the plane, and axes are exchanged at random. Rays run exactly to corners and
//               to midpoints of edges, or to random points of the lattice nearby.
// Property      Graded by the oracle.
// Metric        Rate of wrong answers by class and error of t in ulps, against a.
// Size          a in steps of 1000 in the short form, of 10 from size 2; 64 triangles, times 4 with every
//               size, at most 65536.
// Anchor        At an aspect of 1e5 the median error of t is 2.4e4 ulps in single precision after Moeller and
//               Trumbore, 533 in Embree.

#include <fmt/format.h>

#include <array>
#include <tuple>

#include "scenes/stiff/parts/scenes.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

constexpr double kLattice = 0x1p-22;
/// Long edges have about this many steps of the lattice in each of their two free coordinates.
constexpr std::int64_t kSteps = 1 << 20;

using Pair = std::array<std::int64_t, 2>;

/// The solution of u[0] v[1] - u[1] v[0] = 1 for coprime u, and 0 in the first place of the result otherwise.
std::pair<std::int64_t, Pair> bezout(const Pair& u) {
  Pair r{u[0], u[1]}, s{1, 0}, t{0, 1};
  while (r[1] != 0) {
    const std::int64_t q = r[0] / r[1];
    r = {r[1], r[0] - q * r[1]}, s = {s[1], s[0] - q * s[1]}, t = {t[1], t[0] - q * t[1]};
  }
  // u[0] s[0] + u[1] t[0] = 1.
  return {r[0] == 1, {-t[0], s[0]}};
}

/// A vector beside u with u x v = area, its foot within u. Up to an aspect of 10^4 a real vector is rounded instead.
Pair beside(const Pair& u, const Pair& unit, double aspect, double foot) {
  const double square = static_cast<double>(u[0] * u[0] + u[1] * u[1]);
  if (aspect < 1e4) {
    const auto coordinate = [&](double along, double across) {
      return static_cast<std::int64_t>(std::nearbyint(foot * along + across / aspect));
    };
    const auto x = static_cast<double>(u[0]), y = static_cast<double>(u[1]);
    return {coordinate(x, -y), coordinate(y, x)};
  }
  const auto area = std::max(std::int64_t{1}, static_cast<std::int64_t>(square / aspect));
  const Pair v{unit[0] * area, unit[1] * area};
  const double along = (static_cast<double>(v[0]) * static_cast<double>(u[0]) +
                        static_cast<double>(v[1]) * static_cast<double>(u[1])) /
                       square;
  const auto turns = static_cast<std::int64_t>(std::floor(along));
  return {v[0] - turns * u[0], v[1] - turns * u[1]};
}

/// A point of space from two coordinates: the third is 0, their sum or their difference, and axes change places.
Vec3d lift(const Pair& p, int tilt, int turn) {
  const std::array<std::int64_t, 3> q{p[0], p[1], tilt == 0 ? 0 : tilt == 1 ? p[0] + p[1] : p[0] - p[1]};
  const auto coordinate = [&](int axis) {
    return kLattice * static_cast<double>(q[static_cast<std::size_t>((axis + turn) % 3)]);
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

void add_sliver(SceneBuilder& builder, double aspect, const RandomNumbers& random, std::uint64_t number) {
  Pair u{}, unit{};
  for (std::uint64_t attempt = 0, coprime = 0; !coprime; ++attempt) {
    u = {pick(random, number, 10 + 2 * attempt, kSteps / 2, kSteps),
         pick(random, number, 11 + 2 * attempt, kSteps / 4, kSteps)};
    std::tie(coprime, unit) = bezout(u);
  }
  const Pair v = beside(u, unit, aspect, random.uniform(number, 0));
  const int tilt = pick(random, number, 1, 0, 2), turn = pick(random, number, 2, 0, 2);
  const Vec3d start = snapped(point_in_cube(random, number, 3) * 0.5, kLattice);
  builder.triangle(start, start + lift(u, tilt, turn), start + lift(v, tilt, turn));
}

Ray<double> ray_to_sliver(const Scene& scene, const RandomNumbers& random, std::uint64_t number) {
  const auto& [a, b, c] = scene.triangles[random.bits(number, 0) % scene.triangles.size()];
  const Vec3d origin = snapped(point_in_cube(random, number, 1), kLattice);
  const Vec3d nearby = a + (b - a) * random.uniform(number, 4) + (c - a) * (0.5 * random.uniform(number, 5));
  const Vec3d middle = snapped((a + b) * 0.5, kLattice);
  const std::array targets{a, b, c, middle, snapped(nearby, kLattice), snapped(nearby, kLattice)};
  return ray_to(origin, targets[number % targets.size()]);
}

std::vector<StiffSetting> settings(int size, std::uint64_t seed) {
  const RandomNumbers random(seed);
  std::vector<StiffSetting> result;
  for (int k = 0; k <= 12; k += size > 1 ? 1 : 3) {
    SceneBuilder builder;
    const std::uint64_t triangles = 64ull << std::min(2 * (size - 1), 10);
    for (std::uint64_t i = 0; i < triangles; ++i) add_sliver(builder, std::pow(10, k), random, i);
    const auto scene = share(std::move(builder), fmt::format("sliver(aspect=1e{})", k));
    result.push_back({.label = fmt::format("aspect=1e{}", k),
                      .scene = scene,
                      .rays = ray_by_ray([scene](const RandomNumbers& numbers, std::uint64_t number) {
                        return ray_to_sliver(*scene, numbers, number);
                      }),
                      .base = 0,
                      .stiffness_parameter = std::pow(10, k),
                      .default_rays = 2000});
  }
  return result;
}

}  // namespace

const StiffCase& stiff_sliver() {
  static const StiffCase entry{
      .id = "sliver",
      .number = 11,
      .title = "Triangles of aspect a",
      .construction =
          "triangles with a long edge a times their altitude, a = 1 to 1e12, in random orientation",
      .property = "graded by the oracle",
      .metric = "rate of wrong answers, error of t in ulps, against a",
      .settings = settings};
  return entry;
}

}  // namespace rayshoot
