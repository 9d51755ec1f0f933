#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "analysis/plots/chart.h"
#include "analysis/plots/plots.h"
#include "analysis/plots/series.h"
#include "analysis/statistics/geometric_mean.h"
#include "analysis/tables/comparison.h"
#include "analysis/tables/page.h"

namespace rayshoot::analysis {

namespace {

/// Nanoseconds a ray by number of threads, for each scene and its rays.
using Times = std::map<std::string, std::map<int, double>>;

/// What was timed with several numbers of threads in one precision, technique by technique.
using Techniques = std::map<std::string, Times>;

void add(std::map<int, double>& times, int threads, const std::vector<double>& trace_ns, double rays) {
  if (const auto time = median(trace_ns)) times.emplace(threads, time->value / rays);
}

std::map<std::string, Techniques> times_of(const std::vector<Group>& groups) {
  std::map<std::string, Techniques> result;
  for (const Group& group : groups)
    for (const Entry& entry : group.entries) {
      if (!is_right(entry) || entry.rays == 0) continue;
      const report::Measurement& cell = *entry.measurement;
      auto& times = result[precision_of(group)][entry.label][title_of(group, false)];
      const double rays = static_cast<double>(entry.rays);
      add(times, cell.trace_threads, cell.trace_ns, rays);
      for (const report::ThreadTimes& more : cell.threads) add(times, more.threads, more.trace_ns, rays);
    }
  for (auto& [precision, techniques] : result) {
    for (auto& [label, scenes] : techniques)
      std::erase_if(scenes, [](const auto& scene) { return scene.second.size() < 2; });
    std::erase_if(techniques, [](const auto& technique) { return technique.second.empty(); });
  }
  std::erase_if(result, [](const auto& precision) { return precision.second.empty(); });
  return result;
}

/// Numbers of threads that every scene of a technique was timed with.
std::set<int> common_threads(const Times& scenes) {
  std::set<int> common;
  for (const auto& [threads, time] : scenes.begin()->second) common.insert(threads);
  for (const auto& [scene, times] : scenes)
    std::erase_if(common, [&, &of_scene = times](int threads) { return !of_scene.contains(threads); });
  return common;
}

/// Threads and how many times faster they are than the fewest: the geometric mean over the scenes.
std::vector<Point> speed_ups(const Times& scenes) {
  const std::set<int> common = common_threads(scenes);
  std::vector<Point> points;
  for (const int threads : common) {
    std::vector<std::optional<double>> ratios;
    for (const auto& [scene, times] : scenes)
      ratios.emplace_back(times.at(*common.begin()) / times.at(threads));
    if (const auto mean = geometric_mean(ratios).value)
      points.push_back({static_cast<double>(threads) / *common.begin(), *mean});
  }
  return points;
}

std::optional<Plot> plot_of(const std::string& precision, const Techniques& techniques,
                            const SeriesStyles& styles) {
  std::map<std::string, std::vector<Point>> curves;
  std::vector<double> threads, values;
  for (const auto& [label, scenes] : techniques) {
    const std::vector<Point> points = speed_ups(scenes);
    if (points.size() < 2) continue;
    curves[label] = points;
    for (const Point& point : points) threads.push_back(point.x), values.push_back(point.y);
  }
  if (curves.empty()) return std::nullopt;
  values.insert(values.end(), threads.begin(), threads.end());
  Chart chart(Axis(threads, "threads, over the fewest"), Axis(values, "times faster"));
  chart.equality();
  std::vector<std::string> labels;
  for (const auto& [label, points] : curves) {
    std::vector<Point> line;
    for (const Point& point : points)
      if (chart.contains(point.x, point.y)) line.push_back(chart.at(point.x, point.y));
    chart.svg().polyline(line, fmt::format("fit l{}", styles(label).colour));
    for (const Point& point : points)
      chart.point(point, styles(label),
                  fmt::format("{}: {} times faster with {:g} times the threads, {} scenes and rays", label,
                              significant(point.y), point.x, techniques.at(label).size()));
    labels.push_back(label);
  }
  chart.legend(styles.legend(labels));
  const std::string title = fmt::format("Scaling with threads: {}", precision);
  return Plot{
      "threads-" + file_name_of(precision), title,
      "Geometric means over scenes and rays. On the dashed line twice the threads take half the time.",
      chart.svg().element(title)};
}

}  // namespace

PlotSet thread_scaling_plots(const std::vector<Group>& groups) {
  PlotSet set{.kind = "Scaling with threads"};
  const SeriesStyles styles(groups);
  for (const auto& [precision, techniques] : times_of(groups))
    if (auto plot = plot_of(precision, techniques, styles)) set.plots.push_back(std::move(*plot));
  if (set.plots.empty())
    set.left_out =
        "nothing was timed with several numbers of threads: \"thread_scaling\" of a suite does that, or "
        "reports of "
        "run --threads N on one page";
  return set;
}

}  // namespace rayshoot::analysis
