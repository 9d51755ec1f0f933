#include "analysis/work_precision/frontier.h"

#include <algorithm>
#include <cmath>

#include "analysis/statistics/rate.h"
#include "analysis/tables/comparison.h"

namespace rayshoot::analysis {

namespace {
/// A float has 29 bits less than a double.
double float_ulps(const report::Errors& errors, const std::string& scalar) {
  if (!errors.ulps_of_t) return 0;
  return scalar == "double" ? std::ldexp(errors.ulps_of_t->p999, -29) : errors.ulps_of_t->p999;
}

std::optional<WorkPrecision> point_of(const Group& group, const Entry& entry) {
  const auto& errors = entry.measurement->errors;
  const std::optional<Estimate> time = time_per_ray(entry);
  if (!errors || errors->graded_rays == 0 || !time) return std::nullopt;
  const std::uint64_t wrong = report::wrong_answers(*errors);
  return WorkPrecision{.label = entry.label + ", " + precision_of(group),
                       .entry = &entry,
                       .wrong_per_billion = *per_billion(wrong, errors->graded_rays),
                       .wrong_upper = *upper_bound_per_billion(wrong, errors->graded_rays),
                       .float_ulps_p999 = float_ulps(*errors, group.scalar),
                       .ns_per_ray = time->value};
}

bool beats(const WorkPrecision& a, const WorkPrecision& b) {
  const bool no_worse = a.ns_per_ray <= b.ns_per_ray && a.wrong_per_billion <= b.wrong_per_billion &&
                        a.float_ulps_p999 <= b.float_ulps_p999;
  return no_worse && (a.ns_per_ray < b.ns_per_ray || a.wrong_per_billion < b.wrong_per_billion ||
                      a.float_ulps_p999 < b.float_ulps_p999);
}

void finish(WorkPrecisionDiagram& diagram) {
  auto& points = diagram.points;
  for (WorkPrecision& point : points)
    point.on_frontier = std::none_of(points.begin(), points.end(),
                                     [&](const WorkPrecision& other) { return beats(other, point); });
  std::stable_sort(points.begin(), points.end(), [](const WorkPrecision& a, const WorkPrecision& b) {
    return a.ns_per_ray < b.ns_per_ray;
  });
}

}  // namespace

std::vector<WorkPrecisionDiagram> work_precision_diagrams(const std::vector<Group>& groups) {
  std::vector<WorkPrecisionDiagram> diagrams;
  for (const Group& group : groups) {
    auto found = std::find_if(diagrams.begin(), diagrams.end(), [&](const WorkPrecisionDiagram& diagram) {
      return diagram.scene_id == group.scene_id && diagram.rays_id == group.rays_id;
    });
    if (found == diagrams.end()) {
      const auto stiffness = group.scene ? group.scene->stiffness : std::nullopt;
      found = diagrams.insert(diagrams.end(), {group.scene_id, group.rays_id, stiffness, {}});
    }
    for (const Entry& entry : group.entries)
      if (auto point = point_of(group, entry)) found->points.push_back(std::move(*point));
  }
  std::erase_if(diagrams, [](const WorkPrecisionDiagram& diagram) { return diagram.points.empty(); });
  for (WorkPrecisionDiagram& diagram : diagrams) finish(diagram);
  return diagrams;
}

}  // namespace rayshoot::analysis
