#pragma once

#include <map>
#include <string>

namespace rayshoot {

/// The files of harness/plan/suites by name, without their suffix.
const std::map<std::string, std::string>& builtin_suite_texts();

}  // namespace rayshoot
