#pragma once

#include "analysis/tables/table.h"
#include "harness/report/report.h"

namespace rayshoot::analysis {

/// A table for every torture case: a row for each technique, precision and intersector, over all settings of the case;
/// in CSV a row for every setting.
std::string render_gradings(const std::vector<report::Report>& reports, Format format);

/// The largest rate per 10^9 that so many events of so many trials allow, at 95 % (the upper end of Wilson's interval;
/// without an event 3/n, as the rule of three has it). Absent without trials.
std::optional<double> upper_bound_per_billion(std::uint64_t events, std::uint64_t trials);

}  // namespace rayshoot::analysis
