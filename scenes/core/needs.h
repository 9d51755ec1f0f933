#pragma once

#include <string>
#include <vector>

#include "scenes/core/scene.h"

namespace rayshoot {

/// What tracing a scene calls for, derived from its content.
struct SceneNeeds {
  bool shadow_rays = false;     ///< it has point lights
  bool reflected_rays = false;  ///< some material reflects
  bool refracted_rays = false;  ///< some material transmits
  bool curved_objects = false;  ///< it has spheres or cones
  bool triangles_only = false;  ///< every object is a triangle
  bool placed_parts = false;    ///< some objects are parts, placed any number of times
  bool motion = false;          ///< something moves, so that rays carry times
};

/// Work that is not done for a scene, and the reason.
struct LeftOut {
  std::string what, why;
};

SceneNeeds needs_of(const Scene& scene);

/// What those needs let a run leave out, one line each.
std::vector<LeftOut> left_out(const SceneNeeds& needs);

}  // namespace rayshoot
