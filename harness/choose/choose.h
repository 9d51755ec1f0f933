#pragma once

#include <optional>

#include "harness/choose/constants.h"
#include "harness/measure/run.h"

namespace rayshoot {

/// Among the techniques of a suite, stands for the one that is chosen.
inline constexpr const char* kAuto = "auto";

struct ChooserOptions {
  /// What to choose among: specifications, "all" for all that are known. Empty for all but those that a scene does not need
  /// (prune.h).
  std::vector<std::string> candidates;
  /// Whether near ties are decided by timing them; without it the choice is the same whenever it is made.
  bool race = true;
  /// Rays that a build is to serve: its time is then part of the cost.
  std::optional<double> expected_rays;
};

/// Choose a technique for every combination of scene, rays, scalar and intersector of a plan, whose own techniques do not
/// matter. Throws InputError where none is left to choose. Stopped, it returns the choices that were made.
std::vector<report::Choice> choose_techniques(const Plan& plan, const ChooserOptions& options,
                                              const Constants& constants, RunObserver& observer,
                                              const std::function<bool()>& stopped);

/// Add what was chosen to a plan, each technique for its scene; with `all`, everything that was weighed.
void plan_choices(Plan& plan, const std::vector<report::Choice>& choices, bool all);

}  // namespace rayshoot
