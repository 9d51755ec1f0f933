#pragma once

#include <map>
#include <string>

#include "accel/core/technique.h"
#include "harness/report/report.h"
#include "harness/verify/grades.h"

/// What was found out, in the terms of the report.
namespace rayshoot {

/// `events` names the technique's own counts, as its TechniqueInfo does.
report::Work record(const Work& work, const std::vector<std::string>& events);
report::Structure record(const StructureStats& stats);
report::Errors record(const Grades& grades);
std::map<std::string, report::ConfigValue> config_of(const Arguments& arguments);

}  // namespace rayshoot
