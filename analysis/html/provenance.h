#pragma once

#include <vector>

#include "analysis/plots/plots.h"
#include "analysis/tables/table.h"
#include "harness/report/report.h"

namespace rayshoot::analysis {

/// Where reports come from: command, program and machine, a column each.
Table provenance_table(const std::vector<report::Report>& reports);

/// Objects and rays: what was traced.
Table inputs_table(const std::vector<report::Report>& reports);

/// What was not done, and why: cells, work that scenes do not need, objects set aside, plots.
Table left_out_table(const std::vector<report::Report>& reports, const std::vector<PlotSet>& plots);

}  // namespace rayshoot::analysis
