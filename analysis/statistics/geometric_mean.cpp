#include "analysis/statistics/geometric_mean.h"

#include <cmath>

namespace rayshoot::analysis {

GeometricMean geometric_mean(std::span<const std::optional<double>> cells) {
  GeometricMean mean;
  double logarithms = 0;
  for (const auto& cell : cells) {
    if (!cell || !(*cell > 0)) {
      ++mean.missing;
      continue;
    }
    ++mean.cells;
    logarithms += std::log(*cell);
  }
  if (mean.cells > 0) mean.value = std::exp(logarithms / static_cast<double>(mean.cells));
  return mean;
}

}  // namespace rayshoot::analysis
