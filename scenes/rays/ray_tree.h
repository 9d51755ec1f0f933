#pragma once

#include <functional>

#include "scenes/rays/distribution.h"
#include "scenes/rays/ray_tree_rules.h"

namespace rayshoot {

/// Rays of a tree, each with where it comes from and the ray of the wave it was cast by.
struct RayBatch {
  std::vector<Ray<double>> rays;
  std::vector<RayOrigin> origins;
  /// Number of the parent ray: of a secondary ray in the wave before, of a shadow ray in its own wave.
  std::vector<std::uint32_t> parents;

  void add(const Ray<double>& ray, const RayOrigin& origin, std::uint32_t parent);
};

/// Where a ray met a surface.
struct Encounter {
  std::uint32_t object = kNoObject;  ///< its number; `kNoObject` where the ray met nothing
  double time = 0;                   ///< of the ray
  Vec3d point;
  Vec3d outward;  ///< unit normal, smooth where the object has vertex normals
  Vec3d normal;   ///< the same on the side that is lit, by the rules
  Vec3d flat;     ///< unit normal of the surface itself, on the side from which it was met
};

/// One generation of a ray tree: its rays in the order of their parents, what they met, and the shadow rays
/// from there.
struct Wave {
  int generation = 1;
  RayBatch rays;
  std::vector<Encounter> encounters;
  RayBatch shadow_rays;
  std::vector<std::uint8_t> blocked;
  /// Refractions that the wave's hits would have cast but for total internal reflection.
  std::uint64_t total_internal_reflections = 0;
};

/// Ray trees of published counts are five generations deep.
inline constexpr int kRayTreeDepth = 5;

/// Grow ray trees from eye rays, generation by generation, and call `visit` with each wave once it is traced.
void grow_ray_trees(const Scene& scene, const Tracer& tracer, const RayTreeRules& rules,
                    std::vector<Ray<double>> eye_rays, const std::function<void(const Wave&)>& visit);

/// What each ray met. Throws nothing; broken objects get some normal.
std::vector<Encounter> encounters_of(const Scene& scene, const Tracer& tracer, const RayTreeRules& rules,
                                     std::span<const Ray<double>> rays);

}  // namespace rayshoot
