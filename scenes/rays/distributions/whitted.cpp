// whitted: the ray trees of the SPD's pictures (Whitted 1980; Haines 1987)
//
// Purpose    The rays of a classic ray tracer, whose numbers Haines and Havran published scene by scene: who
//            traces the same scenes must cast the same rays.
// Rules      Eye rays on a square grid, five generations: a hit casts a shadow ray to every light it faces, a
//            mirror or glass reflects, glass refracts by Snell's law; nothing is cut off by weight.
// Parameters rules: clean, a correct tracer; haines and havran reproduce the conventions, and one error, of
//            the programs behind the published counts (ray_tree_rules.cpp). resolution: 513, as published.
// Order      By generation, within it pixel by pixel; shadow rays last, in the same order.

#include <algorithm>

#include "scenes/rays/primary_hits.h"

namespace rayshoot {

namespace {

const RayTreeRules& rules_of(const Arguments& arguments) { return ray_tree_rules(arguments.text("rules")); }

Parameter rules_parameter() {
  std::vector<std::string> ids;
  for (const RayTreeRules& rules : all_ray_tree_rules()) ids.push_back(rules.id);
  return choice_parameter("rules", "clean", ids, "conventions of the ray tree");
}

/// Append the rays of a batch or of another set.
template <class Rays>
void append(RaySet& set, const Rays& more) {
  set.rays.insert(set.rays.end(), more.rays.begin(), more.rays.end());
  set.origins.insert(set.origins.end(), more.origins.begin(), more.origins.end());
}

void count(const Wave& wave, RayCounts& counts) {
  const auto number_of = [&](RayKind kind) {
    return std::count_if(wave.rays.origins.begin(), wave.rays.origins.end(),
                         [&](const RayOrigin& origin) { return origin.kind == kind; });
  };
  const auto hits = std::count_if(wave.encounters.begin(), wave.encounters.end(),
                                  [](const Encounter& met) { return met.object != kNoObject; });
  counts.primary_rays += number_of(RayKind::primary);
  counts.reflected_rays += number_of(RayKind::reflected);
  counts.refracted_rays += number_of(RayKind::refracted);
  (wave.generation == 1 ? counts.primary_hits : counts.secondary_hits) += hits;
  counts.shadow_rays += wave.blocked.size();
  counts.shadow_hits += std::count(wave.blocked.begin(), wave.blocked.end(), 1);
  counts.total_internal_reflections += wave.total_internal_reflections;
}

RaySet generate(const RayRequest& request) {
  const RayTreeRules& rules = rules_of(request.arguments);
  RaySet set{.rules = rules.id}, shadow_rays;
  grow_ray_trees(request.scene, request.tracer, rules, eye_rays_of(request, rules), [&](const Wave& wave) {
    append(set, wave.rays);
    append(shadow_rays, wave.shadow_rays);
    count(wave, set.counts);
  });
  set.closest_rays = set.rays.size();
  append(set, shadow_rays);
  return set;
}

}  // namespace

const RayDistribution& rays_whitted() {
  static const RayDistribution distribution{
      .id = "whitted",
      .title = "Ray trees of a Whitted-style picture, five generations deep",
      .source = "Whitted 1980; Haines 1987; Havran 1999",
      .parameters = {rules_parameter(), resolution_parameter()},
      .needs_lights = false,
      .cone_sides = [](const Arguments& arguments) { return rules_of(arguments).cone_sides; },
      .generate = generate};
  return distribution;
}

}  // namespace rayshoot
