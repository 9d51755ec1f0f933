#pragma once

#include "accel/parts/planar.h"
#include "accel/parts/surface_margin.h"
#include "scenes/core/geometry.h"

namespace rayshoot {

template <class Real>
Box<Real> common(const Box<Real>& a, const Box<Real>& b) {
  return {max(a.lo, b.lo), min(a.hi, b.hi)};
}

/// The part of a convex polygon for which `beyond(point)`, a distance from a plane, is at most 0 (Sutherland & Hodgman
/// 1974).
template <class Beyond>
std::vector<Vec3d> clipped(const std::vector<Vec3d>& polygon, const Beyond& beyond) {
  std::vector<Vec3d> inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3d &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const double beyond_from = beyond(from), beyond_to = beyond(to);
    if (beyond_from <= 0) inside.push_back(from);
    if ((beyond_from < 0 && beyond_to > 0) || (beyond_from > 0 && beyond_to < 0))
      inside.push_back(from + (to - from) * (beyond_from / (beyond_from - beyond_to)));
  }
  return inside;
}

/// The part on one side of a plane across an axis: where `sign` times a coordinate is at most `limit`.
inline std::vector<Vec3d> clipped(const std::vector<Vec3d>& polygon, int axis, double sign, double limit) {
  return clipped(polygon, [=](const Vec3d& point) { return sign * point[axis] - limit; });
}

/// The corners of an object that is the hull of its corners; none for other kinds.
template <class Real>
std::vector<Vec3d> hull_corners(const Geometry<Real>& geometry, std::uint32_t object) {
  if (geometry.kind(object) == ObjectKind::triangle) {
    const Triangle<Real>& triangle = geometry.triangle(object);
    return {Vec3d(triangle.a), Vec3d(triangle.b), Vec3d(triangle.c)};
  }
  std::vector<Vec3d> corners;
  if (geometry.kind(object) == ObjectKind::polygon) {
    const std::span<const Vec3<Real>> vertices = geometry.polygon_vertices(object);
    if (is_planar(geometry.polygon(object), vertices))
      for (const Vec3<Real>& vertex : vertices) corners.emplace_back(vertex);
  }
  return corners;
}

/// Bounds of the part of an object's surface that reaches into a cell, both widened by `margin`, within the cell; empty
/// where none does. Only triangles and planar polygons are clipped; of other objects it is their bounds within the cell.
/// A polygon that is not convex is clipped as one whose edges may run outside of it, which has the same bounds or larger.
template <class Real>
Box<Real> clipped_bounds(const Geometry<Real>& geometry, std::uint32_t object, const Box<Real>& cell,
                         Real margin) {
  const Box<Real> around = widened(cell, margin);
  if (!geometry.overlaps(object, around)) return {};
  const Box<Real> within_cell = common(geometry.bounds(object), cell);
  std::vector<Vec3d> part = hull_corners(geometry, object);
  for (int axis = 0; axis < 3; ++axis) {
    part = clipped(part, axis, 1, around.hi[axis]);
    part = clipped(part, axis, -1, -around.lo[axis]);
  }
  if (part.empty()) return within_cell;
  Box<Real> box;
  for (const Vec3d& corner : part) box.include(Vec3<Real>(corner));
  return common(within_cell, widened(padded(box), margin));
}

}  // namespace rayshoot
