// diffuse: rays scattered by the visible surfaces, in random order
//
// Purpose    Incoherent rays, as diffuse light transport casts them: neighbours in the set have nothing in
//            common.
// Rules      The points that `primary` hits are shuffled and taken in turn; from each leaves a ray on the
//            side that is seen, its direction distributed by the cosine to the normal. A point is used again
//            when all have been.
// Parameters rays: 100,000. resolution: 513, of the eye rays that find the points.

#include <numbers>
#include <numeric>

#include "scenes/rays/primary_hits.h"
#include "scenes/rays/random.h"

namespace rayshoot {

namespace {

/// The numbers 0 to count-1 in random order (Fisher and Yates).
std::vector<std::uint32_t> shuffled_numbers(std::size_t count, const RandomNumbers& random) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0u);
  for (std::size_t i = count; i-- > 1;)
    std::swap(numbers[i],
              numbers[static_cast<std::size_t>(random.uniform(i, 2) * static_cast<double>(i + 1))]);
  return numbers;
}

/// A direction about a unit normal, with a density proportional to the cosine: a point of the unit disc,
/// lifted onto the hemisphere (Malley's method).
Vec3d cosine_direction(const Vec3d& normal, double u, double v) {
  const Vec3d side = std::abs(normal.z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{1, 0, 0};
  const Vec3d e1 = normalized(cross(normal, side)), e2 = cross(normal, e1);
  const double r = std::sqrt(u), turn = 2 * std::numbers::pi * v;
  return normalized(e1 * (r * std::cos(turn)) + e2 * (r * std::sin(turn)) + normal * std::sqrt(1 - u));
}

RaySet generate(const RayRequest& request) {
  const std::vector<Encounter> points = primary_hits(request);
  const RandomNumbers random(request.seed);
  const std::vector<std::uint32_t> order = shuffled_numbers(points.size(), random);
  const double diagonal = length(request.scene.bounds().extent());

  RaySet set;
  set.closest_rays = points.empty() ? 0 : static_cast<std::size_t>(request.arguments.integer("rays"));
  set.rays.reserve(set.closest_rays), set.origins.reserve(set.closest_rays);
  for (std::size_t ray = 0; ray < set.closest_rays; ++ray) {
    const Encounter& from = points[order[ray % points.size()]];
    const Vec3d direction = cosine_direction(from.flat, random.uniform(ray, 0), random.uniform(ray, 1));
    const double start = first_distance(ray_tree_rules("clean"), diagonal, from.point);
    set.rays.push_back({.origin = from.point, .t_min = start, .direction = direction, .time = from.time});
    set.origins.push_back({.kind = RayKind::diffuse,
                           .generation = 2,
                           .source_object = from.object,
                           .cosine = static_cast<float>(dot(from.flat, direction))});
  }
  return set;
}

}  // namespace

const RayDistribution& rays_diffuse() {
  static const RayDistribution distribution{
      .id = "diffuse",
      .title = "Scattered by the visible surfaces, shuffled: incoherent",
      .source = "cosine-weighted directions (Lambert) from primary hits",
      .parameters = {integer_parameter("rays", 100'000, 1, 1e9, "number of rays"), resolution_parameter()},
      .needs_lights = false,
      .cone_sides = [](const Arguments&) { return ConeSides::both; },
      .generate = generate};
  return distribution;
}

}  // namespace rayshoot
