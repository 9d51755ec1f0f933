#pragma once

#include <string>
#include <vector>

#include "harness/render/image.h"

namespace rayshoot {

/// Numbers to be shown as colours, one for each pixel, row by row from the upper left.
struct HeatMap {
  int width = 0, height = 0;
  std::vector<double> values;
  /// What the numbers are and of what, for the legend: "object tests per eye ray", "bvh_sah on
  /// balls:4/curves".
  std::string title, subject;
};

/// The picture of a heat map, and below it a legend: titles, colour bar with numbers, mean and largest value.
/// The colours and where they end are those of plots (analysis/plots/heat_scale.h).
Image heat_picture(const HeatMap& map);

}  // namespace rayshoot
