#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace rayshoot::analysis {

/// An A/A check: what was measured twice and did not change must not look changed.
struct SameTwice {
  /// Samples that are long enough to be halved, and those whose halves differ at 95 %.
  std::size_t samples = 0, differ = 0;
  /// The chance that so many differ, or more, where each does with a chance of 5 %: small when the machine drifted
  /// while it measured, and the intervals of the report are then too narrow.
  double chance = 1;
};

/// Holds the first half of every sample's values, in the order in which they were measured, against the second half.
/// Samples of fewer than eight values are passed over: their halves cannot differ at 95 %.
SameTwice same_twice(std::span<const std::vector<double>> samples);

}  // namespace rayshoot::analysis
