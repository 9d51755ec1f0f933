#pragma once

#include <map>
#include <string>

#include "harness/report/report.h"

namespace rayshoot::analysis {

/// All that is the same each time a cell is measured, by its path in the report ("work.object_tests"), every number in
/// as many digits as bring it back: the verdict, the work, the structure and the errors. Not
/// the bytes of Embree's structures, which differ from build to build.
std::map<std::string, std::string> exact_counts(const report::Measurement& measurement);
/// The same of answers of the numerical suite: "grading.leaks".
std::map<std::string, std::string> exact_counts(const report::Grading& grading);

}  // namespace rayshoot::analysis
