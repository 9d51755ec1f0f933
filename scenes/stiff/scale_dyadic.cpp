// scale_dyadic, STIFF 7: a scene scaled by 2^k
//
// Construction  Objects of every kind inside the cube of half width 0.45; rays start beyond 1.5 and have
//               directions of unit length, so that distances are between 1 and 4, and stay normal floats at
//               every scale. Scene and origins are multiplied by 2^k, directions stay.
// Property      The same object at 2^k times the distance, exactly: nothing but exponents differs. Where a
//               precision sets the objects aside as out of range, it does so with all of them: a refusal.
// Metric        Rate of changed answers; the interval of k without any.
// Size          Nine scales in the short form, steps of 6 from size 2, of 1 from size 4.
// Anchor        tinybvh loses all rays at a scale of 1e-3, Embree and Embree ROBUST at 1e-18; at 1e17 Embree
//               loses 58,534 random rays of 10^6.

#include <fmt/format.h>

#include "scenes/stiff/parts/scenes.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

constexpr double kLattice = 0x1p-20, kHalfWidth = 0.4375;

/// From beyond the scene, across the faces of a cube of half width 1.5 to 1.75, with unit direction.
Ray<double> unit_ray(const Scene& scene, const RandomNumbers& random, std::uint64_t number) {
  const Ray<double> inner = lattice_ray(scene, random, number, kLattice, kHalfWidth);
  const Vec3d target = inner.at(1);
  Vec3d origin = point_in_cube(random, number, 10) * 1.5;
  const int axis = pick(random, number, 13, 0, 2);
  origin[axis] = std::copysign(1.625, origin[axis]);
  origin = snapped(origin, kLattice);
  return {.origin = origin, .direction = rounded(normalized(target - origin))};
}

std::vector<int> exponents(int size) {
  if (size == 1) return {0, -126, -100, -60, -20, 20, 60, 100, 126};
  std::vector<int> result{0};
  for (int k = -126; k <= 126; k += size < 4 ? 6 : 1)
    if (k != 0) result.push_back(k);
  return result;
}

std::vector<StiffSetting> settings(int size, std::uint64_t seed) {
  const Scene scene = placed(mixed_scene(seed, 0x1p-16), kHalfWidth);
  std::vector<StiffSetting> result;
  for (const int k : exponents(size)) {
    const double scale = std::ldexp(1, k);
    const auto ray = [scene, scale](const RandomNumbers& random, std::uint64_t number) {
      Ray<double> ray_at_scale = unit_ray(scene, random, number);
      ray_at_scale.origin *= scale;
      return ray_at_scale;
    };
    result.push_back({.label = fmt::format("k={}", k),
                      .scene = share(placed(scene, scale), fmt::format("scale_dyadic(k={})", k)),
                      .rays = ray_by_ray(ray),
                      .property = k == 0 ? Property::as_oracle : Property::same_as_base,
                      .t_scale = scale,
                      .base = 0,
                      .stiffness_parameter = static_cast<double>(k),
                      .default_rays = 1000});
  }
  return result;
}

}  // namespace

const StiffCase& stiff_scale_dyadic() {
  static const StiffCase entry{.id = "scale_dyadic",
                               .number = 7,
                               .title = "Scene scaled by 2^k",
                               .construction =
                                   "a scene and the origins of its rays scaled by 2^k, k = -126 to 126, "
                                   "which changes no bit but exponents",
                               .property = "the same object, the distance scaled by 2^k exactly",
                               .metric = "rate of changed answers; the interval of k without one",
                               .settings = settings};
  return entry;
}

}  // namespace rayshoot
