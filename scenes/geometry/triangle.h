#pragma once

#include "scenes/geometry/ray.h"

namespace rayshoot {

template <class Real>
struct Triangle {
  Vec3<Real> a, b, c;

  friend bool operator==(const Triangle&, const Triangle&) = default;
};

template <class Real>
Box<Real> bounds(const Triangle<Real>& triangle) {
  Box<Real> box;
  box.include(triangle.a), box.include(triangle.b), box.include(triangle.c);
  return padded(box);
}

/// Twice the area times the unit normal, in double precision.
template <class Real>
Vec3d double_area_vector(const Triangle<Real>& triangle) {
  const Vec3d a(triangle.a);
  return cross(Vec3d(triangle.b) - a, Vec3d(triangle.c) - a);
}

/// Whether a point in the plane of a triangle, given from its vertex a, lies in the triangle or within
/// `slack` of it.
template <class Real>
bool covers(const Triangle<Real>& triangle, const Vec3d& normal, const Vec3d& from_a, double slack) {
  const Vec3d a(triangle.a), ab = Vec3d(triangle.b) - a, ac = Vec3d(triangle.c) - a;
  const double weight_b = dot(cross(from_a, ac), normal), weight_c = dot(cross(ab, from_a), normal);
  const double weight_a = dot(normal, normal) - weight_b - weight_c, scaled = -slack * length(normal);
  return weight_a >= scaled * length(ac - ab) && weight_b >= scaled * length(ac) &&
         weight_c >= scaled * length(ab);
}

/// Two-sided ray-triangle test after Möller and Trumbore (1997). Which side of each edge the ray passes is
/// decided in `Real`; the distance is then computed in double precision from the triangle's plane. A ray in
/// the plane misses. A hit lies within 16 units in the last place of the distances involved of the triangle,
/// however shallow the angle.
template <class Real>
Real hit_distance(const Triangle<Real>& triangle, const Ray<Real>& ray) {
  // Reject the ray unless it passes on the same side of all three edges.
  const Vec3<Real> ab = triangle.b - triangle.a;
  const Vec3<Real> ac = triangle.c - triangle.a;
  const Vec3<Real> p = cross(ray.direction, ac);
  const Vec3<Real> from_a = ray.origin - triangle.a;
  const Vec3<Real> q = cross(from_a, ab);
  const Real determinant = dot(ab, p);
  const Real sign = std::copysign(Real{1}, determinant);
  const Real u = dot(from_a, p) * sign;
  const Real v = dot(ray.direction, q) * sign;
  const bool outside = !(u >= 0) | !(v >= 0) | !(u + v <= std::abs(determinant)) | (determinant == 0);
  if (outside) return kMiss<Real>;

  // Measure the distance along the ray to the plane of the triangle.
  const Vec3d normal = double_area_vector(triangle), direction(ray.direction);
  const double approach = dot(normal, direction);
  if (approach == 0) return kMiss<Real>;
  const double t = dot(normal, Vec3d(triangle.a) - Vec3d(ray.origin)) / approach;

  // At a shallow angle rounding alone can pass a ray by all edges: then its point must be at the triangle.
  if (approach * approach < dot(normal, normal) * dot(direction, direction) / 16) {
    const double slack =
        16.0 * std::numeric_limits<Real>::epsilon() * (max_abs(from_a) + max_abs(ab) + max_abs(ac));
    const Vec3d point = Vec3d(ray.origin) - Vec3d(triangle.a) + direction * t;
    if (!covers(triangle, normal, point, slack)) return kMiss<Real>;
  }
  return confine(t, bounds(triangle), ray);
}

}  // namespace rayshoot
