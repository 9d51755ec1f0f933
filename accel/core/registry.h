#pragma once

#include <span>

#include "accel/core/engine.h"

namespace rayshoot {

/// All techniques, sorted by id.
std::span<const TechniqueEntry* const> technique_entries();

/// The technique of that id; throws InputError with the known ones otherwise.
const TechniqueEntry& technique_entry(const std::string& id);

}  // namespace rayshoot
