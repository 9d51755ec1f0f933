#pragma once

#include "scenes/geometry/watertight.h"

namespace rayshoot {

/// The distance at which a ray meets a closed triangle, decided exactly and rounded to nearest; infinite where it
/// misses, lies in the plane, or is not finite. Exact for coordinates between 2^-150 and 2^150 in magnitude, and zero.
double exact_distance(const Triangle<double>& triangle, const Vec3d& origin, const Vec3d& direction);

/// Two-sided ray-triangle test in exact arithmetic, to which plain arithmetic is a filter: it settles what no rounding
/// could decide otherwise.
template <class Real>
Real exact_hit_distance(const Triangle<Real>& triangle, const Ray<Real>& ray) {
  const Triangle<double> wide{Vec3d(triangle.a), Vec3d(triangle.b), Vec3d(triangle.c)};
  const double t = exact_distance(wide, Vec3d(ray.origin), Vec3d(ray.direction));
  return t < kMiss<double> ? confine(t, bounds(triangle), ray) : kMiss<Real>;
}

/// On which side of a ray an edge from a to b passes: the exact sign of direction . (a - origin) x (b - origin).
double exact_side(const Vec3d& a, const Vec3d& b, const Vec3d& origin, const Vec3d& direction);

/// The exact sign of the height of a point's image, moved along the ray into the plane across it.
double exact_height(const Vec3d& point, const Vec3d& origin, const Vec3d& direction, const ViewAxes& axes);

/// Two-sided ray-polygon test: the parity of the edges crossed, counted exactly.
template <class Real>
Real exact_hit_distance(const Polygon<Real>& polygon, std::span<const Vec3<Real>> vertices,
                        const Ray<Real>& ray) {
  const Vec3d origin(ray.origin), direction(ray.direction);
  const double approach = dot(polygon.normal, direction);
  if (approach == 0 || !is_finite(direction)) return kMiss<Real>;
  const ViewAxes axes(ray.direction);
  const double facing = direction[axes.along];
  bool inside = false;
  Vec3d a(vertices.back());
  bool above = exact_height(a, origin, direction, axes) > 0;
  for (const Vec3<Real>& vertex : vertices) {
    const Vec3d b(vertex);
    const bool rises = exact_height(b, origin, direction, axes) > 0;
    if (above != rises) {
      const double side = exact_side(a, b, origin, direction) * facing;
      inside ^= rises ? side > 0 : side < 0;
    }
    a = b, above = rises;
  }
  if (!inside) return kMiss<Real>;
  return confine(dot(polygon.normal, Vec3d(vertices.front()) - origin) / approach, polygon.box, ray);
}

}  // namespace rayshoot
