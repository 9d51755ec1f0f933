// dir_scale, STIFF 9: directions of any length
//
// Construction  Objects of every kind; rays between points of a lattice, half of them to vertices, with
//               directions multiplied by 2^k.
// Property      The same object at 2^-k times the distance, exactly.
// Metric        Rate of changed answers as a function of k.
// Size          Seven lengths in the short form, steps of 5 from size 2.
// Anchor        Embree raises components of directions under 1e-18 to that; rays to vertices with directions
//               of length 1e-18 or 1e17 miss all of an icosphere in Embree.

#include <fmt/format.h>

#include "scenes/stiff/parts/scenes.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

constexpr double kLattice = 0x1p-20;

std::vector<int> exponents(int size) {
  if (size == 1) return {0, -100, -62, -10, 10, 62, 100};
  std::vector<int> result{0};
  for (int k = -100; k <= 100; k += 5)
    if (k != 0) result.push_back(k);
  return result;
}

std::vector<StiffSetting> settings(int size, std::uint64_t seed) {
  const auto scene = share(mixed_scene(seed, kLattice), "dir_scale(scene=mixed)");
  std::vector<StiffSetting> result;
  for (const int k : exponents(size)) {
    const double scale = std::ldexp(1, k);
    const auto ray = [scene, scale](const RandomNumbers& random, std::uint64_t number) {
      Ray<double> longer = lattice_ray(*scene, random, number, kLattice, 1);
      longer.direction *= scale;
      return longer;
    };
    result.push_back({.label = fmt::format("k={}", k),
                      .scene = scene,
                      .rays = ray_by_ray(ray),
                      .property = k == 0 ? Property::as_oracle : Property::same_as_base,
                      .t_scale = 1 / scale,
                      .base = 0,
                      .stiffness_parameter = static_cast<double>(k),
                      .default_rays = 1000});
  }
  return result;
}

}  // namespace

const StiffCase& stiff_dir_scale() {
  static const StiffCase entry{.id = "dir_scale",
                               .number = 9,
                               .title = "Directions scaled by 2^k",
                               .construction = "rays whose directions are scaled by 2^k, k = -100 to 100",
                               .property = "the same object, the distance scaled by 2^-k exactly",
                               .metric = "rate of changed answers",
                               .settings = settings};
  return entry;
}

}  // namespace rayshoot
