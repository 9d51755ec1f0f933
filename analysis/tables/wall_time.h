#pragma once

#include <string>

#include "harness/report/report.h"

namespace rayshoot::analysis {

/// "timed work 73 % of 43.0 s (trace 61 %, build 12 %); count 15 %, verify 9 %, ...": what a run's wall time went into, small
/// shares left out. Empty where the report does not tell.
std::string wall_time(const report::Run& run);

}  // namespace rayshoot::analysis
