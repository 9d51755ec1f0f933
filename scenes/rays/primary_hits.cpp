#include "scenes/rays/primary_hits.h"

#include "scenes/rays/times.h"

namespace rayshoot {

std::vector<Ray<double>> eye_rays_of(const RayRequest& request, const RayTreeRules& rules) {
  const auto resolution = static_cast<int>(request.arguments.integer("resolution"));
  std::vector<Ray<double>> rays = pixel_rays(request.scene.view, resolution, rules.grid);
  set_times(rays, request.scene, request.seed);
  return rays;
}

std::vector<Encounter> primary_hits(const RayRequest& request) {
  const RayTreeRules& rules = ray_tree_rules("clean");
  std::vector<Encounter> hits =
      encounters_of(request.scene, request.tracer, rules, eye_rays_of(request, rules));
  std::erase_if(hits, [](const Encounter& met) { return met.object == kNoObject; });
  return hits;
}

Parameter resolution_parameter() {
  return integer_parameter("resolution", 513, 3, 16384, "rows and columns of eye rays");
}

}  // namespace rayshoot
