#pragma once

#include <map>
#include <string>

namespace rayshoot {

/// The files of harness/plan/suites by name, without their suffix.
const std::map<std::string, std::string>& builtin_suite_texts();

/// The files of harness/plan/published likewise.
const std::map<std::string, std::string>& builtin_published_texts();

}  // namespace rayshoot
