// denormal, STIFF 19: numbers below the smallest normal float
//
// Construction  Objects of every kind and rays on a lattice of 2^-20, scaled down so that the lattice is
//               2^-149, the smallest float: coordinates alone, directions alone, or both. At 2^-124 some
//               numbers are denormal and some are not.
// Property      Where distances remain floats (coordinates and directions scaled alike, or directions alone):
//               the same object at the same or the scaled distance. With denormal coordinates alone distances
//               are denormal too and round: graded by the oracle.
// Metric        Rate of changed answers, in the IEEE mode and where the processor flushes denormals to zero
//               (FTZ and DAZ, which are the harness's to set).
// Size          The same settings at every size.
// Anchor        Embree's verify runs with FTZ and DAZ set, and thus never tests denormals; at 1e-12 that mode
//               loses all rays whose directions are as small.

#include <fmt/format.h>

#include <array>

#include "scenes/stiff/parts/scenes.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

constexpr double kLattice = 0x1p-20;

std::vector<StiffSetting> settings(int, std::uint64_t seed) {
  struct Scales {
    const char* label;
    int coordinates, directions;
    Property property;
  };
  constexpr std::array kScales = {
      Scales{"coordinates=2^0,directions=2^0", 0, 0, Property::as_oracle},
      Scales{"coordinates=2^-124,directions=2^-124", -124, -124, Property::same_as_base},
      Scales{"coordinates=2^-129,directions=2^-129", -129, -129, Property::same_as_base},
      Scales{"coordinates=2^-4,directions=2^-129", -4, -129, Property::same_as_base},
      Scales{"coordinates=2^-129,directions=2^0", -129, 0, Property::as_oracle}};
  const Scene scene = mixed_scene(seed, kLattice);
  std::vector<StiffSetting> result;
  for (const auto& [label, coordinates, directions, property] : kScales) {
    const double scale = std::ldexp(1, coordinates), speed = std::ldexp(1, directions);
    const auto ray = [=](const RandomNumbers& random, std::uint64_t number) {
      Ray<double> small = lattice_ray(scene, random, number, kLattice, 0.5);
      small.origin *= scale, small.direction *= speed;
      return small;
    };
    result.push_back(
        {.label = label,
         .scene = share(placed(scene, scale), fmt::format("denormal(coordinates=2^{})", coordinates)),
         .rays = ray_by_ray(ray),
         .property = property,
         .t_scale = scale / speed,
         .base = 0,
         .stiffness_parameter = std::min(scale, speed),
         .default_rays = 1000});
  }
  return result;
}

}  // namespace

const StiffCase& stiff_denormal() {
  static const StiffCase entry{.id = "denormal",
                               .number = 19,
                               .title = "Denormal coordinates and directions",
                               .construction = "coordinates, directions or both between 2^-149 and 2^-126",
                               .property = "the same answers as in the normal range",
                               .metric = "rate of changed answers, with denormals and with flush to zero",
                               .settings = settings};
  return entry;
}

}  // namespace rayshoot
