#pragma once

#include <string>
#include <vector>

#include "analysis/tables/groups.h"

namespace rayshoot::analysis {

/// What a report says, in sentences.
std::vector<std::string> summary_of(const report::Report& report, const std::vector<Group>& groups);

}  // namespace rayshoot::analysis
