#pragma once

#include <gmpxx.h>

#include <optional>
#include <vector>

#include "scenes/core/geometry.h"

/// Nearest hits by the textbook in rational arithmetic, without filter, hierarchy or cleverness. Square roots alone
/// are not exact: they have `kBits` bits, and parameters that agree in half of them are equal.
namespace rayshoot::rational {

inline constexpr int kBits = 6144;

using Vector = Vec3<mpq_class>;

template <class Real>
Vector vector(const Vec3<Real>& v) {
  return {mpq_class(v.x), mpq_class(v.y), mpq_class(v.z)};
}

inline bool same(const mpf_class& a, const mpf_class& b) {
  mpf_class scale(0, kBits), apart(0, kBits);
  scale = abs(a) + abs(b), apart = abs(a - b);
  mpf_class tolerance(0, kBits);
  mpf_div_2exp(tolerance.get_mpf_t(), scale.get_mpf_t(), kBits / 2);
  return apart <= tolerance;
}

inline mpf_class precise(const mpq_class& q) { return mpf_class(q, kBits); }

/// A line, an interval of it and the parameters at which it meets things.
template <class Real>
class RationalTracer {
 public:
  RationalTracer(const Geometry<Real>& geometry, const Ray<Real>& ray)
      : geometry_(geometry), ray_(ray), origin_(vector(ray.origin)), direction_(vector(ray.direction)) {}

  /// The first parameter at which the ray meets an object.
  std::optional<mpf_class> first(std::uint32_t object) const {
    switch (geometry_.kind(object)) {
      case ObjectKind::triangle:
        return on_triangle(geometry_.triangle(object));
      case ObjectKind::polygon:
        return on_polygon(geometry_.polygon_vertices(object), geometry_.polygon(object).dropped_axis);
      case ObjectKind::sphere:
        return on_sphere(geometry_.sphere(object));
      case ObjectKind::cone:
        return on_cone(geometry_.cone(object));
      case ObjectKind::placed:
        break;
    }
    return std::nullopt;
  }

 private:
  Vector at(const mpq_class& t) const { return origin_ + direction_ * t; }

  std::optional<mpf_class> confined(const mpf_class& t) const {
    const mpf_class t_min(static_cast<double>(ray_.t_min), kBits);
    if (t <= t_min || same(t, t_min)) return std::nullopt;
    if (ray_.t_max < kMiss<Real>) {
      const mpf_class t_max(static_cast<double>(ray_.t_max), kBits);
      if (t > t_max && !same(t, t_max)) return std::nullopt;
    }
    return t;
  }

  std::optional<mpf_class> on_triangle(const Triangle<Real>& triangle) const {
    const Vector corners[] = {vector(triangle.a), vector(triangle.b), vector(triangle.c)};
    const Vector normal = cross<mpq_class>(corners[1] - corners[0], corners[2] - corners[0]);
    const mpq_class approach = dot(normal, direction_);
    if (approach == 0) return std::nullopt;
    const mpq_class t = dot<mpq_class>(normal, corners[0] - origin_) / approach;
    const Vector point = at(t);
    for (int i = 0; i < 3; ++i) {
      const Vector edge = corners[(i + 1) % 3] - corners[i];
      if (dot<mpq_class>(normal, cross<mpq_class>(edge, point - corners[i])) < 0) return std::nullopt;
    }
    return confined(precise(t));
  }

  std::optional<mpf_class> on_polygon(std::span<const Vec3<Real>> vertices, int dropped_axis) const {
    Vector normal;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      normal += cross<mpq_class>(vector(vertices[i]), vector(vertices[(i + 1) % vertices.size()]));
    const mpq_class approach = dot(normal, direction_);
    if (approach == 0) return std::nullopt;
    const mpq_class t = dot<mpq_class>(normal, vector(vertices[0]) - origin_) / approach;
    const Vector point = at(t);
    const int u = (dropped_axis + 1) % 3, v = (dropped_axis + 2) % 3;
    bool inside = false;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const Vector a = vector(vertices[i]) - point, b = vector(vertices[(i + 1) % vertices.size()]) - point;
      const mpq_class side = a[u] * b[v] - a[v] * b[u];
      if (side == 0 && a[u] * b[u] <= 0 && a[v] * b[v] <= 0) return confined(precise(t));
      if ((a[v] > 0) != (b[v] > 0)) inside ^= (side > 0) == (b[v] > a[v]);
    }
    return inside ? confined(precise(t)) : std::nullopt;
  }

  /// The roots of a t^2 + 2 b t + c in increasing order; none where all coefficients are zero.
  static std::vector<mpf_class> roots(const mpq_class& a, const mpq_class& b, const mpq_class& c) {
    if (a == 0) return b == 0 ? std::vector<mpf_class>{} : std::vector<mpf_class>{precise(-c / (2 * b))};
    const mpq_class discriminant = b * b - a * c;
    if (discriminant < 0) return {};
    const mpf_class spread = sqrt(precise(discriminant / (a * a))), centre = precise(-b / a);
    // The smaller root by magnitude follows from the product of both, where nothing cancels.
    mpf_class larger(0, kBits), smaller(0, kBits);
    larger = centre < 0 ? mpf_class(centre - spread) : mpf_class(centre + spread);
    smaller = larger == 0 ? larger : mpf_class(precise(c / a) / larger);
    return larger < smaller ? std::vector{larger, smaller} : std::vector{smaller, larger};
  }

  std::optional<mpf_class> on_sphere(const Sphere<Real>& sphere) const {
    const Vector from_centre = origin_ - vector(sphere.centre);
    const mpq_class radius(sphere.radius);
    for (const mpf_class& t : roots(dot(direction_, direction_), dot(from_centre, direction_),
                                    dot(from_centre, from_centre) - radius * radius))
      if (const auto hit = confined(t)) return hit;
    return std::nullopt;
  }

  /// With heights h along the axis scaled to run from 0 to 1, the surface is where the vector from the axis is
  /// r0 + (r1 - r0) h long.
  std::optional<mpf_class> on_cone(const Cone<Real>& cone) const {
    const Vector axis = vector(cone.apex) - vector(cone.base), from_base = origin_ - vector(cone.base);
    const mpq_class square = dot(axis, axis), h0 = dot(from_base, axis) / square,
                    h1 = dot(direction_, axis) / square;
    const Vector aside = from_base - axis * h0, across = direction_ - axis * h1;
    const mpq_class widening = mpq_class(cone.apex_radius) - mpq_class(cone.base_radius);
    const mpq_class r0 = cone.base_radius + widening * h0, r1 = widening * h1;
    const mpq_class a = dot(across, across) - r1 * r1, b = dot(aside, across) - r0 * r1;
    for (const mpf_class& t : roots(a, b, dot(aside, aside) - r0 * r0)) {
      const mpf_class low(precise(h1) * t), base = precise(-h0), apex = precise(1 - h0);
      if ((low < base && !same(low, base)) || (low > apex && !same(low, apex))) continue;
      // Inside grows along the ray at an entry: the derivative a t + b is negative.
      const mpf_class slope = precise(a) * t;
      const bool enters = slope < precise(-b) && !same(slope, precise(-b));
      if (geometry_.cone_sides() == ConeSides::outside && !enters) continue;
      if (const auto hit = confined(t)) return hit;
    }
    return std::nullopt;
  }

  const Geometry<Real>& geometry_;
  const Ray<Real>& ray_;
  Vector origin_, direction_;
};

/// The nearest parameter and all objects there.
struct Nearest {
  std::optional<mpf_class> t;
  std::vector<std::uint32_t> objects;
};

template <class Real>
Nearest nearest(const Geometry<Real>& geometry, const Ray<Real>& ray) {
  const RationalTracer<Real> tracer(geometry, ray);
  Nearest nearest;
  for (std::uint32_t object = 0; object < geometry.size(); ++object) {
    const auto t = tracer.first(object);
    if (!t) continue;
    const bool tied = nearest.t && same(*t, *nearest.t);
    if (!tied && nearest.t && *t > *nearest.t) continue;
    if (!tied) nearest = {t, {}};
    nearest.objects.push_back(object);
  }
  return nearest;
}

}  // namespace rayshoot::rational
