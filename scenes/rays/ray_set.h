#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenes/core/scene.h"
#include "scenes/geometry/ray.h"

namespace rayshoot {

/// `light` rays lead from a light to a surface, `shadow` rays the other way.
enum class RayKind : std::uint8_t {
  primary,
  shadow,
  reflected,
  refracted,
  chord,
  point_pair,
  diffuse,
  light
};

/// Where a ray of a ray set comes from, for the techniques that use it.
struct RayOrigin {
  RayKind kind = RayKind::primary;
  /// Depth in the ray tree: the eye ray has generation 1, a shadow ray that of the ray at whose hit it
  /// starts.
  std::uint8_t generation = 1;
  /// The light a ray leads to or comes from, or -1.
  std::int32_t light = -1;
  /// The scene object the ray starts on, or `kNoObject`.
  std::uint32_t source_object = kNoObject;
  /// Cosine between the ray and the surface it starts on, or a light ray ends before; 0 to 1.
  float cosine = 1;
};

/// Numbers of rays and hits by kind, in the terms of the SPD tables; zero where a distribution has no such
/// rays.
struct RayCounts {
  std::uint64_t primary_rays = 0, primary_hits = 0;
  std::uint64_t shadow_rays = 0, shadow_hits = 0;
  std::uint64_t reflected_rays = 0, refracted_rays = 0, total_internal_reflections = 0;
  std::uint64_t secondary_hits = 0;
};

/// Rays generated once per scene, stored, hashed and shared by every technique. The first `closest_rays` ask
/// for the closest hit, those behind them for any hit.
struct RaySet {
  /// Distribution with what distinguishes it, for example "whitted@513" or "chords(rays=100000)".
  std::string id;
  std::string distribution;
  /// Rule set of the ray tree; empty where a distribution has none.
  std::string rules;
  std::vector<Ray<double>> rays;
  std::vector<RayOrigin> origins;
  std::size_t closest_rays = 0;
  RayCounts counts;

  std::string hash() const;
};

/// The rays in another precision. Rounded, a point on a surface lies a few ulps off it. So a `float` ray
/// begins to see where it has left its surface by that much, and a light ray ends as much before its own: a
/// grazing one earlier.
template <class Real>
std::vector<Ray<Real>> rays_in(const RaySet& set);

extern template std::vector<Ray<float>> rays_in<float>(const RaySet&);
extern template std::vector<Ray<double>> rays_in<double>(const RaySet&);

}  // namespace rayshoot
