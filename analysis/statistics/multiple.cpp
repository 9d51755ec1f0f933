#include "analysis/statistics/multiple.h"

#include <algorithm>
#include <numeric>

namespace rayshoot::analysis {

namespace {

/// The places of the chances, from the least to the greatest.
std::vector<std::size_t> ascending(std::span<const double> chances) {
  std::vector<std::size_t> order(chances.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return chances[a] < chances[b]; });
  return order;
}

}  // namespace

std::vector<double> holm(std::span<const double> chances) {
  std::vector<double> adjusted(chances.size());
  const std::vector<std::size_t> order = ascending(chances);
  double greatest = 0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const double scaled = chances[order[rank]] * static_cast<double>(order.size() - rank);
    adjusted[order[rank]] = greatest = std::max(greatest, std::min(1.0, scaled));
  }
  return adjusted;
}

std::vector<double> benjamini_hochberg(std::span<const double> chances) {
  std::vector<double> adjusted(chances.size());
  const std::vector<std::size_t> order = ascending(chances);
  double least = 1;
  for (std::size_t rank = order.size(); rank-- > 0;) {
    const double scaled =
        chances[order[rank]] * static_cast<double>(order.size()) / static_cast<double>(rank + 1);
    adjusted[order[rank]] = least = std::min(least, scaled);
  }
  return adjusted;
}

}  // namespace rayshoot::analysis
