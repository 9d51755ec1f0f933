#include "scenes/rays/ray_set.h"

#include "scenes/core/digest.h"

namespace rayshoot {

std::string RaySet::hash() const {
  Digest digest;
  digest.add_all(rays);
  digest.add(static_cast<std::uint64_t>(closest_rays));
  return digest.hex();
}

namespace {

/// How far along a ray its rounded origin may lie off the surface it starts on: 32 ulps of its largest
/// coordinate.
template <class Real>
Real rounding_of_origin(const Ray<Real>& ray) {
  const Real size = max_abs(ray.origin), speed = length(ray.direction);
  return speed > 0 ? 32 * std::numeric_limits<Real>::epsilon() * size / speed : 0;
}

template <class Real>
Ray<Real> rounded(const Ray<double>& ray, bool starts_on_surface) {
  if constexpr (std::is_same_v<Real, double>) return ray;
  Ray<Real> result{Vec3<Real>(ray.origin), static_cast<Real>(ray.t_min), Vec3<Real>(ray.direction)};
  if (ray.t_max < std::numeric_limits<Real>::max()) result.t_max = static_cast<Real>(ray.t_max);
  if (starts_on_surface) result.t_min = std::max(result.t_min, rounding_of_origin(result));
  return result;
}

}  // namespace

template <class Real>
std::vector<Ray<Real>> rays_in(const RaySet& set) {
  std::vector<Ray<Real>> rays;
  rays.reserve(set.rays.size());
  for (std::size_t i = 0; i < set.rays.size(); ++i)
    rays.push_back(rounded<Real>(set.rays[i], set.origins[i].source_object != kNoObject));
  return rays;
}

template std::vector<Ray<float>> rays_in<float>(const RaySet&);
template std::vector<Ray<double>> rays_in<double>(const RaySet&);

}  // namespace rayshoot
