#include "analysis/statistics/outliers.h"

#include <cmath>

#include "analysis/statistics/sample.h"

namespace rayshoot::analysis {

namespace {

/// Standard deviation of a normal distribution over the median distance from its median.
constexpr double kDeviations = 1.4826;
constexpr double kFar = 10;

}  // namespace

std::vector<std::size_t> outliers(std::span<const double> sample) {
  std::vector<std::size_t> far;
  if (sample.empty()) return far;
  const double middle = median(sample)->value;
  std::vector<double> distances;
  for (const double value : sample) distances.push_back(std::abs(value - middle));
  const double deviation = kDeviations * median(distances)->value;
  for (std::size_t i = 0; i < sample.size(); ++i)
    if (deviation > 0 && distances[i] > kFar * deviation) far.push_back(i);
  return far;
}

}  // namespace rayshoot::analysis
