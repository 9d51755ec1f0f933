#include "analysis/plots/heat_scale.h"

#include <algorithm>
#include <cmath>

namespace rayshoot::analysis {

namespace {

/// The smallest of 1, 2, 4, 5, 10, 20, ... that is not below the value.
double round_up(double value) {
  double decade = 1;
  while (10 * decade < value) decade *= 10;
  for (const double step : {1.0, 2.0, 4.0, 5.0, 10.0})
    if (step * decade >= value) return step * decade;
  return 10 * decade;
}

}  // namespace

Colour heat_colour(double value) {
  constexpr std::array<Colour, 9> points = {{{68, 1, 84},
                                             {71, 44, 122},
                                             {59, 81, 139},
                                             {44, 113, 142},
                                             {33, 144, 141},
                                             {39, 173, 129},
                                             {92, 200, 99},
                                             {170, 220, 50},
                                             {253, 231, 37}}};
  const double position = std::clamp(value, 0.0, 1.0) * (points.size() - 1);
  const auto before = std::min(static_cast<std::size_t>(position), points.size() - 2);
  const double share = position - static_cast<double>(before);
  Colour colour;
  for (int k = 0; k < 3; ++k)
    colour[k] = static_cast<std::uint8_t>(
        std::lround(points[before][k] * (1 - share) + points[before + 1][k] * share));
  return colour;
}

double end_of_scale(std::vector<double> values) {
  const auto position =
      values.begin() + static_cast<std::ptrdiff_t>(0.995 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), position, values.end());
  return round_up(*position);
}

}  // namespace rayshoot::analysis
