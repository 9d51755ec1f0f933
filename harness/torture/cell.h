#pragma once

#include "harness/plan/catalogue.h"
#include "scenes/geometry/intersector.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

/// One technique on one setting of a case.
struct TortureCell {
  const StiffCase* stiff_case = nullptr;
  /// All settings of the case, and which of them this is.
  const std::vector<StiffSetting>* settings = nullptr;
  std::size_t setting = 0;
  const TechniqueChoice* technique = nullptr;
  std::string scalar;
  Intersector intersector = Intersector::watertight;
  bool flush_to_zero = false;
  std::uint64_t seed = 1;
  /// Rays to trace, and how many of the first are graded by the exact oracle, asked for any hit, and counted.
  std::uint64_t rays = 0, graded_rays = 0;

  const StiffSetting& of_setting() const { return (*settings)[setting]; }
  const StiffSetting* base() const { return of_setting().base ? &(*settings)[*of_setting().base] : nullptr; }
};

}  // namespace rayshoot
