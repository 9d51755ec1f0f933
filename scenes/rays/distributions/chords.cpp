// chords: uniform random lines through the scene's bounding sphere (Cauchy-Crofton measure)
//
// Purpose    The assumption behind equations (2) and (3): for these rays, and only for these, the probability
//            to hit a convex volume inside another is the ratio of their surface areas.
// Rules      A direction uniform on the sphere, a point uniform on the disc across it; the line enters the
//            sphere there. Four numbers a line, taken from a randomly shifted additive recurrence
//            (generalised golden ratio), so that averages over chords converge faster than over independent
//            lines.

#include <numbers>
#include <random>

#include "scenes/rays/distribution.h"
#include "scenes/rays/times.h"

namespace rayshoot {

namespace {

/// Point number i of the shifted four-dimensional additive recurrence; each coordinate in [0, 1).
std::array<double, 4> sequence_point(std::uint64_t i, const std::array<double, 4>& shift) {
  constexpr double ratio = 1.1673039782614187;  // the root of x^5 = x + 1
  std::array<double, 4> point;
  double step = 1;
  for (int k = 0; k < 4; ++k) {
    step /= ratio;
    const double x = shift[k] + static_cast<double>(i) * step;
    point[k] = x - std::floor(x);
  }
  return point;
}

Ray<double> chord(const std::array<double, 4>& u, const Vec3d& centre, double radius) {
  const double z = 1 - 2 * u[0], azimuth = 2 * std::numbers::pi * u[1];
  const double across = std::sqrt(std::max(0.0, 1 - z * z));
  const Vec3d direction{across * std::cos(azimuth), across * std::sin(azimuth), z};
  const Vec3d side = std::abs(z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{1, 0, 0};
  const Vec3d e1 = normalized(cross(direction, side)), e2 = cross(direction, e1);
  const double r = radius * std::sqrt(u[2]), turn = 2 * std::numbers::pi * u[3];
  const Vec3d on_disc = centre + e1 * (r * std::cos(turn)) + e2 * (r * std::sin(turn));
  return {.origin = on_disc - direction * radius, .direction = direction};
}

RaySet generate(const RayRequest& request) {
  const Box<double> box = request.scene.bounds();
  const Vec3d centre = box.empty() ? Vec3d{} : box.centre();
  const double radius = box.empty() ? 1 : 0.5 * length(box.extent()) * (1 + 1e-6);
  std::mt19937_64 generator(request.seed);
  std::array<double, 4> shift;
  for (double& s : shift) s = std::uniform_real_distribution<double>()(generator);

  RaySet set;
  set.closest_rays = static_cast<std::size_t>(request.arguments.integer("rays"));
  set.rays.reserve(set.closest_rays);
  for (std::size_t i = 0; i < set.closest_rays; ++i)
    set.rays.push_back(chord(sequence_point(i, shift), centre, radius));
  set_times(set.rays, request.scene, request.seed);
  set.origins.assign(set.rays.size(), {.kind = RayKind::chord});
  return set;
}

}  // namespace

const RayDistribution& rays_chords() {
  static const RayDistribution distribution{
      .id = "chords",
      .title = "Uniform random lines through the bounding sphere",
      .source = "the assumption behind equation (2) of Arvo & Kirk",
      .parameters = {integer_parameter("rays", 100'000, 1, 1e9, "number of rays")},
      .needs_lights = false,
      .cone_sides = [](const Arguments&) { return ConeSides::both; },
      .generate = generate};
  return distribution;
}

}  // namespace rayshoot
