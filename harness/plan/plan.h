#pragma once

#include "harness/plan/catalogue.h"
#include "harness/plan/suite.h"
#include "scenes/rays/load_rays.h"

namespace rayshoot {

/// A suite, understood: every name in it is known and every value is in range.
struct Plan {
  Suite suite;
  std::vector<RaySpec> rays;
  std::vector<TechniqueChoice> techniques;

  /// Number of combinations of scene, rays, technique, scalar and intersector, left out ones included.
  std::size_t cells() const {
    return suite.scenes.size() * rays.size() * techniques.size() * suite.scalars.size() *
           suite.intersectors.size();
  }
};

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
