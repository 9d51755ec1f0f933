#include "scenes/core/needs.h"

#include <algorithm>

namespace rayshoot {

SceneNeeds needs_of(const Scene& scene) {
  const auto any_material = [&](auto property) {
    return std::any_of(scene.objects.begin(), scene.objects.end(),
                       [&](const SceneObject& object) { return property(scene.materials[object.material]); });
  };
  return {.shadow_rays = !scene.lights.empty(),
          .reflected_rays = any_material([](const Material& m) { return m.reflects(); }),
          .refracted_rays = any_material([](const Material& m) { return m.refracts(); }),
          .curved_objects = !scene.spheres.empty() || !scene.cones.empty(),
          .triangles_only = scene.triangles.size() == scene.objects.size()};
}

std::vector<LeftOut> left_out(const SceneNeeds& needs) {
  std::vector<LeftOut> lines;
  if (!needs.shadow_rays) lines.push_back({"shadow rays", "the scene has no point light"});
  if (!needs.reflected_rays) lines.push_back({"reflected rays", "no material reflects"});
  if (!needs.refracted_rays) lines.push_back({"refracted rays", "no material transmits"});
  if (needs.triangles_only)
    lines.push_back({"tests for polygons, spheres and cones", "every object is a triangle"});
  return lines;
}

}  // namespace rayshoot
