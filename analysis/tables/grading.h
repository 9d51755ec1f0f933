#pragma once

#include "analysis/tables/table.h"
#include "harness/report/report.h"

namespace rayshoot::analysis {

/// A table for every torture case: a row for each technique, precision and intersector, over all settings of the case
/// or `by_setting`.
std::vector<Table> grading_tables(const std::vector<report::Report>& reports, bool by_setting);

}  // namespace rayshoot::analysis
