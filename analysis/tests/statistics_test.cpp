#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "analysis/statistics/geometric_mean.h"
#include "analysis/statistics/sample.h"

namespace rayshoot::analysis {
namespace {

using Values = std::vector<double>;

std::optional<Interval> median_interval(const Values& values, double confidence = kConfidence) {
  return median(values, confidence)->interval;
}

Values one_to(int count) {
  Values values(static_cast<std::size_t>(count));
  std::iota(values.begin(), values.end(), 1.0);
  return values;
}

TEST(Median, IsTheMiddleOrHalfwayBetweenTheTwoInTheMiddle) {
  EXPECT_EQ(median(Values{3, 1, 2})->value, 2);
  EXPECT_EQ(median(Values{4, 1, 3, 2})->value, 2.5);
  EXPECT_EQ(median(Values{7})->value, 7);
  EXPECT_FALSE(median(Values{}));
}

/// Chances by hand: of n = 5 the whole range covers with 1 - 2/32 = 0.9375, of 6 with 1 - 2/64 = 0.969, of 8 with
/// 0.992 and without the ends with 1 - 18/256 = 0.930, of 9 without the ends with 1 - 20/512 = 0.961. The ranks of 10
/// are 2 and 9 (0.979), of 20 they are 6 and 15 (0.959): the textbook tables.
TEST(Median, HasTheIntervalOfTheSignTest) {
  EXPECT_FALSE(median_interval(one_to(5)));
  EXPECT_EQ(median_interval(one_to(6)), (Interval{1, 6}));
  EXPECT_EQ(median_interval(one_to(8)), (Interval{1, 8}));
  EXPECT_EQ(median_interval({9, 8, 7, 6, 5, 4, 3, 2, 1}), (Interval{2, 8}));
  EXPECT_EQ(median_interval(one_to(10)), (Interval{2, 9}));
  EXPECT_EQ(median_interval(one_to(20)), (Interval{6, 15}));
  EXPECT_EQ(median_interval(one_to(5), 0.9), (Interval{1, 5}));
}

/// 21 values of a skewed distribution: the ranks 6 and 16 cover its median ln 2 with chance 0.9733.
TEST(Median, IntervalCoversAsOftenAsItSays) {
  std::mt19937_64 generator(1);
  std::exponential_distribution<double> skewed;
  int covered = 0;
  for (int trial = 0; trial < 10000; ++trial) {
    Values values(21);
    for (double& value : values) value = skewed(generator);
    const auto interval = median_interval(values);
    covered += interval->low <= std::log(2) && std::log(2) <= interval->high;
  }
  EXPECT_NEAR(covered / 10000.0, 0.9733, 0.005);
}

/// s of {2, 4, 4, 4, 5, 5, 7, 9} is sqrt(32 / 7), so the half width is 1.959964 sqrt(32 / 56) = 1.481594.
TEST(Mean, HasTheIntervalOfTheNormalDistribution) {
  const auto estimate = mean(Values{2, 4, 4, 4, 5, 5, 7, 9});
  EXPECT_EQ(estimate->value, 5);
  EXPECT_NEAR(estimate->interval->low, 5 - 1.481594, 1e-6);
  EXPECT_NEAR(estimate->interval->high, 5 + 1.481594, 1e-6);
  EXPECT_FALSE(mean(Values{1})->interval);
  EXPECT_FALSE(mean(Values{}));
}

/// The pairs have the ratios 2, 3, 2, 4, 2.5, 2: their median lies halfway, by logarithms, between 2 and 2.5.
TEST(Ratio, PairsRepetitionsOfEqualNumber) {
  const auto estimate = ratio(Values{2, 6, 4, 40, 25, 200}, Values{1, 2, 2, 10, 10, 100});
  EXPECT_NEAR(estimate->value, std::sqrt(2 * 2.5), 1e-12);
  EXPECT_NEAR(estimate->interval->low, 2, 1e-12);
  EXPECT_NEAR(estimate->interval->high, 4, 1e-12);
  EXPECT_FALSE(ratio(Values{1, 2}, Values{1, 2})->interval);
}

TEST(Ratio, IsTheInverseOfItsInverse) {
  const Values a{5, 7, 6, 8}, b{2, 3, 5, 1};
  EXPECT_NEAR(ratio(a, b)->value * ratio(b, a)->value, 1, 1e-12);
}

/// Of {1, 4} over {1, 2, 4} the ratios are 1/4, 1/2, 1, 1, 2 and 4.
TEST(Ratio, TakesAllPairsOfUnequalNumber) {
  EXPECT_NEAR(ratio(Values{1, 4}, Values{1, 2, 4})->value, 1, 1e-12);
  EXPECT_FALSE(ratio(Values{1, 4}, Values{1, 2, 4})->interval);
  EXPECT_TRUE(ratio(Values{1, 2, 4}, Values{1, 2, 4, 8, 16, 32})->interval);
}

TEST(Ratio, NeedsPositiveValues) {
  EXPECT_FALSE(ratio(Values{}, Values{1}));
  EXPECT_FALSE(ratio(Values{1}, Values{}));
  EXPECT_FALSE(ratio(Values{1, 0}, Values{1, 2}));
  EXPECT_FALSE(ratio(Values{1, 2}, Values{1, 0}));
}

TEST(RelativeError, IsSigned) {
  EXPECT_EQ(*relative_error(15, 10), 0.5);
  EXPECT_EQ(*relative_error(5, 10), -0.5);
  EXPECT_FALSE(relative_error(1, 0));
  EXPECT_FALSE(relative_error(std::nullopt, 1));
  EXPECT_FALSE(relative_error(1, std::nullopt));
}

TEST(GeometricMean, LeavesOutMissingCellsAndCountsThem) {
  const std::vector<std::optional<double>> cells{1, std::nullopt, 4, 0, 16, -1};
  const GeometricMean mean = geometric_mean(cells);
  EXPECT_NEAR(*mean.value, 4, 1e-12);
  EXPECT_EQ(mean.cells, 3u);
  EXPECT_EQ(mean.missing, 3u);
  EXPECT_FALSE(geometric_mean({}).value);
}

/// A product of a thousand large numbers would be infinite.
TEST(GeometricMean, DoesNotOverflow) {
  const std::vector<std::optional<double>> cells(1000, 1e300);
  EXPECT_NEAR(*geometric_mean(cells).value / 1e300, 1, 1e-9);
}

}  // namespace
}  // namespace rayshoot::analysis
