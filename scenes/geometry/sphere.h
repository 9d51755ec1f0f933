#pragma once

#include "scenes/geometry/ray.h"

namespace rayshoot {

template <class Real>
struct Sphere {
  Vec3<Real> centre;
  Real radius{};

  friend bool operator==(const Sphere&, const Sphere&) = default;
};

/// The sphere's own extent, rounded but not padded.
template <class Real>
Box<Real> exact_bounds(const Sphere<Real>& sphere) {
  const Vec3<Real> r{sphere.radius, sphere.radius, sphere.radius};
  return {sphere.centre - r, sphere.centre + r};
}

template <class Real>
Box<Real> bounds(const Sphere<Real>& sphere) {
  return padded(exact_bounds(sphere));
}

/// Two-sided ray-sphere test: the nearer of the two crossings that lies in the ray's interval. Solved in double
/// precision from the point of the ray nearest to the centre, which keeps the discriminant free of cancellation.
template <class Real>
Real hit_distance(const Sphere<Real>& sphere, const Ray<Real>& ray) {
  const Vec3d direction(ray.direction);
  const Vec3d to_centre = Vec3d(sphere.centre) - Vec3d(ray.origin);
  const double length_squared = dot(direction, direction);
  const double nearest = dot(to_centre, direction) / length_squared;
  const Vec3d offset = to_centre - direction * nearest;
  const double radius = sphere.radius;
  const double discriminant = radius * radius - dot(offset, offset);
  if (!(discriminant >= 0)) return kMiss<Real>;

  const double half_chord = std::sqrt(discriminant / length_squared);
  const Box<Real> box = bounds(sphere);
  const Real entry = confine(nearest - half_chord, box, ray);
  return entry < kMiss<Real> ? entry : confine(nearest + half_chord, box, ray);
}

}  // namespace rayshoot
