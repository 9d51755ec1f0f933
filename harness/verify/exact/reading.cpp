#include "harness/verify/exact/reading.h"

#include "harness/verify/exact/bounds.h"
#include "harness/verify/exact/firm.h"
#include "harness/verify/exact/hierarchy.h"

namespace rayshoot::exact {

template <class Real>
std::optional<double> entry(const ExactContacts<Real>& contacts, std::uint32_t object, const Ray<Real>& ray) {
  Box<double> box = exact_bounds(contacts, object);
  const Vec3d origin(ray.origin);
  const double largest = std::max({max_abs(box.lo), max_abs(box.hi), max_abs(origin)});
  const double margin = 4.0 * static_cast<double>(std::numeric_limits<Real>::epsilon()) * largest;
  box = {box.lo - Vec3d{margin, margin, margin}, box.hi + Vec3d{margin, margin, margin}};
  const SlabRay slabs(origin, Vec3d(ray.direction), ray.t_min);
  const auto enter = slabs.entry(box, slabs.scaled(ray.t_max));
  if (!enter) return std::nullopt;
  return std::max<double>(slabs.unscaled(*enter), ray.t_min);
}

template <class Real>
Reading read(const ExactContacts<Real>& contacts, std::uint32_t object, const Ray<Real>& ray) {
  const ObjectKind kind = contacts.geometry().kind(object);
  const bool flat = kind == ObjectKind::triangle || kind == ObjectKind::polygon;
  return flat ? read_flat(contacts, object, ray) : read_quadric(contacts, object, ray);
}

template std::optional<double> entry(const ExactContacts<float>&, std::uint32_t, const Ray<float>&);
template std::optional<double> entry(const ExactContacts<double>&, std::uint32_t, const Ray<double>&);
template Reading read(const ExactContacts<float>&, std::uint32_t, const Ray<float>&);
template Reading read(const ExactContacts<double>&, std::uint32_t, const Ray<double>&);

}  // namespace rayshoot::exact
