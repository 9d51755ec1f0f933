// shift, STIFF 6: a scene far from the origin
//
// Construction  Objects of every kind whose numbers are even integers below 1024, translated by 2^k along all
//               axes: at k = 24 the lattice is that of the floats, so differences of vertices are the same
//               for every k, to the last bit. Rays run between points of the lattice, half of them to
//               vertices.
// Property      The same object at the same distance as without translation.
// Metric        Rate of changed answers as a function of k; the largest k without any.
// Size          k in steps of 4 in the short form, of 1 from size 2.
// Anchor        Translated by 2^17 a unit icosphere loses 8,455 of 10^6 random rays in Embree, 20,020 in
//               tinybvh, none in Embree ROBUST; by 2^21 Embree loses 421,909.

#include <fmt/format.h>

#include "scenes/stiff/parts/scenes.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

/// The largest step that keeps 2^24 + even integers floats.
constexpr double kLattice = 2, kHalfWidth = 1024;

std::vector<StiffSetting> settings(int size, std::uint64_t seed) {
  const Scene scene = placed(mixed_scene(seed, kLattice / kHalfWidth), kHalfWidth);
  std::vector<StiffSetting> result;
  const auto add = [&](const std::string& label, double shift) {
    const Vec3d offset{shift, shift, shift};
    const auto ray = [scene, offset](const RandomNumbers& random, std::uint64_t number) {
      Ray<double> moved = lattice_ray(scene, random, number, kLattice, kHalfWidth);
      moved.origin += offset;
      return moved;
    };
    result.push_back({.label = label,
                      .scene = share(placed(scene, 1, offset), fmt::format("shift({})", label)),
                      .rays = ray_by_ray(ray),
                      .property = result.empty() ? Property::as_oracle : Property::same_as_base,
                      .base = 0,
                      .stiffness_parameter = shift / kHalfWidth,
                      .default_rays = 1000});
  };
  add("k=none", 0);
  for (int k = 0; k <= 24; k += size > 1 ? 1 : 4) add(fmt::format("k={}", k), std::ldexp(1, k));
  return result;
}

}  // namespace

const StiffCase& stiff_shift() {
  static const StiffCase entry{
      .id = "shift",
      .number = 6,
      .title = "Scene translated by 2^k",
      .construction =
          "a scene on a coarse lattice translated by 2^k, k = 0 to 24, bit-identical up to the translation",
      .property = "answers identical to those at the origin",
      .metric = "rate of changed answers; the largest k without one",
      .settings = settings};
  return entry;
}

}  // namespace rayshoot
