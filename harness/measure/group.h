#pragma once

#include "harness/measure/phases.h"
#include "harness/measure/run.h"

namespace rayshoot {

/// Rays of a plan, generated for a scene.
struct PreparedRays {
  const RaySpec* spec;
  RaySet set;
};

/// The cells that share a scene, a precision and a treatment of cones: their structures are built once and
/// stay alive together while they are timed in turns.
struct GroupInput {
  const Plan& plan;
  Phases& phases;
  const Scene& scene;
  ConeSides cone_sides;
  std::string scalar;
  std::string intersector;
  std::vector<const PreparedRays*> rays;
};

/// Run the cells of a group and append what they yield to `report`.
template <class Real>
void run_group(const GroupInput& input, report::Report& report, RunObserver& observer,
               const std::function<bool()>& stopped);

extern template void run_group<float>(const GroupInput&, report::Report&, RunObserver&,
                                      const std::function<bool()>&);
extern template void run_group<double>(const GroupInput&, report::Report&, RunObserver&,
                                       const std::function<bool()>&);

}  // namespace rayshoot
