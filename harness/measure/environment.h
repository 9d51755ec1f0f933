#pragma once

#include "harness/report/report.h"

namespace rayshoot {

/// The machine and the build. What cannot be found out is empty, or "unavailable".
report::Environment environment();

/// A run that starts now: its id, time and the state of the source tree the program was built from.
report::Run started_run(const std::string& command, std::uint64_t seed);

}  // namespace rayshoot
