// primary: eye rays alone, the first generation of `whitted`
//
// Purpose    The most coherent rays there are: neighbours in the set start at one point in nearly one
//            direction.
// Rules      Those of whitted(rules=clean): a square grid from edge to edge of the view.
// Parameters resolution: 513, as in the published counts.

#include "scenes/rays/primary_hits.h"

namespace rayshoot {

namespace {

RaySet generate(const RayRequest& request) {
  RaySet set;
  set.rays = eye_rays_of(request, ray_tree_rules("clean"));
  set.origins.assign(set.rays.size(), {.kind = RayKind::primary});
  set.closest_rays = set.rays.size();
  set.counts.primary_rays = set.rays.size();
  set.counts.primary_hits = primary_hits(request).size();
  return set;
}

}  // namespace

const RayDistribution& rays_primary() {
  static const RayDistribution distribution{.id = "primary",
                                            .title = "Eye rays",
                                            .source = "first generation of whitted",
                                            .parameters = {resolution_parameter()},
                                            .needs_lights = false,
                                            .cone_sides = [](const Arguments&) { return ConeSides::both; },
                                            .generate = generate};
  return distribution;
}

}  // namespace rayshoot
