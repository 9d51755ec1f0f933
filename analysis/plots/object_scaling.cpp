#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "analysis/plots/chart.h"
#include "analysis/plots/plots.h"
#include "analysis/plots/series.h"
#include "analysis/statistics/power_law.h"
#include "analysis/tables/comparison.h"
#include "analysis/tables/page.h"

namespace rayshoot::analysis {

namespace {

/// Fewer sizes of a scene say nothing about growth.
constexpr std::size_t kLeastSizes = 3;

struct Growing {
  const char *name, *axis, *words;
  Quantity quantity;
  /// Whether it is different for other rays.
  bool of_rays;
};
constexpr Growing kGrowing[] = {{"time", "time, ns per ray", "Time", trace_ns_per_ray, true},
                                {"build", "build, ms", "Build", build_milliseconds, false},
                                {"memory", "structure, bytes", "Memory", structure_bytes, false}};

/// A scene in several sizes, seen by one distribution of rays in one precision.
struct Family {
  std::string scene, rays, precision;
  std::map<std::uint64_t, const Group*> by_objects;
};

std::vector<Family> families(const std::vector<Group>& groups) {
  std::vector<Family> result;
  for (const Group& group : groups) {
    if (!group.scene || !group.rays || group.entries.empty()) continue;
    const std::string prefix = group.scene_id + "/";
    const Family family{
        fmt::format("{} as {}", group.scene->generator, group.scene->form),
        group.rays_id.starts_with(prefix) ? group.rays_id.substr(prefix.size()) : group.rays_id,
        precision_of(group),
        {}};
    auto found = std::find_if(result.begin(), result.end(), [&](const Family& other) {
      return std::tie(other.scene, other.rays, other.precision) ==
             std::tie(family.scene, family.rays, family.precision);
    });
    if (found == result.end()) found = result.insert(result.end(), family);
    found->by_objects[group.scene->objects] = &group;
  }
  std::erase_if(result, [](const Family& family) { return family.by_objects.size() < kLeastSizes; });
  return result;
}

struct Curve {
  std::vector<double> objects, values;
};

std::map<std::string, Curve> curves(const Family& family, Quantity quantity) {
  std::map<std::string, Curve> result;
  for (const auto& [objects, group] : family.by_objects)
    for (const Entry& entry : group->entries)
      if (const auto value = quantity(entry); value && is_right(entry)) {
        result[entry.label].objects.push_back(static_cast<double>(objects));
        result[entry.label].values.push_back(*value);
      }
  std::erase_if(result, [](const auto& curve) { return curve.second.objects.size() < kLeastSizes; });
  return result;
}

std::string exponent_in_words(const PowerLaw& law) {
  const auto& [value, interval] = law.exponent;
  return interval ? fmt::format("{:.2f} [{:.2f}, {:.2f}]", value, interval->low, interval->high)
                  : fmt::format("{:.2f}", value);
}

void draw(Chart& chart, const std::string& label, const Curve& curve, MarkerStyle style,
          const PowerLaw& law) {
  std::vector<Point> fitted;
  for (const double objects : {curve.objects.front(), curve.objects.back()})
    if (chart.contains(objects, law(objects))) fitted.push_back(chart.at(objects, law(objects)));
  chart.svg().polyline(fitted, fmt::format("fit l{}", style.colour));
  for (std::size_t i = 0; i < curve.objects.size(); ++i)
    chart.point(
        {curve.objects[i], curve.values[i]}, style,
        fmt::format("{}: {} at {:.0f} objects", label, significant(curve.values[i]), curve.objects[i]));
}

std::optional<Plot> plot_of(const Family& family, const Growing& growing, const SeriesStyles& styles) {
  const auto all = curves(family, growing.quantity);
  if (all.empty()) return std::nullopt;
  std::vector<double> objects, values;
  for (const auto& [label, curve] : all) {
    objects.insert(objects.end(), curve.objects.begin(), curve.objects.end());
    values.insert(values.end(), curve.values.begin(), curve.values.end());
  }
  Chart chart(Axis(objects, "objects"), Axis(values, growing.axis));
  std::vector<std::pair<std::string, MarkerStyle>> legend;
  for (const auto& [label, curve] : all) {
    const auto law = fit_power_law(curve.objects, curve.values);
    if (!law) continue;
    draw(chart, label, curve, styles(label), *law);
    legend.emplace_back(fmt::format("{}: {}", label, exponent_in_words(*law)), styles(label));
  }
  chart.legend(legend);
  const std::string name = growing.of_rays
                               ? fmt::format("{}, {}, {}", family.scene, family.rays, family.precision)
                               : fmt::format("{}, {}", family.scene, family.precision);
  const std::string title = fmt::format("{} over the number of objects: {}", growing.words, name);
  return Plot{fmt::format("scaling-{}-{}", growing.name, file_name_of(name)), title,
              "Lines are powers of the number of objects, fitted to the logarithms; beside the names the "
              "exponents, with "
              "Student's 95 % intervals.",
              chart.svg().element(title)};
}

}  // namespace

PlotSet object_scaling_plots(const std::vector<Group>& groups) {
  PlotSet set{.kind = "Scaling with the number of objects"};
  const SeriesStyles styles(groups);
  std::set<std::pair<std::string, std::string>> drawn;
  for (const Family& family : families(groups)) {
    const bool first = drawn.emplace(family.scene, family.precision).second;
    for (const Growing& growing : kGrowing)
      if (growing.of_rays || first)
        if (auto plot = plot_of(family, growing, styles)) set.plots.push_back(std::move(*plot));
  }
  if (set.plots.empty())
    set.left_out =
        fmt::format("no scene was measured in {} sizes or more with rays of one kind", kLeastSizes);
  return set;
}

}  // namespace rayshoot::analysis
