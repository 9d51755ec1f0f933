#pragma once

#include <optional>
#include <vector>

#include "harness/verify/exact/forms.h"

namespace rayshoot::exact {

/// Where a ray first meets an object: which root of the object's polynomial that is, and its parameter to
/// within a bound. `ExactContacts::root` has it exactly.
struct Contact {
  std::uint32_t object = kNoObject;
  int side = 0;
  Bounded<double> t;
};

/// A ray that can hit something, with finite ends: nothing where its numbers are not finite, its direction is zero
/// or its interval empty.
template <class Real>
std::optional<Ray<Real>> usable(Ray<Real> ray) {
  ray.t_max = std::min(ray.t_max, std::numeric_limits<Real>::max());
  const bool finite = is_finite(ray.origin) && is_finite(ray.direction) && std::isfinite(ray.t_min);
  return finite && max_abs(ray.direction) > 0 && ray.t_max > ray.t_min ? std::optional(ray) : std::nullopt;
}

template <class Number, class Real>
Vec3<Number> numbers(const Vec3<Real>& v) {
  return {Number(v.x), Number(v.y), Number(v.z)};
}
template <class Number, class Real>
Line<Number> line_of(const Ray<Real>& ray) {
  return {numbers<Number>(ray.origin), numbers<Number>(ray.direction)};
}
template <class Number, class Real>
std::vector<Vec3<Number>> numbers(std::span<const Vec3<Real>> vertices) {
  std::vector<Vec3<Number>> result;
  result.reserve(vertices.size());
  for (const Vec3<Real>& vertex : vertices) result.push_back(numbers<Number>(vertex));
  return result;
}

/// The exact ray-object test of a geometry: decided in double precision where the error bound allows, else in
/// exact arithmetic. All rays must be
/// `usable`. Borders belong to objects; a ray in the plane of a triangle or
/// polygon, or along a line in the surface of a cone, misses.
template <class Real>
class ExactContacts {
 public:
  explicit ExactContacts(const Geometry<Real>& geometry);

  const Geometry<Real>& geometry() const { return geometry_; }
  /// The first contact with an object in the ray's interval.
  std::optional<Contact> first(std::uint32_t object, const Ray<Real>& ray) const;
  /// The sign of a.t - b.t.
  int compare(const Contact& a, const Contact& b, const Ray<Real>& ray) const;

  ExactRoot root(const Contact& contact, const Ray<Real>& ray) const { return root<Dyadic>(contact, ray); }
  /// The parameter of a contact with numbers of another kind.
  template <class Number>
  Root<Number> root(const Contact& contact, const Ray<Real>& ray) const;
  /// Vertices must be those of a polygon object.
  Vec3<Bounded<double>> bounded_normal(std::uint32_t object) const {
    return polygon_normals_[geometry_.index(object)];
  }

 private:
  std::optional<Contact> triangle_contact(std::uint32_t object, const Ray<Real>& ray) const;

  const Geometry<Real>& geometry_;
  std::vector<Vec3<Bounded<double>>> polygon_normals_;
};

extern template class ExactContacts<float>;
extern template class ExactContacts<double>;

}  // namespace rayshoot::exact
