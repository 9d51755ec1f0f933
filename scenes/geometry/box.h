#pragma once

#include <limits>

#include "scenes/geometry/vec.h"

namespace rayshoot {

/// An axis-aligned box, closed; empty until something is included.
template <class Real>
struct Box {
  Vec3<Real> lo{infinity(), infinity(), infinity()};
  Vec3<Real> hi{-infinity(), -infinity(), -infinity()};

  static constexpr Real infinity() { return std::numeric_limits<Real>::infinity(); }

  void include(const Vec3<Real>& p) { lo = min(lo, p), hi = max(hi, p); }
  void include(const Box& b) { lo = min(lo, b.lo), hi = max(hi, b.hi); }

  bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
  Vec3<Real> extent() const { return hi - lo; }
  Vec3<Real> centre() const { return lo * Real{0.5} + hi * Real{0.5}; }

  /// Surface area S of equation (2), in double precision, whose range holds the squares of all floats; zero for an
  /// empty box.
  double surface_area() const {
    if (empty()) return 0;
    const Vec3<double> e(extent());
    return 2 * (e.x * e.y + e.y * e.z + e.z * e.x);
  }

  /// Whether the two closed boxes share a point.
  bool overlaps(const Box& b) const {
    return lo.x <= b.hi.x && b.lo.x <= hi.x && lo.y <= b.hi.y && b.lo.y <= hi.y && lo.z <= b.hi.z &&
           b.lo.z <= hi.z;
  }

  bool contains(const Box& b) const {
    return lo.x <= b.lo.x && b.hi.x <= hi.x && lo.y <= b.lo.y && b.hi.y <= hi.y && lo.z <= b.lo.z &&
           b.hi.z <= hi.z;
  }

  friend bool operator==(const Box&, const Box&) = default;
};

/// `ulps` units in the last place of a box's largest coordinate: so far off may a point be that was computed
/// with that many roundings.
template <class Real>
Real padding(Real largest_coordinate, int ulps = 4) {
  return static_cast<Real>(ulps) * std::numeric_limits<Real>::epsilon() * largest_coordinate;
}

/// The box grown on every side, so that a point computed with `ulps` roundings still lies inside.
template <class Real>
Box<Real> padded(const Box<Real>& box, int ulps = 4) {
  const Real pad = padding(std::max(max_abs(box.lo), max_abs(box.hi)), ulps);
  const Vec3<Real> margin{pad, pad, pad};
  return {box.lo - margin, box.hi + margin};
}

}  // namespace rayshoot
