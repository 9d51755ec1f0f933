#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace rayshoot::analysis {

/// A geometric mean over cells of which some are missing.
///
/// The rule: a missing cell is left out and counted, never replaced by a guess or a penalty. So a mean always comes
/// with the number of cells behind it, and two means may be compared only where those are the same cells.
struct GeometricMean {
  /// Nothing when every cell is missing.
  std::optional<double> value;
  std::size_t cells = 0;
  std::size_t missing = 0;
};

/// Cells without a value, and those of 0 or less, which have no logarithm, are missing.
GeometricMean geometric_mean(std::span<const std::optional<double>> cells);

}  // namespace rayshoot::analysis
