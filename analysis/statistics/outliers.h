#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace rayshoot::analysis {

/// The places of values that lie farther from the median than ten standard deviations, estimated as 1.4826 times the
/// median of the distances from the median. They are told, and kept: a median does not mind them, and
/// leaving them out would be choosing. None where half of the values are equal, which says nothing of how they spread.
std::vector<std::size_t> outliers(std::span<const double> sample);

}  // namespace rayshoot::analysis
