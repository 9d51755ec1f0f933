// scale_decimal, STIFF 8: a scene scaled by 10^k
//
// Construction  Triangles, spheres and cones scaled by 10^k and rounded to floats; rays, half of them to
//               vertices, likewise. Unlike powers of two these scales change the bits, so there is no base to
//               compare with.
// Property      Graded by the oracle, setting by setting.
// Metric        Rate of wrong answers by class.
// Size          k in steps of 4 in the short form, of 1 from size 2.
// Anchor        A triangle test that rejects determinants under 1e-6 loses 84 % of its hits at 1e-3 and all
//               at 1e-12.

#include <fmt/format.h>

#include "scenes/stiff/parts/scenes.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

constexpr double kLattice = 0x1p-20;

std::vector<StiffSetting> settings(int size, std::uint64_t seed) {
  SceneBuilder builder;
  add_scattered(builder, {.triangles = 120, .spheres = 40, .cones = 40}, RandomNumbers(seed), 0.25, kLattice);
  const Scene scene = std::move(builder).finish();
  std::vector<StiffSetting> result;
  for (int k = -12; k <= 12; k += size > 1 ? 1 : 4) {
    const double scale = std::pow(10, k);
    const auto ray = [scene, scale](const RandomNumbers& random, std::uint64_t number) {
      const Ray<double> unscaled = lattice_ray(scene, random, number, kLattice, 1);
      return ray_to(unscaled.origin * scale, unscaled.at(1) * scale);
    };
    result.push_back({.label = fmt::format("k={}", k),
                      .scene = share(placed(scene, scale), fmt::format("scale_decimal(k={})", k)),
                      .rays = ray_by_ray(ray),
                      .stiffness_parameter = static_cast<double>(k),
                      .default_rays = 1000});
  }
  return result;
}

}  // namespace

const StiffCase& stiff_scale_decimal() {
  static const StiffCase entry{
      .id = "scale_decimal",
      .number = 8,
      .title = "Scene scaled by 10^k",
      .construction = "a scene and its rays scaled by 10^k, k = -12 to 12, and rounded to floats",
      .property = "graded by the oracle",
      .metric = "rate of wrong answers",
      .settings = settings};
  return entry;
}

}  // namespace rayshoot
