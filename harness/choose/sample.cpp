#include "harness/choose/sample.h"

#include <algorithm>
#include <random>
#include <span>

namespace rayshoot {

namespace {

/// Append runs of `neighbours` rays out of strata of `stratum` rays.
void append(std::vector<Ray<double>>& sample, std::span<const Ray<double>> rays, std::size_t stratum,
            std::size_t neighbours, std::mt19937_64& generator) {
  for (std::size_t first = 0; first < rays.size(); first += stratum) {
    const std::size_t size = std::min(stratum, rays.size() - first), run = std::min(neighbours, size);
    // The distributions of the standard library differ between platforms; this remainder does not.
    const std::size_t start = first + generator() % (size - run + 1);
    sample.insert(sample.end(), rays.begin() + static_cast<std::ptrdiff_t>(start),
                  rays.begin() + static_cast<std::ptrdiff_t>(start + run));
  }
}

}  // namespace

RaySet stratified(const RaySet& set, std::size_t count, std::size_t neighbours, std::uint64_t seed) {
  RaySet sample{.id = set.id, .distribution = set.distribution, .rules = set.rules};
  const std::size_t strata = std::max<std::size_t>(1, count / neighbours);
  const std::size_t stratum = std::max(neighbours, (set.rays.size() + strata - 1) / strata);
  const std::span<const Ray<double>> rays = set.rays;
  std::mt19937_64 generator(seed);
  append(sample.rays, rays.first(set.closest_rays), stratum, neighbours, generator);
  sample.closest_rays = sample.rays.size();
  append(sample.rays, rays.subspan(set.closest_rays), stratum, neighbours, generator);
  return sample;
}

}  // namespace rayshoot
