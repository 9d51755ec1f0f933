#include "scenes/rays/primary_hits.h"

namespace rayshoot {

std::vector<Encounter> primary_hits(const RayRequest& request) {
  const RayTreeRules& rules = ray_tree_rules("clean");
  const auto resolution = static_cast<int>(request.arguments.integer("resolution"));
  std::vector<Encounter> hits = encounters_of(request.scene, request.tracer, rules,
                                              pixel_rays(request.scene.view, resolution, rules.grid));
  std::erase_if(hits, [](const Encounter& met) { return met.object == kNoObject; });
  return hits;
}

Parameter resolution_parameter() {
  return integer_parameter("resolution", 513, 3, 16384, "rows and columns of eye rays");
}

}  // namespace rayshoot
