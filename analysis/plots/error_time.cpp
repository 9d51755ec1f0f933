#include <fmt/format.h>

#include <algorithm>
#include <map>

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
  /// Whether a point has an error at all: where none has, there is nothing to draw.
  bool (*seen)(const WorkPrecision&);
};
constexpr ErrorKind kErrors[] = {
    {"wrong", "wrong answers per 10⁹, upper bound at 95 %",
     "An error that was never seen has the bound of so many rays, not 0.",
     [](const WorkPrecision& point) { return point.wrong_upper; },
     [](const WorkPrecision& point) { return point.wrong_per_billion > 0; }},
    {"ulps", "error in distance of 999 of 1000 hits, float ulps",
     "Points without an error of one in 2⁴⁰ ulps are drawn at the lower edge.",
     [](const WorkPrecision& point) { return std::max(point.float_ulps_p999, 1e-12); },
     [](const WorkPrecision& point) { return point.float_ulps_p999 > 0; }}};

/// What no other point beats in this error and time, from the fastest on.
std::vector<Point> frontier_of(const std::vector<WorkPrecision>& points, const ErrorKind& kind) {
  std::vector<Point> frontier;
  for (const WorkPrecision& point : points)
    if (frontier.empty() || kind.error(point) < frontier.back().y)
      frontier.push_back({point.ns_per_ray, kind.error(point)});
  return frontier;
}

/// Markers of techniques in their precisions, the same in all diagrams.
using Markers = std::map<std::string, MarkerStyle>;

Markers markers_of(const std::vector<WorkPrecisionDiagram>& diagrams) {
  Markers markers;
  for (const WorkPrecisionDiagram& diagram : diagrams)
    for (const WorkPrecision& point : diagram.points) markers.emplace(point.label, MarkerStyle());
  std::size_t series = 0;
  for (auto& [label, marker] : markers) marker = MarkerStyle(series++);
  return markers;
}

Plot plot_of(const WorkPrecisionDiagram& diagram, const ErrorKind& kind, const Markers& markers) {
  std::vector<double> times, errors;
  for (const WorkPrecision& point : diagram.points)
    times.push_back(point.ns_per_ray), errors.push_back(kind.error(point));
  Chart chart(Axis(times, "time, ns per ray"), Axis(errors, kind.axis));
  chart.frontier(frontier_of(diagram.points, kind));
  std::map<std::string, MarkerStyle> legend;
  for (const WorkPrecision& point : diagram.points) {
    const MarkerStyle marker = markers.at(point.label);
    chart.point({point.ns_per_ray, kind.error(point)}, marker,
                fmt::format("{}: {} ns per ray, {}", point.label, significant(point.ns_per_ray),
                            significant(kind.error(point))));
    legend.emplace(point.label, marker);
  }
  chart.legend({legend.begin(), legend.end()});
  const std::string title = fmt::format("Error against run time: {}", diagram.rays_id);
  return {fmt::format("error-time-{}-{}", kind.name, file_name_of(diagram.rays_id)), title,
          fmt::format("The line joins what nothing else beats in both. {}", kind.words),
          chart.svg().element(fmt::format("{}, {}", title, kind.axis))};
}

/// Whether there is an error of the kind to be drawn.
bool is_seen(const WorkPrecisionDiagram& diagram, const ErrorKind& kind) {
  return std::any_of(diagram.points.begin(), diagram.points.end(), kind.seen);
}

}  // namespace

PlotSet error_time_plots(const std::vector<Group>& groups) {
  PlotSet set{.kind = "Error against run time"};
  const auto diagrams = work_precision_diagrams(groups);
  const Markers markers = markers_of(diagrams);
  std::size_t drawn = 0;
  for (const WorkPrecisionDiagram& diagram : diagrams) {
    if (drawn == kMostDiagrams) break;
    ++drawn;
    for (const ErrorKind& kind : kErrors)
      if (is_seen(diagram, kind)) set.plots.push_back(plot_of(diagram, kind, markers));
  }
  if (diagrams.empty())
    set.left_out =
        "no answers were both timed and held against exact arithmetic; rayshoot run --graded N does that";
  else if (set.plots.empty())
    set.left_out = "no answer is wrong, nor off by an ulp";
  else if (drawn < diagrams.size())
    set.left_out = fmt::format("{} more scenes and rays; the tables have them", diagrams.size() - drawn);
  return set;
}

}  // namespace rayshoot::analysis
