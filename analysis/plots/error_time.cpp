#include <fmt/format.h>

#include <algorithm>

#include "analysis/plots/chart.h"
#include "analysis/plots/plots.h"
#include "analysis/plots/series.h"
#include "analysis/tables/page.h"
#include "analysis/work_precision/frontier.h"

namespace rayshoot::analysis {

namespace {

/// More diagrams than this are too many to look at.
constexpr std::size_t kMostDiagrams = 12;

struct ErrorKind {
  const char *name, *axis, *words;
  double (*error)(const WorkPrecision&);
};
constexpr ErrorKind kErrors[] = {
    {"wrong", "wrong answers per 10⁹, upper bound at 95 %",
     "An error that was never seen has the bound of so many rays, not 0.",
     [](const WorkPrecision& point) { return point.wrong_upper; }},
    {"ulps", "error in distance of 999 of 1000 hits, float ulps",
     "Points without an error of one in 2⁴⁰ ulps are drawn at the lower edge.",
     [](const WorkPrecision& point) { return std::max(point.float_ulps_p999, 1e-12); }}};

/// What no other point beats in this error and time, from the fastest on.
std::vector<Point> frontier_of(const std::vector<WorkPrecision>& points, const ErrorKind& kind) {
  std::vector<Point> frontier;
  for (const WorkPrecision& point : points)
    if (frontier.empty() || kind.error(point) < frontier.back().y)
      frontier.push_back({point.ns_per_ray, kind.error(point)});
  return frontier;
}

Plot plot_of(const WorkPrecisionDiagram& diagram, const ErrorKind& kind) {
  std::vector<double> times, errors;
  for (const WorkPrecision& point : diagram.points)
    times.push_back(point.ns_per_ray), errors.push_back(kind.error(point));
  Chart chart(Axis(Scale::logarithmic, times, "time, ns per ray"),
              Axis(Scale::logarithmic, errors, kind.axis));
  chart.frontier(frontier_of(diagram.points, kind));
  std::vector<std::pair<std::string, MarkerStyle>> legend;
  for (std::size_t i = 0; i < diagram.points.size(); ++i) {
    const WorkPrecision& point = diagram.points[i];
    chart.svg().marker(chart.at(point.ns_per_ray, kind.error(point)), MarkerStyle(i),
                       fmt::format("{}: {} ns per ray, {}", point.label, significant(point.ns_per_ray),
                                   significant(kind.error(point))));
    legend.emplace_back(point.label, MarkerStyle(i));
  }
  chart.legend(legend);
  const std::string title = fmt::format("Error against run time: {}", diagram.rays_id);
  return {fmt::format("error-time-{}-{}", kind.name, file_name_of(diagram.rays_id)), title,
          fmt::format("The line joins what nothing else beats in both. {}", kind.words),
          chart.svg().element(fmt::format("{}, {}", title, kind.axis))};
}

}  // namespace

PlotSet error_time_plots(const std::vector<Group>& groups) {
  PlotSet set{.kind = "Error against run time"};
  const auto diagrams = work_precision_diagrams(groups);
  for (const WorkPrecisionDiagram& diagram : diagrams) {
    if (set.plots.size() == 2 * kMostDiagrams) {
      set.left_out =
          fmt::format("{} more scenes and rays; the tables have them", diagrams.size() - kMostDiagrams);
      break;
    }
    for (const ErrorKind& kind : kErrors) set.plots.push_back(plot_of(diagram, kind));
  }
  if (set.plots.empty())
    set.left_out =
        "no answers were both timed and held against exact arithmetic; rayshoot run --graded N does that";
  return set;
}

}  // namespace rayshoot::analysis
