#pragma once

#include "scenes/geometry/ray.h"

namespace rayshoot {

template <class Real>
struct Triangle {
  Vec3<Real> a, b, c;

  friend bool operator==(const Triangle&, const Triangle&) = default;
};

/// The corners of a triangle in lanes.
template <class Real>
struct Corners {
  Lanes<Real> a, b, c;

  explicit Corners(const Triangle<Real>& triangle)
      : a(read_lanes<Real>(triangle, 0)), b(read_lanes<Real>(triangle, 3)) {
    const Lanes<Real> last = read_lanes<Real>(triangle, 5);
    c = __builtin_shufflevector(last, last, 1, 2, 3, 0);
  }

  LaneBox<Real> bounds() const {
    return padded(LaneBox<Real>{min_lanes(a, min_lanes(b, c)), max_lanes(a, max_lanes(b, c))});
  }
};

template <class Real>
Box<Real> bounds(const Triangle<Real>& triangle) {
  return Box<Real>(Corners<Real>(triangle).bounds());
}

/// Twice the area times the unit normal, in double precision.
template <class Real>
Vec3d double_area_vector(const Triangle<Real>& triangle) {
  const Vec3d a(triangle.a);
  return cross(Vec3d(triangle.b) - a, Vec3d(triangle.c) - a);
}

/// Whether the point of the ray at `t`, which lies in the plane of the triangle, lies in the triangle or
/// within 16 units in the last place of it.
inline bool covers(const Triangle<double>& triangle, const Ray<double>& ray, double t) {
  const Vec3d ab = triangle.b - triangle.a, ac = triangle.c - triangle.a, normal = cross(ab, ac);
  const Vec3d start = ray.origin - triangle.a, point = start + ray.direction * t;
  const double slack =
      16 * std::numeric_limits<double>::epsilon() * (max_abs(start) + max_abs(ab) + max_abs(ac));
  const double weight_b = dot(cross(point, ac), normal), weight_c = dot(cross(ab, point), normal);
  const double weight_a = dot(normal, normal) - weight_b - weight_c, scaled = -slack * length(normal);
  return weight_a >= scaled * length(ac - ab) && weight_b >= scaled * length(ac) &&
         weight_c >= scaled * length(ab);
}

/// Two-sided ray-triangle test after Möller and Trumbore (1997), in double precision: on which side the ray
/// passes each edge is the sign of a triple product of the edge, the ray and the way from its origin to the
/// triangle. A ray in the plane misses. A hit lies within 16 units in the last place of the distances involved
/// of the triangle, however shallow the angle.
template <class Real>
Real hit_distance(const Triangle<Real>& triangle, const Ray<Real>& ray) {
  // Reject the ray unless it passes on the same side of all three edges.
  const Corners<Real> corners(triangle);
  const WideLanes a = widened(corners.a), direction = widened(read_lanes<Real>(ray, 4));
  const WideLanes ab = widened(corners.b) - a, ac = widened(corners.c) - a;
  const WideLanes to_a = a - widened(read_lanes<Real>(ray, 0));
  const WideLanes normal = cross(ab, ac), q = cross(to_a, direction);
  const double approach = dot(normal, direction), sign = std::copysign(1.0, approach);
  const double u = dot(ac, q) * sign, v = -dot(ab, q) * sign;
  const bool outside = !(u >= 0) | !(v >= 0) | !(u + v <= std::abs(approach)) | (approach == 0);
  if (outside) return kMiss<Real>;

  // Measure the distance along the ray to the plane of the triangle.
  const double t = dot(normal, to_a) / approach;

  // At a shallow angle rounding alone can pass a ray of doubles by all edges: then its point must be at the
  // triangle.
  if constexpr (std::is_same_v<Real, double>) {
    if (approach * approach < dot(normal, normal) * dot(direction, direction) / 16 &&
        !covers(triangle, ray, t))
      return kMiss<Real>;
  }
  return confine(t, corners.bounds(), ray);
}

}  // namespace rayshoot
