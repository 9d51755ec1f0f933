// coplanar_pile, STIFF 13: coincident copies
//
// Construction  One triangle, 64 others scattered about it, and then n - 1 more copies of the first. No split
//               separates the copies; the one with the lowest number must win every tie.
// Property      The same objects and distances as with a single copy.
// Metric        Depth, references, build time and memory against n; answers by thread count.
// Size          n up to 1000 in the short form, 10,000 from size 2, 100,000 from size 4.
// Anchor        Embree builds 1,000 to 100,000 coincident copies in its overlapping_primitives test, and
//               shoots no ray at them.

#include <fmt/format.h>

#include "scenes/stiff/parts/scenes.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

constexpr double kLattice = 0x1p-20;

std::shared_ptr<const Scene> pile(int copies, std::uint64_t seed) {
  SceneBuilder builder;
  const auto add_copy = [&] { builder.triangle({-0.75, -0.75, -0.125}, {0.75, -0.5, 0}, {0, 0.75, 0.25}); };
  add_copy();
  add_scattered(builder, {.triangles = 64}, RandomNumbers(seed), 0.25, kLattice);
  for (int i = 1; i < copies; ++i) add_copy();
  return share(std::move(builder), fmt::format("coplanar_pile(copies={})", copies));
}

std::vector<StiffSetting> settings(int size, std::uint64_t seed) {
  const int most = size >= 4 ? 100'000 : size >= 2 ? 10'000 : 1000;
  std::vector<StiffSetting> result;
  for (int copies = 1; copies <= most; copies *= 10) {
    const auto scene = pile(copies, seed);
    // The rays of one copy for all: later copies add nothing to aim at.
    const auto target = copies == 1 ? scene : result[0].scene;
    result.push_back({.label = fmt::format("copies={}", copies),
                      .scene = scene,
                      .rays = ray_by_ray([target](const RandomNumbers& random, std::uint64_t number) {
                        return lattice_ray(*target, random, number, kLattice, 0.75);
                      }),
                      .property = copies == 1 ? Property::as_oracle : Property::same_as_base,
                      .base = 0,
                      .stiffness_parameter = static_cast<double>(copies),
                      .default_rays = 1000});
  }
  return result;
}

}  // namespace

const StiffCase& stiff_coplanar_pile() {
  static const StiffCase entry{.id = "coplanar_pile",
                               .number = 13,
                               .title = "Coincident copies",
                               .construction = "n copies of one triangle among others, n = 1 to 100,000",
                               .property = "the copy with the lowest number wins, and the build ends",
                               .metric = "depth, build time; digest of answers over threads",
                               .settings = settings};
  return entry;
}

}  // namespace rayshoot
