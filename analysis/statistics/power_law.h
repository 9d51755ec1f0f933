#pragma once

#include <optional>
#include <span>

#include "analysis/statistics/sample.h"

namespace rayshoot::analysis {

/// y = factor x^exponent, the straight line through the logarithms.
struct PowerLaw {
  double factor = 1;
  /// With Student's interval for the slope of a line, at 95 %; no interval for two points.
  Estimate exponent;

  double operator()(double x) const;
};

/// By least squares. Nothing for fewer than two different x, or when a value is 0 or less.
std::optional<PowerLaw> fit_power_law(std::span<const double> x, std::span<const double> y);

}  // namespace rayshoot::analysis
