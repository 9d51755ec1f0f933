#pragma once

#include <optional>

#include "scenes/geometry/vec.h"

namespace rayshoot {

/// The mirror image of a direction in a surface with that unit normal, on whichever side.
inline Vec3d reflected(const Vec3d& direction, const Vec3d& normal) {
  return normalized(direction - normal * (2 * dot(direction, normal)));
}

/// The direction behind a surface by Snell's law, or nothing on total internal reflection. `outward` is the
/// unit normal away from the medium, whose index of refraction is relative to the outside; a direction along
/// it leaves.
inline std::optional<Vec3d> refracted(const Vec3d& direction, const Vec3d& outward,
                                      double index_of_refraction) {
  const double approach = dot(direction, outward);
  const double ratio = approach > 0 ? index_of_refraction : 1 / index_of_refraction;
  const double cosine_squared = 1 - ratio * ratio * (1 - approach * approach);
  if (!(cosine_squared >= 0)) return std::nullopt;
  const double along = std::copysign(std::sqrt(cosine_squared), approach) - ratio * approach;
  return normalized(direction * ratio + outward * along);
}

}  // namespace rayshoot
