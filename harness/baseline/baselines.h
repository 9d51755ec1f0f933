#pragma once

#include <span>
#include <string>

#include "accel/core/engine.h"

namespace rayshoot {

/// The points of comparison, sorted by id: Embree, Embree's tree over our objects, and zero overhead.
std::span<const TechniqueEntry* const> baseline_entries();

/// Version of the Embree library in use, for example "3.13.5".
std::string embree_version();

/// Whether that library was built with assertions, which the expressions they would print give away. Debian's is: a release
/// build is up to 4 % faster, and does not abort on rays that are not finite.
bool embree_has_assertions();

}  // namespace rayshoot
