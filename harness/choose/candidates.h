#pragma once

#include <string>
#include <vector>

#include "harness/choose/constants.h"
#include "harness/plan/catalogue.h"

namespace rayshoot {

/// Stands for all candidates that are known.
inline constexpr const char* kAllCandidates = "all";

/// What there is to choose among.
struct Candidates {
  std::vector<TechniqueChoice> techniques;
  /// Whether the user named them: then none is left out for its looks.
  bool named = false;
};

/// The candidates of those specifications; without any, all that are known: every technique but the baselines, and the
/// compositions that have constants. Throws InputError on what is no technique, and on baselines.
Candidates candidates_of(const std::vector<std::string>& specs, const Constants& constants);

}  // namespace rayshoot
