#pragma once

#include <string>
#include <vector>

#include "analysis/tables/groups.h"

namespace rayshoot::analysis {

/// A technique in one precision on one scene and its rays: what it costs and how far off its answers are.
struct WorkPrecision {
  std::string label;
  const Entry* entry = nullptr;
  /// Graded answers that are not "exact", "ambiguous" or "near", of 10^9, and the bound below which that rate is at
  /// 95 %.
  double wrong_per_billion = 0, wrong_upper = 0;
  /// The error in t that 999 of 1000 hits do not exceed, in units in the last place of a float in either precision.
  double float_ulps_p999 = 0;
  double ns_per_ray = 0;
  /// Whether no other point is as fast and errs as little, and better in one of the two.
  bool on_frontier = false;
};

/// The points of a scene and its rays, through all scalars and intersectors, from the fastest to the slowest. Only
/// what was timed and graded is there.
struct WorkPrecisionDiagram {
  std::string scene_id, rays_id;
  /// Absent where the scene has no smallest feature.
  std::optional<double> stiffness;
  std::vector<WorkPrecision> points;
};

/// One diagram for every scene and ray set with at least one point, in the order of the groups, which must outlive
/// them.
std::vector<WorkPrecisionDiagram> work_precision_diagrams(const std::vector<Group>& groups);

}  // namespace rayshoot::analysis
