#pragma once

#include <span>

#include "scenes/geometry/cone.h"
#include "scenes/geometry/polygon.h"
#include "scenes/geometry/sphere.h"
#include "scenes/geometry/triangle.h"

namespace rayshoot {

/// Conservative surface-box tests: false only where no point of the surface lies in the closed box, whatever
/// the rounding of the test itself. They know nothing of rays: a hit point computed from a ray that starts
/// far away may lie beside its surface by some units in the last place of that way. Who looks for hits in
/// boxes must widen the boxes by that much before asking here.
namespace overlap {

/// Half the extent of a box in double precision, widened by 32 ulps of `Real` of the largest coordinate of
/// the box and the object.
template <class Real>
Vec3d half_extent(const Box<Real>& box, Real largest_of_object) {
  const Real largest = std::max({max_abs(box.lo), max_abs(box.hi), largest_of_object});
  const double margin = 32.0 * std::numeric_limits<Real>::epsilon() * static_cast<double>(largest);
  return (Vec3d(box.hi) - Vec3d(box.lo)) * 0.5 + Vec3d{margin, margin, margin};
}

template <class Real>
Vec3d centre(const Box<Real>& box) {
  return (Vec3d(box.lo) + Vec3d(box.hi)) * 0.5;
}

/// Separating-axis test of a flat polygon (its convex hull) against a box, after Akenine-Möller (2001): the
/// box's own axes, the plane's normal, and the products of edges and axes.
template <class Real>
bool flat(std::span<const Vec3<Real>> vertices, const Vec3d& normal, const Box<Real>& box) {
  Real largest = 0;
  for (const Vec3<Real>& vertex : vertices) largest = std::max(largest, max_abs(vertex));
  const Vec3d middle = centre(box), half = half_extent(box, largest);
  const auto separated_along = [&](const Vec3d& axis) {
    const double reach = half.x * std::abs(axis.x) + half.y * std::abs(axis.y) + half.z * std::abs(axis.z);
    double lowest = Box<double>::infinity(), highest = -lowest;
    for (const Vec3<Real>& vertex : vertices) {
      const double along = dot(axis, Vec3d(vertex) - middle);
      lowest = std::min(lowest, along), highest = std::max(highest, along);
    }
    return lowest > reach || highest < -reach;
  };
  const Vec3d axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Vec3d& axis : axes)
    if (separated_along(axis)) return false;
  if (separated_along(normal)) return false;
  Vec3d previous(vertices.back());
  for (const Vec3<Real>& vertex : vertices) {
    const Vec3d edge = Vec3d(vertex) - previous;
    for (const Vec3d& axis : axes)
      if (separated_along(cross(edge, axis))) return false;
    previous = Vec3d(vertex);
  }
  return true;
}

}  // namespace overlap

template <class Real>
bool surface_overlaps(const Triangle<Real>& triangle, const Box<Real>& box) {
  const Vec3<Real> vertices[] = {triangle.a, triangle.b, triangle.c};
  return overlap::flat<Real>(vertices, double_area_vector(triangle), box);
}

/// A polygon that is not planar is hit in the plane through its first vertex, which may lie outside the hull of its
/// vertices: of such a polygon nothing but its bounds is known.
template <class Real>
bool surface_overlaps(const Polygon<Real>& polygon, std::span<const Vec3<Real>> vertices,
                      const Box<Real>& box) {
  const Vec3d first(vertices.front());
  Real largest = 0;
  double farthest = 0;
  for (const Vec3<Real>& vertex : vertices) {
    largest = std::max(largest, max_abs(vertex));
    farthest = std::max(farthest, std::abs(dot(polygon.normal, Vec3d(vertex) - first)));
  }
  if (farthest > static_cast<double>(padding(largest, 16)) * length(polygon.normal)) return true;
  return overlap::flat<Real>(vertices, polygon.normal, box);
}

/// A sphere's surface reaches a box when the box's nearest point is inside and its farthest outside the
/// sphere (Arvo 1990).
template <class Real>
bool surface_overlaps(const Sphere<Real>& sphere, const Box<Real>& box) {
  const Vec3d middle = overlap::centre(box);
  const Vec3d half = overlap::half_extent(box, max_abs(sphere.centre) + sphere.radius);
  double nearest = 0, farthest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double offset = std::abs(static_cast<double>(sphere.centre[axis]) - middle[axis]);
    const double near = std::max(0.0, offset - half[axis]), far = offset + half[axis];
    nearest += near * near, farthest += far * far;
  }
  const double radius_squared = static_cast<double>(sphere.radius) * sphere.radius;
  return nearest <= radius_squared && radius_squared <= farthest;
}

/// Cones have no cheap exact test: their bounds stand for them.
template <class Real>
bool surface_overlaps(const Cone<Real>& cone, const Box<Real>& box) {
  return bounds(cone).overlaps(box);
}

}  // namespace rayshoot
