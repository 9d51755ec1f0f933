#pragma once

#include <functional>

#include "accel/core/engine.h"

namespace rayshoot {

/// The registry entry of a technique of the papers that an expression of the algebra says: `expression` writes it, for
/// arguments of the technique's own parameters and the number of objects of the scene. `levels` are those of the expression;
/// they make up the events.
TechniqueEntry define_composition(
    TechniqueInfo info, std::size_t levels,
    const std::function<std::string(const Arguments&, std::uint32_t objects)>& expression);

}  // namespace rayshoot
