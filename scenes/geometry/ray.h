#pragma once

#include <cstdint>
#include <limits>

#include "scenes/geometry/lanes.h"

namespace rayshoot {

/// What a ray-object test returns when it finds nothing: beyond the end of every ray.
template <class Real>
inline constexpr Real kMiss = std::numeric_limits<Real>::infinity();

/// No object.
inline constexpr std::uint32_t kNoObject = 0xFFFFFFFFu;

/// The points origin + t direction with t in the half-open interval (t_min, t_max]; 0 <= t_min. A direction
/// need not have unit length. An unbounded ray ends at the largest finite number, hence before `kMiss`.
template <class Real>
struct Ray {
  Vec3<Real> origin;
  Real t_min = 0;
  Vec3<Real> direction;
  Real t_max = std::numeric_limits<Real>::max();

  Vec3<Real> at(Real t) const { return origin + direction * t; }
  friend bool operator==(const Ray&, const Ray&) = default;
};

/// The nearest hit of a ray: of equal distances the lowest object wins, so that a hit is a function of scene
/// and ray alone, never of the order in which a technique came upon the objects.
template <class Real>
struct Hit {
  Real t = kMiss<Real>;
  std::uint32_t object = kNoObject;

  friend bool operator==(const Hit&, const Hit&) = default;
};

/// Ray parameters between which a ray is inside something; empty when enter > exit.
template <class Real>
struct Interval {
  Real enter, exit;
};

/// A ray prepared for crossing axis-aligned planes. Every technique asks `crossing`, and nothing else, for the
/// parameter at which a ray meets a plane: it never decreases along the direction as the plane moves, so a box
/// inside another always gets an interval inside the other's, without any padding at the time of the test.
template <class Real>
struct Crossings {
  Vec3<Real> origin;
  Vec3<Real> inverse;

  explicit Crossings(const Ray<Real>& ray)
      : origin(ray.origin),
        inverse{invert(ray.direction.x), invert(ray.direction.y), invert(ray.direction.z)} {}

  /// The parameter at which the ray meets the plane `position` of `axis`.
  Real crossing(int axis, Real position) const { return (position - origin[axis]) * inverse[axis]; }

  /// The closed interval of parameters inside a box, regardless of the ray's own ends.
  Interval<Real> inside(const Box<Real>& box) const {
    const Real x0 = crossing(0, box.lo.x), x1 = crossing(0, box.hi.x);
    const Real y0 = crossing(1, box.lo.y), y1 = crossing(1, box.hi.y);
    const Real z0 = crossing(2, box.lo.z), z1 = crossing(2, box.hi.z);
    return {std::max(std::max(std::min(x0, x1), std::min(y0, y1)), std::min(z0, z1)),
            std::min(std::min(std::max(x0, x1), std::max(y0, y1)), std::max(z0, z1))};
  }

 private:
  /// 1/d; the largest finite number where that overflows, so that 0 * inverse is 0 and never not-a-number.
  static Real invert(Real d) {
    constexpr Real limit = std::numeric_limits<Real>::max();
    const Real inverse = Real{1} / d;
    return inverse > limit ? limit : inverse < -limit ? -limit : inverse;
  }
};

/// The last step of every ray-object test: hold the distance `t`, computed in double precision, to the interval
/// in which the ray is inside the object's bounds. Distances so confined lie in the interval of every box that
/// contains the bounds, which is why all techniques agree with exhaustive search exactly. Returns `kMiss` when
/// the ray misses the bounds or the distance is outside the ray's own interval.
template <class Real>
Real confine(double t, const Box<Real>& bounds, const Ray<Real>& ray) {
  const Interval<Real> inside = Crossings<Real>(ray).inside(bounds);
  if (!(inside.enter <= inside.exit)) return kMiss<Real>;
  const Real confined = std::clamp(static_cast<Real>(t), inside.enter, inside.exit);
  return confined > ray.t_min && confined <= ray.t_max ? confined : kMiss<Real>;
}

/// The same for bounds in lanes, to the last bit.
template <class Real>
Real confine(double t, const LaneBox<Real>& bounds, const Ray<Real>& ray) {
  const Lanes<Real> origin = read_lanes<Real>(ray, 0), direction = read_lanes<Real>(ray, 4);
  const Lanes<Real> limit = Lanes<Real>{} + std::numeric_limits<Real>::max();
  const Lanes<Real> unlimited = 1 / Lanes<Real>{direction[0], direction[1], direction[2], 1};
  const Lanes<Real> inverse = min_lanes(limit, max_lanes(-limit, unlimited));
  const Lanes<Real> one = (bounds.lo - origin) * inverse, other = (bounds.hi - origin) * inverse;
  const Real enter = largest(min_lanes(one, other)), exit = smallest(max_lanes(one, other));
  if (!(enter <= exit)) return kMiss<Real>;
  const Real confined = std::clamp(static_cast<Real>(t), enter, exit);
  return confined > ray.t_min && confined <= ray.t_max ? confined : kMiss<Real>;
}

}  // namespace rayshoot
