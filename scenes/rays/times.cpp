#include "scenes/rays/times.h"

#include "scenes/rays/random.h"

namespace rayshoot {

namespace {

/// Apart from the dimensions in which distributions ask for random numbers.
constexpr std::uint64_t kTimeDimension = 1000;

}  // namespace

void set_times(std::span<Ray<double>> rays, const Scene& scene, std::uint64_t seed) {
  if (!has_motion(scene)) return;
  const RandomNumbers random(seed);
  for (std::size_t ray = 0; ray < rays.size(); ++ray) rays[ray].time = random.uniform(ray, kTimeDimension);
}

}  // namespace rayshoot
