#include "harness/render/colour_map.h"

#include <algorithm>
#include <cmath>

namespace rayshoot {

Rgb heat_colour(double value) {
  constexpr std::array<Rgb, 9> points = {{{68, 1, 84},
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
  Rgb colour;
  for (int k = 0; k < 3; ++k)
    colour[k] = static_cast<std::uint8_t>(
        std::lround(points[before][k] * (1 - share) + points[before + 1][k] * share));
  return colour;
}

}  // namespace rayshoot
