#pragma once

#include <string>

#include "harness/choose/constants.h"
#include "harness/choose/statistics.h"
#include "harness/plan/catalogue.h"

namespace rayshoot {

/// Why a candidate need not be built for a scene, from cheap statistics and from what is known of the technique; empty
/// where it may be worth it.
std::string why_not_weighed(const TechniqueChoice& candidate, const SceneStatistics& scene,
                            const Constants& constants);

}  // namespace rayshoot
