#pragma once

#include "analysis/tables/table.h"
#include "harness/report/report.h"

namespace rayshoot::analysis {

/// Error against run time: a table for every scene and ray set of which answers were graded, and, where there are
/// several scenes, one more with the best technique of each precision over stiffness.
std::vector<Table> work_precision_tables(const std::vector<report::Report>& reports);

}  // namespace rayshoot::analysis
