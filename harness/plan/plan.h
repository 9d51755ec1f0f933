#pragma once

#include "harness/plan/catalogue.h"
#include "harness/plan/published.h"
#include "harness/plan/suite.h"
#include "scenes/rays/load_rays.h"

namespace rayshoot {

/// A suite, understood: every name in it is known and every value is in range.
struct Plan {
  Suite suite;
  std::vector<RaySpec> rays;
  std::vector<TechniqueChoice> techniques;
  /// What the run is held against; scenes by their ids.
  Published published{};

  /// Number of combinations of scene, rays, technique, scalar and intersector, left out ones included.
  std::size_t cells() const;
};

/// Whether the technique is to run on the scene of that id.
bool is_planned(const TechniqueChoice& technique, const std::string& scene_id);

/// Whether the work of a technique on these rays is to be mapped.
bool is_mapped(const Suite& suite, const TechniqueChoice& technique, const RaySpec& rays);

/// Throws InputError when something in the suite is not known or not accepted.
Plan make_plan(Suite suite);

/// What is known of a cell before it runs.
struct CellFacts {
  const Scene& scene;
  const RaySpec& rays;
  /// Number of rays; 0 when the scene cannot have them.
  std::uint64_t ray_count;
  const TechniqueChoice& technique;
  const std::string& scalar;
  const std::string& intersector;
};

/// Why a cell is left out; empty when it is to be run.
std::string why_left_out(const Suite& suite, const CellFacts& cell);

}  // namespace rayshoot
