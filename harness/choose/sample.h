#pragma once

#include "scenes/rays/ray_set.h"

namespace rayshoot {

/// About `count` rays of a set, spread over it: it is cut into strata of equal size, and of each a run of `neighbours`
/// rays is taken at random. Those that ask for the closest hit and those that ask for any keep their shares. The whole
/// set where it has no more.
RaySet stratified(const RaySet& set, std::size_t count, std::size_t neighbours, std::uint64_t seed);

}  // namespace rayshoot
