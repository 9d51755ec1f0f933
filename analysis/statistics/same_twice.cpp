#include "analysis/statistics/same_twice.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>

#include "analysis/statistics/rank_sum.h"

namespace rayshoot::analysis {

namespace {

constexpr std::size_t kLeastValues = 8;

bool halves_differ(std::span<const double> sample) {
  const std::size_t half = sample.size() / 2;
  const auto first = sample.first(half), second = sample.last(half);
  const double chance = std::min(chance_of_ranks(first, second), chance_of_ranks(second, first));
  return chance <= (1 - kConfidence) / 2;
}

}  // namespace

SameTwice same_twice(std::span<const std::vector<double>> samples) {
  SameTwice result;
  for (const std::vector<double>& sample : samples) {
    if (sample.size() < kLeastValues) continue;
    ++result.samples;
    result.differ += halves_differ(sample);
  }
  if (result.differ == 0) return result;
  const boost::math::binomial by_chance(static_cast<double>(result.samples), 1 - kConfidence);
  result.chance = cdf(complement(by_chance, static_cast<double>(result.differ - 1)));
  return result;
}

}  // namespace rayshoot::analysis
