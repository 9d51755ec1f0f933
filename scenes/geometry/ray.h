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
  /// When, from 0 to 1; it matters where something moves.
  Real time = 0;

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

/// By how much, relative to itself, a computed crossing may be off: three roundings of the crossing, and four
/// of the object test that a ray was given to decide whether it hits there.
template <class Real>
inline constexpr Real kCrossingError = 8 * std::numeric_limits<Real>::epsilon();

/// Two crossings that differ by less than this factor may be one, or come in the other order: each may be off by
/// `kCrossingError`.
template <class Real>
inline constexpr Real kApart = 1 + 3 * kCrossingError<Real>;

/// A ray prepared for crossing axis-aligned planes. Every technique asks it, and nothing else, when a ray meets a
/// plane. Parameters never decrease along the direction as the plane moves, so a box inside another gets an interval
/// inside the other's. Intervals are wider than the exact ones by the error of a crossing at both ends (Ize 2013), so
/// no ray that meets a box is lost, wherever it starts. Negative parameters are not widened: no ray is there.
template <class Real>
struct Crossings {
  Vec3<Real> origin;
  /// 1/direction, and what it is multiplied with for the earliest and the latest parameter at a plane.
  Vec3<Real> inverse, earliest, latest;

  explicit Crossings(const Ray<Real>& ray)
      : origin(ray.origin),
        inverse{invert(ray.direction.x), invert(ray.direction.y), invert(ray.direction.z)},
        earliest(inverse * (1 - kCrossingError<Real>)),
        latest(inverse * (1 + kCrossingError<Real>)) {}

  /// The parameter before which the ray has certainly not passed the plane `position` of `axis`.
  Real enter(int axis, Real position) const { return (position - origin[axis]) * earliest[axis]; }
  /// The parameter at which the ray has certainly reached the plane.
  Real exit(int axis, Real position) const { return (position - origin[axis]) * latest[axis]; }

  /// The parameters between a plane and one behind it, as the ray goes.
  Interval<Real> between(int axis, Real lo, Real hi) const {
    if (inverse[axis] < 0) std::swap(lo, hi);
    return {enter(axis, lo), exit(axis, hi)};
  }

  /// The closed interval of parameters inside a box, regardless of the ray's own ends.
  Interval<Real> inside(const Box<Real>& box) const {
    const Interval<Real> x = between(0, box.lo.x, box.hi.x), y = between(1, box.lo.y, box.hi.y),
                         z = between(2, box.lo.z, box.hi.z);
    return {std::max(std::max(x.enter, y.enter), z.enter), std::min(std::min(x.exit, y.exit), z.exit)};
  }

 private:
  /// 1/d, limited to half the largest finite number, so that 0 * inverse is 0 and never not-a-number.
  static Real invert(Real d) {
    constexpr Real limit = std::numeric_limits<Real>::max() / 2;
    const Real inverse = Real{1} / d;
    return inverse > limit ? limit : inverse < -limit ? -limit : inverse;
  }
};

/// Crossings in lanes: of the axes x, y and z.
template <class Real>
struct LaneCrossings {
  Lanes<Real> origin, inverse;

  explicit LaneCrossings(const Ray<Real>& ray) : origin(read_lanes<Real>(ray, 0)) {
    const Lanes<Real> direction = read_lanes<Real>(ray, 4);
    const Lanes<Real> limit = Lanes<Real>{} + std::numeric_limits<Real>::max() / 2;
    const Lanes<Real> unlimited = 1 / Lanes<Real>{direction[0], direction[1], direction[2], 1};
    inverse = min_lanes(limit, max_lanes(-limit, unlimited));
  }

  /// As `Crossings::inside`, to the last bit.
  Interval<Real> inside(const LaneBox<Real>& box) const {
    const Lanes<Real> near = inverse < 0 ? box.hi : box.lo, far = inverse < 0 ? box.lo : box.hi;
    return {largest((near - origin) * (inverse * (1 - kCrossingError<Real>))),
            smallest((far - origin) * (inverse * (1 + kCrossingError<Real>)))};
  }
};

template <class Real>
Interval<Real> interval_inside(const Box<Real>& box, const Ray<Real>& ray) {
  return Crossings<Real>(ray).inside(box);
}
template <class Real>
Interval<Real> interval_inside(const LaneBox<Real>& box, const Ray<Real>& ray) {
  return LaneCrossings<Real>(ray).inside(box);
}

/// The last step of every ray-object test: hold the distance `t`, computed in double precision, to the interval
/// in which the ray is inside the object's bounds, a Box or a LaneBox. Distances so confined lie in the interval of
/// every box that contains the bounds, which is why all techniques agree with exhaustive search exactly. Returns
/// `kMiss` when the ray misses the bounds or the distance is outside the ray's own interval.
template <class Real, class Bounds>
Real confine(double t, const Bounds& bounds, const Ray<Real>& ray) {
  const Interval<Real> inside = interval_inside(bounds, ray);
  if (!(inside.enter <= inside.exit)) return kMiss<Real>;
  const Real confined = std::clamp(static_cast<Real>(t), inside.enter, inside.exit);
  return confined > ray.t_min && confined <= ray.t_max ? confined : kMiss<Real>;
}

}  // namespace rayshoot
