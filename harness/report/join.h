#pragma once

#include <vector>

#include "harness/report/report.h"

namespace rayshoot::report {

/// One report of several runs: scenes that were run one by one, so that a machine need not be kept quiet for all of them at
/// once. It began with the first and took the seconds of all. Throws ReportError where they are of different machines,
/// commits or seeds, or where two have a scene in common.
Report joined(const std::vector<Report>& reports);

}  // namespace rayshoot::report
