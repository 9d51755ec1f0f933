#pragma once

#include <algorithm>
#include <span>

#include "scenes/geometry/polygon.h"

namespace rayshoot {

/// Whether all vertices lie in the plane in which the polygon is hit.
template <class Real>
bool is_planar(const Polygon<Real>& polygon, std::span<const Vec3<Real>> vertices) {
  const Vec3d first(vertices.front());
  double farthest = 0, largest = 0;
  for (const Vec3<Real>& vertex : vertices) {
    farthest = std::max(farthest, std::abs(dot(polygon.normal, Vec3d(vertex) - first)));
    largest = std::max(largest, max_abs(Vec3d(vertex) - first));
  }
  return farthest <= static_cast<double>(padding(static_cast<Real>(largest), 4)) * length(polygon.normal);
}

}  // namespace rayshoot
