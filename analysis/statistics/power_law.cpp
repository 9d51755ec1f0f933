#include "analysis/statistics/power_law.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace rayshoot::analysis {

double PowerLaw::operator()(double x) const { return factor * std::pow(x, exponent.value); }

std::optional<PowerLaw> fit_power_law(std::span<const double> x, std::span<const double> y) {
  if (x.size() != y.size() || x.size() < 2) return std::nullopt;
  const double n = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!(x[i] > 0) || !(y[i] > 0)) return std::nullopt;
    mean_x += std::log(x[i]) / n;
    mean_y += std::log(y[i]) / n;
  }
  double xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double dx = std::log(x[i]) - mean_x, dy = std::log(y[i]) - mean_y;
    xx += dx * dx, xy += dx * dy, yy += dy * dy;
  }
  if (xx == 0) return std::nullopt;
  const double slope = xy / xx;
  PowerLaw law{std::exp(mean_y - slope * mean_x), {slope, std::nullopt}};
  if (x.size() == 2) return law;
  const double t = quantile(boost::math::students_t(n - 2), (1 + kConfidence) / 2);
  const double half_width = t * std::sqrt(std::max(0.0, yy - slope * xy) / (n - 2) / xx);
  law.exponent.interval = {slope - half_width, slope + half_width};
  return law;
}

}  // namespace rayshoot::analysis
