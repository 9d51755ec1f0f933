#pragma once

#include <optional>
#include <span>

#include "analysis/statistics/sample.h"

/// Two samples that were not taken in turns, held against each other by ranks (Wilcoxon 1945, Mann & Whitney 1947).
/// No distribution is assumed, only that one sample is the other one times a factor. Nine values each are enough
/// for chances of 1 in 48620, where the sign test of nine pairs ends at 1 in 512: so it is this test
/// that survives a correction for the hundreds of cells of a report.
namespace rayshoot::analysis {

/// How many times larger the values of `numerator` are than those of `denominator`: the median of the ratios of
/// all pairs (Hodges & Lehmann 1963), with the interval of the factors that the rank sum test does not refuse; no
/// interval where the samples are too small for one. Nothing when a sample is empty or has a value of 0 or less.
std::optional<Estimate> independent_ratio(std::span<const double> numerator,
                                          std::span<const double> denominator,
                                          double confidence = kConfidence);

/// The chance of ranks as high as those of `above`, or higher, if it were no more than `factor` times `below`: 1 when
/// a sample is empty. The interval above lies beyond a factor exactly when this is at most (1 - confidence) / 2.
double chance_of_ranks(std::span<const double> above, std::span<const double> below, double factor = 1);

}  // namespace rayshoot::analysis
