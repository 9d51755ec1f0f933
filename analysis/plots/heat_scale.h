#pragma once

#include <array>
#include <cstdint>
#include <vector>

/// Numbers as colours, in plots and in the pictures that `rayshoot render` draws.
namespace rayshoot::analysis {

/// Red, green and blue.
using Colour = std::array<std::uint8_t, 3>;

/// The colour for a value from 0 to 1: dark violet over green to yellow, in steps that look even and
/// that colour-blind readers can tell apart; straight lines between nine points of the map `viridis` (Smith and
/// van der Walt 2015). Values outside get the colour of the nearest end.
Colour heat_colour(double value);

/// The number at which colours end: a round one that no more than one value in 200 exceeds, so that a few outliers do
/// not leave the rest in the dark.
double end_of_scale(std::vector<double> values);

}  // namespace rayshoot::analysis
