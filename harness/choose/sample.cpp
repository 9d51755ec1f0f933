#include "harness/choose/sample.h"

#include <algorithm>
#include <random>

namespace rayshoot {

namespace {

/// Append runs of `neighbours` of the rays [first, last) of a set, one out of every `stratum` rays.
void append(RaySet& sample, const RaySet& set, std::size_t first, std::size_t last, std::size_t stratum,
            std::size_t neighbours, std::mt19937_64& generator) {
  for (; first < last; first += stratum) {
    const std::size_t size = std::min(stratum, last - first), run = std::min(neighbours, size);
    // The distributions of the standard library differ between platforms; this remainder does not.
    const std::size_t start = first + generator() % (size - run + 1);
    for (std::size_t ray = start; ray < start + run; ++ray) {
      sample.rays.push_back(set.rays[ray]);
      sample.origins.push_back(set.origins[ray]);
    }
  }
}

}  // namespace

RaySet stratified(const RaySet& set, std::size_t count, std::size_t neighbours, std::uint64_t seed) {
  RaySet sample{.id = set.id, .distribution = set.distribution, .rules = set.rules};
  const std::size_t strata = std::max<std::size_t>(1, count / neighbours);
  const std::size_t stratum = std::max(neighbours, (set.rays.size() + strata - 1) / strata);
  std::mt19937_64 generator(seed);
  append(sample, set, 0, set.closest_rays, stratum, neighbours, generator);
  sample.closest_rays = sample.rays.size();
  append(sample, set, set.closest_rays, set.rays.size(), stratum, neighbours, generator);
  return sample;
}

}  // namespace rayshoot
