#include "analysis/statistics/rate.h"

#include <algorithm>
#include <cmath>

namespace rayshoot::analysis {

std::optional<double> per_billion(std::uint64_t events, std::uint64_t trials) {
  if (trials == 0) return std::nullopt;
  return 1e9 * static_cast<double>(events) / static_cast<double>(trials);
}

std::optional<double> upper_bound_per_billion(std::uint64_t events, std::uint64_t trials) {
  if (trials == 0) return std::nullopt;
  const double n = static_cast<double>(trials), p = static_cast<double>(events) / n;
  if (events == 0) return std::min(3 / n, 1.0) * 1e9;
  constexpr double z = 1.959963984540054, z2 = z * z;
  const double middle = p + z2 / (2 * n), half = z * std::sqrt(p * (1 - p) / n + z2 / (4 * n * n));
  return 1e9 * (middle + half) / (1 + z2 / n);
}

}  // namespace rayshoot::analysis
