#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "analysis/plots/growth.h"
#include "analysis/plots/plots.h"
#include "analysis/plots/series.h"
#include "analysis/tables/comparison.h"
#include "analysis/tables/labels.h"
#include "analysis/tables/page.h"

namespace rayshoot::analysis {

namespace {

/// Fewer stiffnesses say nothing about growth.
constexpr std::size_t kLeastScenes = 3;
/// More kinds of rays, or cases of the numerical suite, than this are too many to look at.
constexpr std::size_t kMostFamilies = 6;

struct WorkKind {
  const char *name, *words;
  std::uint64_t report::Work::*count;
};
constexpr WorkKind kWork[] = {{"tests", "Ray-object tests", &report::Work::object_tests},
                              {"steps", "Steps", &report::Work::steps}};

/// Curves by what they are of: rays and precision of scenes, or a case and precision of the numerical suite.
using Families = std::map<std::string, std::map<std::string, Curve>>;

void add(Curve& curve, double stiffness, const std::optional<report::Work>& work, const WorkKind& kind,
         const std::string& of) {
  const auto value = per_ray(work, kind.count);
  if (stiffness > 0 && value && *value > 0)
    curve.add(stiffness, *value, fmt::format("stiffness {}, {}", significant(stiffness), of));
}

Families of_scenes(const std::vector<Group>& groups, const WorkKind& kind) {
  Families result;
  for (const Group& group : groups) {
    if (!group.scene || !group.scene->stiffness || !group.rays) continue;
    const std::string family = fmt::format("{} rays, {}", group.rays->distribution, precision_of(group));
    for (const Entry& entry : group.entries)
      if (is_right(entry))
        add(result[family][entry.label], *group.scene->stiffness, entry.measurement->work, kind,
            group.scene_id);
  }
  return result;
}

/// A setting that is stressed is another one of the same scene, so that only plain ones are taken.
Families of_gradings(const std::vector<report::Report>& reports, const WorkKind& kind) {
  Families result;
  Labels labels;
  for (const report::Report& report : reports)
    for (const report::Grading& grading : report.gradings) labels.add(grading.technique, grading.config);
  for (const report::Report& report : reports)
    for (const report::Grading& grading : report.gradings) {
      if (!grading.stiffness || grading.base || grading.flush_to_zero) continue;
      const std::string family =
          fmt::format("{}, {}", grading.torture_case,
                      precision_of({.scalar = grading.scalar, .intersector = grading.intersector}));
      add(result[family][labels(grading.technique, grading.config)], *grading.stiffness, grading.work, kind,
          grading.setting);
    }
  return result;
}

/// Draws the first families and says how many more there are.
std::size_t append(PlotSet& set, const Families& families, const WorkKind& kind, const std::string& note) {
  std::size_t drawn = 0, more = 0;
  for (const auto& [family, curves] : families) {
    std::set<std::string> labels;
    for (const auto& [label, curve] : curves) labels.insert(label);
    auto plot =
        growth_plot(curves,
                    {.name = fmt::format("stiffness-{}-{}", kind.name, file_name_of(family)),
                     .title = fmt::format("{} over the stiffness of the scene: {}", kind.words, family),
                     .x = "stiffness κ: diagonal of the scene over its smallest feature",
                     .y = fmt::format("{} per ray", kind.words),
                     .over = "κ",
                     .note = note},
                    SeriesStyles(labels), kLeastScenes);
    if (!plot) continue;
    if (drawn++ < kMostFamilies)
      set.plots.push_back(std::move(*plot));
    else
      ++more;
  }
  return more;
}

}  // namespace

PlotSet stiffness_work_plots(const std::vector<Group>& groups, const std::vector<report::Report>& reports) {
  PlotSet set{.kind = "Work against stiffness"};
  std::size_t more = 0;
  for (const WorkKind& kind : kWork) {
    more += append(set, of_scenes(groups, kind), kind, "The scenes differ in more than their stiffness.");
    more += append(set, of_gradings(reports, kind), kind, "");
  }
  if (more > 0) set.left_out = fmt::format("{} more kinds of rays and cases of the numerical suite", more);
  if (set.plots.empty())
    set.left_out =
        fmt::format("no work was counted in {} scenes or more of different stiffness", kLeastScenes);
  return set;
}

}  // namespace rayshoot::analysis
