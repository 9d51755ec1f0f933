#include <fmt/format.h>

#include <map>
#include <set>

#include "analysis/plots/growth.h"
#include "analysis/plots/plots.h"
#include "analysis/plots/series.h"
#include "analysis/tables/comparison.h"
#include "analysis/tables/families.h"

namespace rayshoot::analysis {

namespace {

struct Growing {
  const char *name, *axis, *words;
  Quantity quantity;
  /// Whether it is different for other rays.
  bool of_rays;
};
constexpr Growing kGrowing[] = {{"time", "time, ns per ray", "Time", trace_ns_per_ray, true},
                                {"build", "build, ms", "Build", build_milliseconds, false},
                                {"memory", "structure, bytes", "Memory", structure_bytes, false}};

std::map<std::string, Curve> curves(const Family& family, Quantity quantity) {
  std::map<std::string, Curve> result;
  for (const auto& [objects, group] : family.by_objects)
    for (const Entry& entry : group->entries)
      if (const auto value = quantity(entry); value && is_right(entry))
        result[entry.label].add(static_cast<double>(objects), *value, fmt::format("{} objects", objects));
  return result;
}

std::optional<Plot> plot_of(const Family& family, const Growing& growing, const SeriesStyles& styles) {
  const std::string name = growing.of_rays
                               ? fmt::format("{}, {}, {}", family.scene, family.rays, family.precision)
                               : fmt::format("{}, {}", family.scene, family.precision);
  return growth_plot(curves(family, growing.quantity),
                     {.name = fmt::format("scaling-{}-{}", growing.name, file_name_of(name)),
                      .title = fmt::format("{} over the number of objects: {}", growing.words, name),
                      .x = "objects",
                      .y = growing.axis,
                      .over = "the number of objects"},
                     styles, kLeastSizes);
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
