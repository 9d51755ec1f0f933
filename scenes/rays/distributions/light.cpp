// light: from each point light to what the eye sees
//
// Purpose    Occlusion seen from the lights: all rays of a light start at one point, which is what light
//            buffers and other directional techniques are made for.
// Rules      For every light in turn, rays to the points that `primary` hits and that face it, row by row;
//            each ends just before its point and asks whether anything is in between. Where these are more
//            than asked for, every n-th is taken, starting at a random one.
// Parameters rays: 100,000, at most. resolution: 513, of the eye rays that find the points.

#include "scenes/rays/primary_hits.h"
#include "scenes/rays/random.h"

namespace rayshoot {

namespace {

struct LitPoint {
  std::int32_t light;
  Vec3d point, normal;
  double time;
};

std::vector<LitPoint> points_facing_lights(const RayRequest& request) {
  const std::vector<Encounter> points = primary_hits(request);
  std::vector<LitPoint> lit;
  for (std::size_t light = 0; light < request.scene.lights.size(); ++light)
    for (const Encounter& met : points)
      if (dot(met.normal, request.scene.lights[light].position - met.point) > 0)
        lit.push_back({static_cast<std::int32_t>(light), met.point, met.flat, met.time});
  return lit;
}

/// The ray from a light to a point, without the surface at its end.
Ray<double> ray_to(const LitPoint& lit, const Scene& scene, double diagonal) {
  const Vec3d& light = scene.lights[lit.light].position;
  const double distance = length(lit.point - light);
  const double margin = first_distance(ray_tree_rules("clean"), diagonal, lit.point);
  return {.origin = light,
          .direction = (lit.point - light) * (1 / distance),
          .t_max = std::max(0.0, distance - margin),
          .time = lit.time};
}

RaySet generate(const RayRequest& request) {
  const std::vector<LitPoint> points = points_facing_lights(request);
  const double diagonal = length(request.scene.bounds().extent());
  const auto wanted = static_cast<double>(request.arguments.integer("rays"));
  const double stride = std::max(1.0, static_cast<double>(points.size()) / wanted);
  const double start = stride > 1 ? stride * RandomNumbers(request.seed).uniform(0, 0) : 0;

  RaySet set;
  for (std::size_t k = 0;; ++k) {
    const double position = start + stride * static_cast<double>(k);
    if (position >= static_cast<double>(points.size())) break;
    const LitPoint& lit = points[static_cast<std::size_t>(position)];
    const Ray<double> ray = ray_to(lit, request.scene, diagonal);
    const auto cosine = static_cast<float>(std::abs(dot(lit.normal, ray.direction)));
    set.rays.push_back(ray);
    set.origins.push_back({.kind = RayKind::light, .light = lit.light, .cosine = cosine});
  }
  return set;
}

}  // namespace

const RayDistribution& rays_light() {
  static const RayDistribution distribution{
      .id = "light",
      .title = "From every point light to the visible surfaces: occlusion",
      .source = "Haines & Greenberg 1986 ask for no other rays",
      .parameters = {integer_parameter("rays", 100'000, 1, 1e9, "largest number of rays"),
                     resolution_parameter()},
      .needs_lights = true,
      .cone_sides = [](const Arguments&) { return ConeSides::both; },
      .generate = generate};
  return distribution;
}

}  // namespace rayshoot
