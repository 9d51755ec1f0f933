#pragma once

#include <array>
#include <optional>

#include "scenes/geometry/ray.h"

namespace rayshoot {

/// An open cone or cylinder as in NFF: the lateral surface between two circles, no caps.
template <class Real>
struct Cone {
  Vec3<Real> base;
  Real base_radius{};
  Vec3<Real> apex;
  Real apex_radius{};

  friend bool operator==(const Cone&, const Cone&) = default;
};

/// The union of the boxes of the two end circles: a circle of radius r with unit axis w reaches
/// r sqrt(1 - w_k^2) along axis k.
template <class Real>
Box<double> exact_bounds(const Cone<Real>& cone) {
  const Vec3d base(cone.base), apex(cone.apex);
  const Vec3d axis = normalized(apex - base);
  const auto reach = [](double w) { return std::sqrt(std::max(0.0, 1 - w * w)); };
  const Vec3d unit{reach(axis.x), reach(axis.y), reach(axis.z)};
  Box<double> box;
  box.include(Box<double>{base - unit * cone.base_radius, base + unit * cone.base_radius});
  box.include(Box<double>{apex - unit * cone.apex_radius, apex + unit * cone.apex_radius});
  return box;
}

template <class Real>
Box<Real> bounds(const Cone<Real>& cone) {
  const Box<double> box = exact_bounds(cone);
  return padded(Box<Real>{Vec3<Real>(box.lo), Vec3<Real>(box.hi)});
}

/// The quadratic f(s) = a s^2 + 2 b s + c that is negative inside the infinite cone, and what is needed to tell
/// where along the axis a root lies. The parameter s counts from the point of the ray nearest to the axis, or to the cone's
/// middle where that is far beyond its ends, at distance `nearest`: this keeps far origins, and long cones, from cancelling in
/// the discriminant.
struct ConeEquation {
  double nearest;
  double a, b, c;
  double axial_origin, axial_direction;
  double height;

  template <class Real>
  ConeEquation(const Cone<Real>& cone, const Ray<Real>& ray) {
    const Vec3d base(cone.base), span = Vec3d(cone.apex) - base;
    height = length(span);
    const Vec3d axis = span * (1 / height);
    const double slope = (static_cast<double>(cone.apex_radius) - cone.base_radius) / height;
    const double radius = cone.base_radius;
    const Vec3d direction(ray.direction), from_base = Vec3d(ray.origin) - base;
    axial_direction = dot(direction, axis);
    const Vec3d across = direction - axis * axial_direction;
    Vec3d aside;
    const auto count_from = [&](double s) {
      const Vec3d origin = from_base + direction * s;
      nearest = s;
      axial_origin = dot(origin, axis);
      aside = origin - axis * axial_origin;
    };
    count_from(dot(span * 0.5 - from_base, direction) / dot(direction, direction));
    const double to_axis = -dot(aside, across) / dot(across, across);
    const double axial_there = axial_origin + to_axis * axial_direction;
    if (axial_there > -height && axial_there < 2 * height) count_from(nearest + to_axis);
    const double radius_at_origin = radius + slope * axial_origin;
    const double widening = slope * axial_direction;
    a = dot(across, across) - widening * widening;
    b = dot(aside, across) - radius_at_origin * widening;
    c = dot(aside, aside) - radius_at_origin * radius_at_origin;
  }

  /// Both roots in increasing order, or none; a root at infinity is not a number or infinite.
  std::optional<std::array<double, 2>> roots() const {
    const double discriminant = b * b - a * c;
    if (!(discriminant >= 0)) return std::nullopt;
    const double q = -(b + std::copysign(std::sqrt(discriminant), b));
    const double first = q / a, second = c / q;
    return first < second ? std::array{first, second} : std::array{second, first};
  }

  bool on_segment(double s) const {
    const double height_at_hit = axial_origin + s * axial_direction;
    return height_at_hit >= 0 && height_at_hit <= height;
  }
  bool enters_at(double s) const { return a * s + b < 0; }
};

/// Ray-cone test in double precision: the nearest crossing between the end circles that lies in the ray's
/// interval. Where `outside_only` is set, a surface met from within is invisible, as in the tracer behind
/// Havran's published counts.
template <class Real>
Real hit_distance(const Cone<Real>& cone, const Ray<Real>& ray, bool outside_only = false) {
  const ConeEquation equation(cone, ray);
  const auto roots = equation.roots();
  if (!roots) return kMiss<Real>;
  for (const double s : *roots) {
    if (!equation.on_segment(s) || (outside_only && !equation.enters_at(s))) continue;
    const Real hit = confine(equation.nearest + s, bounds(cone), ray);
    if (hit < kMiss<Real>) return hit;
  }
  return kMiss<Real>;
}

}  // namespace rayshoot
