#pragma once

#include <optional>
#include <span>

/// Statistics of repeated measurements: medians with intervals that assume no distribution, and their ratios.
namespace rayshoot::analysis {

inline constexpr double kConfidence = 0.95;

struct Interval {
  double low = 0, high = 0;
  friend bool operator==(const Interval&, const Interval&) = default;
};

/// A value with its confidence interval; no interval where the sample is too small for one.
struct Estimate {
  double value = 0;
  std::optional<Interval> interval;
};

/// The median with an interval between two order statistics, each as far from its end of the sorted sample as the
/// sign test allows: it covers the median of any continuous distribution with at least `confidence` (at 0.95 from
/// six values on). Nothing for an empty sample.
std::optional<Estimate> median(std::span<const double> sample, double confidence = kConfidence);

/// The arithmetic mean with the interval of the normal distribution, mean +- z s / sqrt(n). For many values, such
/// as one per ray: for a handful Student's interval would be wider. Nothing for an empty sample.
std::optional<Estimate> mean(std::span<const double> sample, double confidence = kConfidence);

/// How many times larger the values of `numerator` are than those of `denominator`. Samples of equal length are
/// paired: the median of the logarithms of the ratios of their i-th values, with the interval of that median.
/// Otherwise that of independent samples, by ranks (rank_sum.h). Nothing when a sample is empty or has a value of 0 or
/// less.
std::optional<Estimate> ratio(std::span<const double> numerator, std::span<const double> denominator,
                              double confidence = kConfidence);

/// Whether there is a value, and none of 0 or less.
bool all_positive(std::span<const double> sample);

/// predicted / measured - 1; nothing when nothing was measured or 0.
std::optional<double> relative_error(std::optional<double> predicted, std::optional<double> measured);

}  // namespace rayshoot::analysis
