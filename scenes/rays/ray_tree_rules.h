#pragma once

#include <string>
#include <vector>

#include "scenes/core/geometry.h"
#include "scenes/rays/camera.h"

namespace rayshoot {

/// The conventions in which the programs behind published ray counts differ. Common to all: the eye ray has
/// generation 1; a hit casts one shadow ray to each light in front of its normal; unless it is of the last
/// generation it reflects where ks > 0 or T > 0 and refracts where T > 0; any object blocks light.
struct RayTreeRules {
  std::string id;
  std::string description;
  PixelGrid grid = PixelGrid::edge_to_edge;
  /// Hits nearer to a ray's origin than this are not seen.
  double epsilon = 1e-7;
  /// Whether epsilon gives way to the scale of a scene or a point: see `first_distance`.
  bool epsilon_adapts = true;
  /// Whether light falls on the side from which a surface is seen; otherwise on its outward side alone.
  bool normals_face_the_ray = true;
  ConeSides cone_sides = ConeSides::both;
  /// Whether the axial part of a cone's normal is (rb - ra) / rb instead of (rb - ra) / height.
  bool tilts_cone_normals_by_base = false;
};

/// clean: a correct tracer. haines: the counts in Haines' package. havran: the counts of Havran's tracer
/// GOLEM.
const std::vector<RayTreeRules>& all_ray_tree_rules();
/// The rules of that id; throws InputError with the known ones otherwise.
const RayTreeRules& ray_tree_rules(const std::string& id);

/// Outward unit normal of the object of that number at a time, smooth where it has vertex normals; some unit vector for a
/// broken object.
Vec3d outward_normal(const RayTreeRules& rules, const Scene& scene, std::uint32_t number, const Vec3d& point,
                     double time = 0);

/// Where a ray that starts on a surface begins to see: epsilon, less in scenes smaller than 1 across, and
/// more than the rounding error of the origin. `scene_diagonal` is the length of the diagonal of the scene's
/// bounds.
double first_distance(const RayTreeRules& rules, double scene_diagonal, const Vec3d& origin);

}  // namespace rayshoot
