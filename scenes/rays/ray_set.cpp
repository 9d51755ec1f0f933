#include "scenes/rays/ray_set.h"

#include "scenes/core/digest.h"

namespace rayshoot {

std::string RaySet::hash() const {
  Digest digest;
  for (const Ray<double>& ray : rays)
    digest.add(ray.origin), digest.add(ray.t_min), digest.add(ray.direction), digest.add(ray.t_max);
  // Where nothing moves, times say nothing.
  if (std::any_of(rays.begin(), rays.end(), [](const Ray<double>& ray) { return ray.time != 0; }))
    for (const Ray<double>& ray : rays) digest.add(ray.time);
  digest.add(static_cast<std::uint64_t>(closest_rays));
  return digest.hex();
}

namespace {

/// How far along a ray a surface met under that cosine may have moved when its point, the ray's direction and
/// the objects were rounded: by 4 ulps of the largest coordinate across. Below a thousandth the cosine counts
/// as that, lest a ray in the surface sees nothing at all.
template <class Real>
Real rounding_along(const Vec3d& origin, const Vec3d& target, float cosine) {
  const double size = std::max(max_abs(origin), max_abs(target));
  return static_cast<Real>(4 * std::numeric_limits<Real>::epsilon() * size / std::max(cosine, 1e-3f));
}

template <class Real>
Ray<Real> rounded(const Ray<double>& ray, const RayOrigin& origin) {
  if constexpr (std::is_same_v<Real, double>) return ray;
  Ray<Real> result{Vec3<Real>(ray.origin), static_cast<Real>(ray.t_min), Vec3<Real>(ray.direction)};
  result.time = static_cast<Real>(ray.time);
  if (ray.t_max < std::numeric_limits<Real>::max()) result.t_max = static_cast<Real>(ray.t_max);
  if (origin.source_object != kNoObject)
    result.t_min = std::max(result.t_min, rounding_along<Real>(ray.origin, ray.origin, origin.cosine));
  if (origin.kind == RayKind::light)
    result.t_max -= rounding_along<Real>(ray.origin, ray.at(ray.t_max), origin.cosine);
  return result;
}

}  // namespace

template <class Real>
std::vector<Ray<Real>> rays_in(const RaySet& set) {
  std::vector<Ray<Real>> rays;
  rays.reserve(set.rays.size());
  for (std::size_t i = 0; i < set.rays.size(); ++i)
    rays.push_back(rounded<Real>(set.rays[i], set.origins[i]));
  return rays;
}

template std::vector<Ray<float>> rays_in<float>(const RaySet&);
template std::vector<Ray<double>> rays_in<double>(const RaySet&);

}  // namespace rayshoot
