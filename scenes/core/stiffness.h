#pragma once

#include <optional>

#include "scenes/core/scene.h"

namespace rayshoot {

/// The smallest thing a technique must tell apart: the smallest altitude of a triangle, edge of a polygon, diameter of
/// a sphere, height or diameter of a cone that is not zero. Objects that cannot be traced in double precision do not
/// count; nothing where none is left.
std::optional<double> smallest_feature(const Scene& scene);

/// Stiffness: the diagonal of the scene over its smallest feature.
std::optional<double> stiffness(const Scene& scene);

}  // namespace rayshoot
