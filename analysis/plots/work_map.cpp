#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/plots/chart.h"
#include "analysis/plots/heat_scale.h"
#include "analysis/plots/plots.h"
#include "analysis/tables/comparison.h"
#include "analysis/tables/page.h"

namespace rayshoot::analysis {

namespace {

using report::WorkMap;

constexpr double kSide = 400, kTop = 8, kBar = 12, kGap = 12;
/// Colours that are told apart: maps of few colours are small files.
constexpr std::size_t kColours = 64;

struct Kind {
  const char *name, *words;
  std::vector<std::uint64_t> WorkMap::*sums;
};
constexpr Kind kKinds[] = {{"objects", "Ray-object tests", &WorkMap::object_tests},
                           {"volumes", "Ray-volume tests", &WorkMap::volume_tests}};

/// The map of a cell as numbers per eye ray; empty where it has none, or nothing was tested.
std::vector<double> tests_per_ray(const Entry& entry, const Kind& kind) {
  const auto& map = entry.measurement->work_map;
  if (!map) return {};
  const auto& sums = (*map).*kind.sums;
  std::vector<double> tests;
  for (std::size_t i = 0; i < sums.size(); ++i)
    tests.push_back(static_cast<double>(sums[i]) / static_cast<double>(map->rays(i)));
  return std::any_of(sums.begin(), sums.end(), [](std::uint64_t sum) { return sum > 0; })
             ? tests
             : std::vector<double>{};
}

/// The middle of the colour that stands for a share of the scale.
Colour colour_of(double share) {
  const double step = std::min(std::floor(share * kColours), kColours - 1.0);
  return heat_colour((step + 0.5) / kColours);
}

void draw_scale(Svg& svg, double left, double end, double largest) {
  std::vector<Colour> colours;
  for (std::size_t i = 0; i < kColours; ++i) colours.push_back(colour_of(static_cast<double>(i) / kColours));
  const double top = kTop + kSide + kGap;
  svg.tiles({left, top}, kSide / kColours, kBar, kColours, colours);
  for (int quarter = 0; quarter <= 4; ++quarter) {
    const bool open = quarter == 4 && largest > end;
    svg.text({left + kSide * quarter / 4, top + kBar + 14},
             fmt::format("{}{:.6g}", open ? "≥ " : "", end * quarter / 4), Svg::Anchor::middle, "small");
  }
}

Plot plot_of(const Group& group, const Entry& entry, const Kind& kind, const std::vector<double>& tests,
             double end) {
  const WorkMap& map = *entry.measurement->work_map;
  const double largest = *std::max_element(tests.begin(), tests.end()), left = (kPlotWidth - kSide) / 2;
  std::vector<Colour> colours;
  for (const double value : tests) colours.push_back(colour_of(value / end));
  Svg svg(kPlotWidth, kTop + kSide + kGap + kBar + 22);
  const double side = kSide / static_cast<double>(map.columns());
  svg.tiles({left, kTop}, side, side, map.columns(), colours);
  draw_scale(svg, left, end, largest);
  const auto& sums = map.*kind.sums;
  const double mean = static_cast<double>(std::accumulate(sums.begin(), sums.end(), std::uint64_t{0})) /
                      static_cast<double>(map.resolution * map.resolution);
  const std::string of = fmt::format("{}, {}", entry.label, title_of(group, false));
  const std::string title = fmt::format("{} per eye ray: {}", kind.words, of);
  return {file_name_of(fmt::format("work-map-{}-{}", kind.name, of)), title,
          fmt::format("Tiles of {} x {} eye rays, the upper left of the picture first: {} tests per ray in "
                      "the mean, {} in the tile with the most. Maps of the same rays share one scale.",
                      map.tile, map.tile, significant(mean), significant(largest)),
          svg.element(title)};
}

void append(PlotSet& set, const Group& group, const Kind& kind) {
  std::vector<double> all;
  for (const Entry& entry : group.entries) {
    const std::vector<double> tests = tests_per_ray(entry, kind);
    all.insert(all.end(), tests.begin(), tests.end());
  }
  if (all.empty()) return;
  const double end = end_of_scale(all);
  for (const Entry& entry : group.entries)
    if (const std::vector<double> tests = tests_per_ray(entry, kind); !tests.empty())
      set.plots.push_back(plot_of(group, entry, kind, tests, end));
}

}  // namespace

PlotSet work_map_plots(const std::vector<Group>& groups) {
  PlotSet set{.kind = "Heat maps of work per pixel"};
  for (const Group& group : groups)
    for (const Kind& kind : kKinds) append(set, group, kind);
  if (set.plots.empty())
    set.left_out =
        "no cell holds a map of its work: rayshoot run --work-map TECHNIQUE takes them; those that rayshoot "
        "render draws are shown by rayshoot report --picture FILE";
  return set;
}

}  // namespace rayshoot::analysis
