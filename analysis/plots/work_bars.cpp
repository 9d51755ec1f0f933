#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "analysis/plots/chart.h"
#include "analysis/plots/plots.h"
#include "analysis/plots/series.h"
#include "analysis/tables/comparison.h"
#include "analysis/tables/page.h"

namespace rayshoot::analysis {

namespace {

constexpr double kBar = 9, kGap = 6, kLegend = 30, kNameWidth = 142, kNumberWidth = 52;
/// Longer names are set smaller, and on several lines.
constexpr std::size_t kMostLargeCharacters = 20, kMostNameCharacters = 22, kMostNameLines = 3;
constexpr double kNameLine = 9.5;
/// Bars longer than so many times that of a technique at the third quartile are broken off, and so leave room to the others.
constexpr double kLongest = 3;

template <std::uint64_t report::Work::*count>
std::optional<double> work(const Entry& entry) {
  return per_ray(entry.measurement->work, count);
}

struct BarKind {
  const char* words;
  Quantity quantity;
};
constexpr BarKind kBars[] = {{"ray-object tests", work<&report::Work::object_tests>},
                             {"ray-volume tests", work<&report::Work::volume_tests>},
                             {"steps", work<&report::Work::steps>}};

double longest_bar(const std::vector<MeanRow>& rows) {
  std::vector<double> longest;
  for (const MeanRow& row : rows) {
    double most = 0;
    for (const auto& mean : row.means) most = std::max(most, mean.value_or(0));
    longest.push_back(most);
  }
  std::sort(longest.begin(), longest.end());
  return std::min(longest.back(), kLongest * longest[3 * (longest.size() - 1) / 4]);
}

/// A name on as many lines as a row has room for.
void draw_name(Svg& svg, const std::string& label, double middle) {
  std::vector<std::string> lines = wrapped(label, kMostNameCharacters);
  if (lines.size() > kMostNameLines) {
    lines.resize(kMostNameLines);
    lines.back() += "…";
  }
  const char* style = display_width(label) > kMostLargeCharacters ? "tiny" : "small";
  double baseline = middle + 4 - kNameLine * static_cast<double>(lines.size() - 1) / 2;
  for (const std::string& line : lines) {
    svg.text({kNameWidth, baseline}, line, Svg::Anchor::end, style);
    baseline += kNameLine;
  }
}

void draw_row(Svg& svg, const MeanRow& row, double top, double unit, double longest) {
  draw_name(svg, row.label, top + 1.5 * kBar);
  for (std::size_t i = 0; i < row.means.size(); ++i) {
    const double mean = row.means[i].value_or(0), y = top + kBar * static_cast<double>(i);
    if (mean == 0) continue;
    const double length = std::min(mean, longest) * unit;
    svg.rectangle({kNameWidth + 6, y}, std::max(length, 0.5), kBar - 1, fmt::format("b{}", i),
                  fmt::format("{}: {} {} per ray", row.label, significant(mean), kBars[i].words));
    const std::string number = mean > longest ? "» " + significant(mean) : significant(mean);
    svg.text({kNameWidth + 10 + length, y + kBar - 1}, number, Svg::Anchor::start, "tiny");
  }
}

Svg draw(const std::vector<MeanRow>& rows) {
  const double row_height = 3 * kBar + kGap;
  Svg svg(kPlotWidth, kLegend + row_height * static_cast<double>(rows.size()) + 4);
  for (std::size_t i = 0; i < std::size(kBars); ++i) {
    const double x = 40 + 145 * static_cast<double>(i);
    svg.rectangle({x, 8}, 12, 10, fmt::format("b{}", i));
    svg.text({x + 17, 17}, kBars[i].words);
  }
  const double longest = longest_bar(rows);
  const double unit = (kPlotWidth - kNameWidth - 6 - kNumberWidth) / longest;
  for (std::size_t i = 0; i < rows.size(); ++i)
    draw_row(svg, rows[i], kLegend + row_height * static_cast<double>(i), unit, longest);
  return svg;
}

void append(PlotSet& set, const Precision& precision) {
  std::vector<Quantity> quantities;
  for (const BarKind& kind : kBars) quantities.push_back(kind.quantity);
  std::vector<std::string> left_out;
  std::vector<MeanRow> rows = mean_rows(precision.groups, quantities, left_out);
  std::erase_if(rows, [](const MeanRow& row) { return row.means[0].value_or(0) == 0; });
  if (rows.empty()) return;
  const std::string title = fmt::format("Work per ray: {}", title_of_groups(precision));
  std::string caption =
      precision.groups.size() > 1 ? "Geometric means, of those that are right everywhere." : "";
  caption += " Bars that end in » are broken off.";
  if (!left_out.empty())
    caption += fmt::format(" Not counted in all of them: {}.", fmt::join(left_out, ", "));
  set.plots.push_back(
      {"work-" + file_name_of(title_of_groups(precision)), title, caption, draw(rows).element(title)});
}

}  // namespace

PlotSet work_bars_plots(const std::vector<Group>& groups) {
  PlotSet set{.kind = "Work per ray"};
  for (const Precision& precision : precisions(groups)) append(set, precision);
  if (set.plots.empty()) set.left_out = "no work was counted";
  return set;
}

}  // namespace rayshoot::analysis
