#include "scenes/core/needs.h"

#include <algorithm>

namespace rayshoot {

namespace {

SceneNeeds needs_of_own(const Scene& scene) {
  const auto any_material = [&](auto property) {
    return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const SceneObject& object) {
      return object.kind != ObjectKind::placed && property(scene.materials[object.material]);
    });
  };
  return {.shadow_rays = !scene.lights.empty(),
          .reflected_rays = any_material([](const Material& m) { return m.reflects(); }),
          .refracted_rays = any_material([](const Material& m) { return m.refracts(); }),
          .curved_objects = !scene.spheres.empty() || !scene.cones.empty(),
          .triangles_only = scene.triangles.size() == scene.objects.size(),
          .placed_parts = !scene.placements.empty()};
}

}  // namespace

SceneNeeds needs_of(const Scene& scene) {
  SceneNeeds needs = needs_of_own(scene);
  for (const Scene* part : distinct_parts(scene)) {
    const SceneNeeds inside = needs_of_own(*part);
    needs.reflected_rays |= inside.reflected_rays, needs.refracted_rays |= inside.refracted_rays;
    needs.curved_objects |= inside.curved_objects;
  }
  needs.motion = has_motion(scene);
  return needs;
}

std::vector<LeftOut> left_out(const SceneNeeds& needs) {
  std::vector<LeftOut> lines;
  if (!needs.shadow_rays) lines.push_back({"shadow rays", "the scene has no point light"});
  if (!needs.reflected_rays) lines.push_back({"reflected rays", "no material reflects"});
  if (!needs.refracted_rays) lines.push_back({"refracted rays", "no material transmits"});
  if (needs.triangles_only)
    lines.push_back({"tests for polygons, spheres and cones", "every object is a triangle"});
  if (!needs.placed_parts) lines.push_back({"placing of parts", "no part is placed"});
  if (!needs.motion) lines.push_back({"times of rays", "nothing moves"});
  return lines;
}

}  // namespace rayshoot
