#include "analysis/plots/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rayshoot::analysis {

namespace {

/// Room around the values of a logarithmic axis, as a factor.
constexpr double kRoom = 1.25;
constexpr double kMostTicks = 7;

/// The step of 1, 2 or 5 times a power of ten that cuts a range into no more than the most parts.
double step_of(double range) {
  const double rough = range / kMostTicks, power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough) return factor * power;
  return 10 * power;
}

/// "10⁻⁸", "5·10⁶", and plain numbers between a thousandth and a million.
std::string label_of(double value) {
  if (value == 0 || (std::abs(value) < 1e6 && std::abs(value) >= 0.999e-3))
    return fmt::format("{:.6g}", value);
  constexpr std::array digits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9));
  const double factor = std::round(value / std::pow(10, exponent));
  std::string power = exponent < 0 ? "10⁻" : "10";
  for (const char digit : fmt::format("{}", std::abs(exponent)))
    power += digits[static_cast<std::size_t>(digit - '0')];
  return factor == 1 ? power : fmt::format("{}·{}", factor, power);
}

}  // namespace

Axis::Axis(Scale scale, std::span<const double> values, std::string title)
    : scale_(scale), title_(std::move(title)) {
  if (scale == Scale::linear) {
    for (const double value : values) high_ = std::max(high_, value);
    if (!values.empty()) high_ = *std::max_element(values.begin(), values.end());
    if (!(high_ > 0)) high_ = 1;
    high_ *= 1.02;
    return;
  }
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  for (const double value : values) {
    if (!(value > 0) || !std::isfinite(value)) continue;
    least = std::min(least, value), greatest = std::max(greatest, value);
  }
  if (greatest == 0) least = greatest = 1;
  low_ = least / kRoom, high_ = greatest * kRoom;
  // An axis without two ticks cannot be read.
  while (ticks().size() < 2) low_ /= kRoom, high_ *= kRoom;
}

double Axis::position(double value) const {
  if (scale_ == Scale::linear) return (value - low_) / (high_ - low_);
  return std::log(value / low_) / std::log(high_ / low_);
}

std::vector<Axis::Tick> Axis::ticks() const {
  std::vector<Tick> result;
  if (scale_ == Scale::linear) {
    const double step = step_of(high_ - low_);
    for (double i = 0; i * step <= high_; ++i) result.push_back({i * step, label_of(i * step)});
    return result;
  }
  const double decades = std::log10(high_ / low_);
  const double skip = std::ceil(decades / kMostTicks);
  const std::vector<double> factors = decades > 2.5 ? std::vector{1.0} : std::vector{1.0, 2.0, 5.0};
  for (double power = std::floor(std::log10(low_)); power <= std::log10(high_); ++power) {
    if (std::fmod(power, skip) != 0) continue;
    for (const double factor : factors)
      if (const double value = factor * std::pow(10, power); contains(value))
        result.push_back({value, label_of(value)});
  }
  return result;
}

}  // namespace rayshoot::analysis
