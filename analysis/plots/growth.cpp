#include "analysis/plots/growth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/plots/chart.h"
#include "analysis/statistics/power_law.h"
#include "analysis/tables/page.h"

namespace rayshoot::analysis {

namespace {

/// Two digits after the point, and no minus sign before nothing.
std::string hundredths(double value) { return fmt::format("{:.2f}", std::round(100 * value) / 100 + 0.0); }

std::string exponent_in_words(const PowerLaw& law) {
  const auto& [value, interval] = law.exponent;
  if (!interval) return hundredths(value);
  return fmt::format("{} [{}, {}]", hundredths(value), hundredths(interval->low), hundredths(interval->high));
}

void draw(Chart& chart, const std::string& label, const Curve& curve, MarkerStyle style,
          const PowerLaw& law) {
  const auto [least, greatest] = std::minmax_element(curve.x.begin(), curve.x.end());
  std::vector<Point> fitted;
  for (const double x : {*least, *greatest})
    if (chart.contains(x, law(x))) fitted.push_back(chart.at(x, law(x)));
  chart.svg().polyline(fitted, fmt::format("fit l{}", style.colour));
  for (std::size_t i = 0; i < curve.x.size(); ++i)
    chart.point({curve.x[i], curve.y[i]}, style,
                fmt::format("{}: {} at {}", label, significant(curve.y[i]), curve.of[i]));
}

}  // namespace

void Curve::add(double at, double value, std::string what) {
  x.push_back(at);
  y.push_back(value);
  of.push_back(std::move(what));
}

std::optional<Plot> growth_plot(std::map<std::string, Curve> curves, const GrowthWords& words,
                                const SeriesStyles& styles, std::size_t least) {
  std::erase_if(curves, [&](const auto& curve) {
    const std::vector<double>& x = curve.second.x;
    return std::set(x.begin(), x.end()).size() < least ||
           !fit_power_law(curve.second.x, curve.second.y).has_value();
  });
  if (curves.empty()) return std::nullopt;
  std::vector<double> x, y;
  for (const auto& [label, curve] : curves) {
    x.insert(x.end(), curve.x.begin(), curve.x.end());
    y.insert(y.end(), curve.y.begin(), curve.y.end());
  }
  Chart chart(Axis(x, words.x), Axis(y, words.y));
  std::vector<std::pair<std::string, MarkerStyle>> legend;
  for (const auto& [label, curve] : curves) {
    const PowerLaw law = *fit_power_law(curve.x, curve.y);
    draw(chart, label, curve, styles(label), law);
    legend.emplace_back(fmt::format("{}: {}", label, exponent_in_words(law)), styles(label));
  }
  chart.legend(legend);
  return Plot{
      words.name, words.title,
      fmt::format("Lines are powers of {}, fitted to the logarithms; beside the names the exponents, with "
                  "Student's 95 % intervals.{}{}",
                  words.over, words.note.empty() ? "" : " ", words.note),
      chart.svg().element(words.title)};
}

}  // namespace rayshoot::analysis
