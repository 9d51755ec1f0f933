#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "analysis/plots/chart.h"
#include "analysis/plots/plots.h"
#include "analysis/plots/series.h"
#include "analysis/tables/comparison.h"
#include "analysis/tables/page.h"

namespace rayshoot::analysis {

namespace {

Plot plot_of(const Precision& precision, std::vector<MeanRow> rows, const std::vector<std::string>& left_out,
             const SeriesStyles& styles) {
  std::vector<double> traces, builds;
  for (const MeanRow& row : rows) traces.push_back(*row.means[0]), builds.push_back(*row.means[1]);
  Chart chart(Axis(builds, "build, ms"), Axis(traces, "trace, ns per ray"), 400);
  // From the cheapest build on, what traces faster than all before.
  std::sort(rows.begin(), rows.end(),
            [](const MeanRow& a, const MeanRow& b) { return a.means[1] < b.means[1]; });
  std::vector<Point> frontier;
  for (const MeanRow& row : rows) {
    const Point point{*row.means[1], *row.means[0]};
    if (frontier.empty() || point.y < frontier.back().y) frontier.push_back(point);
    chart.keep_clear(point);
  }
  chart.frontier(frontier);
  std::vector<std::string> without_room;
  for (const MeanRow& row : rows) {
    const Point point{*row.means[1], *row.means[0]};
    chart.point(point, styles(row.label),
                fmt::format("{}: build {} ms, trace {} ns per ray", row.label, significant(point.x),
                            significant(point.y)));
    if (!chart.name(point, row.label)) without_room.push_back(row.label);
  }
  chart.legend(styles.legend(without_room));
  const std::string title = fmt::format("Build against trace: {}", title_of_groups(precision));
  std::string caption =
      "The line joins what nothing else beats in both: a better structure costs a longer build, which "
      "pays after enough rays.";
  if (precision.groups.size() > 1) caption += " Geometric means, of those that are right everywhere.";
  if (!left_out.empty()) caption += fmt::format(" Not timed in all of them: {}.", fmt::join(left_out, ", "));
  return {"build-trace-" + file_name_of(title_of_groups(precision)), title, caption,
          chart.svg().element(title)};
}

}  // namespace

PlotSet build_trace_plots(const std::vector<Group>& groups) {
  PlotSet set{.kind = "Build against trace"};
  const SeriesStyles styles(groups);
  for (const Precision& precision : precisions(groups)) {
    std::vector<std::string> left_out;
    std::vector<MeanRow> rows = mean_rows(precision.groups, {trace_ns_per_ray, build_milliseconds}, left_out);
    std::erase_if(rows, [](const MeanRow& row) { return !row.means[0] || !row.means[1]; });
    if (!rows.empty()) set.plots.push_back(plot_of(precision, std::move(rows), left_out, styles));
  }
  if (set.plots.empty()) set.left_out = "no technique was timed in every scene";
  return set;
}

}  // namespace rayshoot::analysis
