#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scenes/core/needs.h"
#include "scenes/core/spec.h"

namespace rayshoot::cli {

/// Objects keep their members in the order in which they were written.
using Json = nlohmann::ordered_json;

/// The parameters of a scene, a ray distribution or a technique as JSON, one object each.
Json parameters_json(const std::vector<Parameter>& parameters);

/// The same in words: "density=1 (0.001 to 1000), mailbox=auto (on|off|auto)"; "none" without any.
std::string parameters_text(const std::vector<Parameter>& parameters);

/// What tracing a scene calls for, a few words each.
std::vector<std::string> needs_list(const SceneNeeds& needs);

}  // namespace rayshoot::cli
