#pragma once

#include <vector>

#include "scenes/core/geometry.h"

namespace rayshoot {

/// A ball whose hull, together with other balls', holds a surface.
struct SurfaceBall {
  Vec3d centre;
  double radius = 0;
};

/// Append balls whose convex hull holds every hit of an object: the vertices of what is flat, a sphere itself, polygons
/// about the end circles of a cone, the corners of the bounds of a polygon that is not planar.
template <class Real>
void append_surface(const Geometry<Real>& geometry, std::uint32_t object, std::vector<SurfaceBall>& balls);
/// The same of a cone that is cut off at both ends, or a cylinder.
void append_frustum(const Vec3d& base, double base_radius, const Vec3d& apex, double apex_radius,
                    std::vector<SurfaceBall>& balls);

}  // namespace rayshoot
