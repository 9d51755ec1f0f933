#include "analysis/plots/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rayshoot::analysis {

namespace {

/// Room around the values, as a factor.
constexpr double kRoom = 1.25;
constexpr double kLeast = 1e-100, kGreatest = 1e100;
constexpr double kMostTicks = 7;

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

Axis::Axis(std::span<const double> values, std::string title) : title_(std::move(title)) {
  double least = kGreatest, greatest = kLeast;
  for (const double value : values) {
    if (!(value >= kLeast && value <= kGreatest)) continue;
    least = std::min(least, value), greatest = std::max(greatest, value);
  }
  if (least > greatest) least = greatest = 1;
  low_ = least / kRoom, high_ = greatest * kRoom;
  // An axis without two ticks cannot be read.
  while (ticks().size() < 2) low_ /= kRoom, high_ *= kRoom;
}

double Axis::position(double value) const { return std::log(value / low_) / std::log(high_ / low_); }

std::vector<Axis::Tick> Axis::ticks() const {
  const double decades = std::log10(high_ / low_);
  const int skip = static_cast<int>(std::ceil(decades / kMostTicks));
  const std::vector<double> factors = decades > 2.5 ? std::vector{1.0} : std::vector{1.0, 2.0, 5.0};
  std::vector<Tick> result;
  const int last = static_cast<int>(std::floor(std::log10(high_)));
  for (int power = static_cast<int>(std::floor(std::log10(low_))); power <= last; ++power) {
    if (power % skip != 0) continue;
    for (const double factor : factors)
      if (const double value = factor * std::pow(10, power); contains(value))
        result.push_back({value, label_of(value)});
  }
  return result;
}

}  // namespace rayshoot::analysis
