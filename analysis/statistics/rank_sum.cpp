#include "analysis/statistics/rank_sum.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace rayshoot::analysis {

namespace {

/// From so many pairs on the normal distribution takes the place of the exact one.
constexpr std::size_t kManyPairs = 900;

/// The chance of each number of pairs (x, y) with x < y, of m and n values of one distribution. Of all m + n values the
/// largest is an x, and then adds no pair, or a y, and then adds m.
std::vector<double> pair_distribution(std::size_t m, std::size_t n) {
  // Row i of the recursion on the number of x's, for all numbers of y's.
  std::vector<std::vector<double>> row(n + 1, {1.0});
  for (std::size_t i = 1; i <= m; ++i) {
    std::vector<std::vector<double>> next(n + 1, {1.0});
    for (std::size_t j = 1; j <= n; ++j) {
      const double share = static_cast<double>(i) / static_cast<double>(i + j);
      next[j].assign(i * j + 1, 0);
      for (std::size_t u = 0; u < row[j].size(); ++u) next[j][u] += share * row[j][u];
      for (std::size_t u = 0; u < next[j - 1].size(); ++u) next[j][u + i] += (1 - share) * next[j - 1][u];
    }
    row = std::move(next);
  }
  return row[n];
}

/// The chance of at most `pairs` pairs.
double chance_at_most(std::size_t pairs, std::size_t m, std::size_t n) {
  if (m * n > kManyPairs) {
    const double product = static_cast<double>(m) * static_cast<double>(n);
    const double deviation = std::sqrt(product * static_cast<double>(m + n + 1) / 12);
    return cdf(boost::math::normal(), (static_cast<double>(pairs) + 0.5 - product / 2) / deviation);
  }
  thread_local std::map<std::pair<std::size_t, std::size_t>, std::vector<double>> known;
  auto& chances = known[{m, n}];
  if (chances.empty()) chances = pair_distribution(m, n);
  return std::accumulate(chances.begin(), chances.begin() + static_cast<std::ptrdiff_t>(pairs) + 1, 0.0);
}

}  // namespace

std::optional<Estimate> independent_ratio(std::span<const double> numerator,
                                          std::span<const double> denominator, double confidence) {
  if (!all_positive(numerator) || !all_positive(denominator)) return std::nullopt;
  std::vector<double> ratios;
  for (const double above : numerator)
    for (const double below : denominator) ratios.push_back(std::log(above / below));
  std::sort(ratios.begin(), ratios.end());
  Estimate estimate{std::exp(median(ratios)->value), std::nullopt};
  std::size_t outside = 0;
  while (chance_at_most(outside, numerator.size(), denominator.size()) <= (1 - confidence) / 2) ++outside;
  if (outside > 0)
    estimate.interval = {std::exp(ratios[outside - 1]), std::exp(ratios[ratios.size() - outside])};
  return estimate;
}

double chance_of_ranks(std::span<const double> above, std::span<const double> below, double factor) {
  if (above.empty() || below.empty()) return 1;
  std::size_t against = 0;
  for (const double a : above)
    for (const double b : below) against += a <= factor * b;
  return chance_at_most(against, above.size(), below.size());
}

}  // namespace rayshoot::analysis
