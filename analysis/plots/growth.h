#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/plots/plots.h"
#include "analysis/plots/series.h"

namespace rayshoot::analysis {

/// How a quantity of a technique grows with another.
struct Curve {
  std::vector<double> x, y;
  /// What each point is of, for its tip.
  std::vector<std::string> of;

  void add(double at, double value, std::string what);
};

/// What a plot of growth says besides its curves.
struct GrowthWords {
  std::string name, title;
  /// Titles of the axes.
  std::string x, y;
  /// What the lines are powers of.
  std::string over;
  /// What must be known besides; may be empty.
  std::string note{};
};

/// Curves by the names of their techniques on logarithmic axes, each with the power that fits it and its exponent. Curves
/// of values at fewer than `least` different places say nothing about growth and are left out; nothing where none is left.
std::optional<Plot> growth_plot(std::map<std::string, Curve> curves, const GrowthWords& words,
                                const SeriesStyles& styles, std::size_t least);

}  // namespace rayshoot::analysis
