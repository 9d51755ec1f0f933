#pragma once

#include "harness/render/image.h"

namespace rayshoot {

/// The colour for a value from 0 to 1: dark violet over green to yellow, in steps that look even and that
/// colour-blind readers can tell apart; straight lines between nine points of the map `viridis` (Smith and
/// van der Walt 2015). Values outside get the colour of the nearest end.
Rgb heat_colour(double value);

}  // namespace rayshoot
