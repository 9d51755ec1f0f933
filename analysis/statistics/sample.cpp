#include "analysis/statistics/sample.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

#include "analysis/statistics/rank_sum.h"

namespace rayshoot::analysis {

namespace {

double median_of_sorted(const std::vector<double>& sorted) {
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : std::midpoint(sorted[half - 1], sorted[half]);
}

/// How many values at each end of a sorted sample lie outside the interval of the median, at most: the number of
/// values below the median is binomial with chance one half, so k of them outside leave out the median with
/// chance P(X < k) on either side. None when even the whole range is too narrow.
std::size_t values_outside(std::size_t count, double confidence) {
  const boost::math::binomial values_below(static_cast<double>(count), 0.5);
  std::size_t outside = 0;
  while (cdf(values_below, static_cast<double>(outside)) <= (1 - confidence) / 2) ++outside;
  return outside;
}

std::optional<Estimate> paired_ratio(std::span<const double> numerator, std::span<const double> denominator,
                                     double confidence) {
  std::vector<double> logarithms(numerator.size());
  std::transform(numerator.begin(), numerator.end(), denominator.begin(), logarithms.begin(),
                 [](double above, double below) { return std::log(above / below); });
  auto estimate = median(logarithms, confidence);
  estimate->value = std::exp(estimate->value);
  if (auto& interval = estimate->interval) interval = {std::exp(interval->low), std::exp(interval->high)};
  return estimate;
}

}  // namespace

std::optional<Estimate> median(std::span<const double> sample, double confidence) {
  if (sample.empty()) return std::nullopt;
  std::vector<double> sorted(sample.begin(), sample.end());
  std::sort(sorted.begin(), sorted.end());
  Estimate estimate{median_of_sorted(sorted), std::nullopt};
  if (const std::size_t outside = values_outside(sorted.size(), confidence); outside > 0)
    estimate.interval = {sorted[outside - 1], sorted[sorted.size() - outside]};
  return estimate;
}

std::optional<Estimate> mean(std::span<const double> sample, double confidence) {
  if (sample.empty()) return std::nullopt;
  const double count = static_cast<double>(sample.size());
  Estimate estimate{std::accumulate(sample.begin(), sample.end(), 0.0) / count, std::nullopt};
  if (sample.size() < 2) return estimate;
  const double squares = std::transform_reduce(
      sample.begin(), sample.end(), 0.0, std::plus(),
      [&](double value) { return (value - estimate.value) * (value - estimate.value); });
  const double z = quantile(boost::math::normal(), (1 + confidence) / 2);
  const double half_width = z * std::sqrt(squares / (count - 1) / count);
  estimate.interval = {estimate.value - half_width, estimate.value + half_width};
  return estimate;
}

std::optional<Estimate> ratio(std::span<const double> numerator, std::span<const double> denominator,
                              double confidence) {
  if (numerator.size() != denominator.size()) return independent_ratio(numerator, denominator, confidence);
  if (!all_positive(numerator) || !all_positive(denominator)) return std::nullopt;
  return paired_ratio(numerator, denominator, confidence);
}

bool all_positive(std::span<const double> sample) {
  return !sample.empty() && std::all_of(sample.begin(), sample.end(), [](double value) { return value > 0; });
}

std::optional<double> relative_error(std::optional<double> predicted, std::optional<double> measured) {
  if (!predicted || !measured || *measured == 0) return std::nullopt;
  return *predicted / *measured - 1;
}

}  // namespace rayshoot::analysis
