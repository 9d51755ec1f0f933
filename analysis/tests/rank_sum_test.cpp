#include "analysis/statistics/rank_sum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "analysis/statistics/same_twice.h"

namespace rayshoot::analysis {
namespace {

using Values = std::vector<double>;

/// `count` values whose logarithms are normal, about `center`.
Values noisy(std::mt19937_64& generator, std::size_t count, double center, double deviation) {
  std::normal_distribution<double> normal(0, deviation);
  Values values(count);
  for (double& value : values) value = center * std::exp(normal(generator));
  return values;
}

/// Of 3 and 3 values there are 20 orders; 1, 1, 2, 3, 3, 3, ... of them have 0, 1, 2, 3, 4, 5, ... pairs the other way.
TEST(RankSum, HasTheChancesOfTheTextbooks) {
  EXPECT_NEAR(chance_of_ranks(Values{4, 5, 6}, Values{1, 2, 3}), 1.0 / 20, 1e-12);
  EXPECT_NEAR(chance_of_ranks(Values{3, 5, 6}, Values{1, 2, 4}), 2.0 / 20, 1e-12);
  EXPECT_NEAR(chance_of_ranks(Values{3, 4, 6}, Values{1, 2, 5}), 4.0 / 20, 1e-12);
  EXPECT_NEAR(chance_of_ranks(Values{1, 2, 3}, Values{4, 5, 6}), 1, 1e-12);
  EXPECT_EQ(chance_of_ranks(Values{}, Values{1}), 1);
  EXPECT_NEAR(chance_of_ranks(Values{5, 5, 5}, Values{5, 5, 5}), 1, 1e-12) << "equal values are no evidence";
}

/// The chance of n and n values with so many pairs the other way round.
double chance_of_pairs(std::size_t n, std::size_t pairs) {
  Values x, y;
  for (std::size_t i = 0; i < n; ++i) x.push_back(static_cast<double>(2 * n + 2 * i));
  // A y below all x turns no pair, one above the k lowest x turns k.
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t below = std::min(pairs, n);
    pairs -= below;
    y.push_back(below == 0 ? 1 : x[below - 1] + 1);
  }
  return chance_of_ranks(x, y);
}

/// The table of Mann and Whitney's U for 5 % on both sides: 23 for 10 and 10 values, 17 for 9 and 9, 2 for 5 and 5.
TEST(RankSum, HasTheCriticalValuesOfTheTextbooks) {
  EXPECT_LE(chance_of_pairs(10, 23), 0.025);
  EXPECT_GT(chance_of_pairs(10, 24), 0.025);
  EXPECT_LE(chance_of_pairs(9, 17), 0.025);
  EXPECT_GT(chance_of_pairs(9, 18), 0.025);
  EXPECT_LE(chance_of_pairs(5, 2), 0.025);
  EXPECT_GT(chance_of_pairs(5, 3), 0.025);
}

/// 30 and 30 values have the exact distribution, 31 and 31 the normal one.
TEST(RankSum, PassesOverToTheNormalDistributionWithoutAStep) {
  const auto normal = [](double n, double pairs) {
    return std::erfc(-(pairs + 0.5 - n * n / 2) / std::sqrt(n * n * (2 * n + 1) / 6)) / 2;
  };
  for (const std::size_t pairs : {200u, 300u, 350u, 400u, 450u, 500u}) {
    const double count = static_cast<double>(pairs);
    EXPECT_NEAR(chance_of_pairs(30, pairs), normal(30, count), 2e-3);
    EXPECT_NEAR(chance_of_pairs(31, pairs), normal(31, count), 1e-12);
  }
}

/// Of {2, 8} and {1, 2} the ratios are 1, 2, 4 and 8: the middle is halfway, by logarithms, between 2 and 4.
TEST(IndependentRatio, IsTheMedianOfAllRatios) {
  EXPECT_NEAR(independent_ratio(Values{2, 8}, Values{1, 2})->value, std::sqrt(8), 1e-12);
  EXPECT_FALSE(independent_ratio(Values{2, 8}, Values{1, 2})->interval);
  EXPECT_FALSE(independent_ratio(Values{}, Values{1}));
  EXPECT_FALSE(independent_ratio(Values{1}, Values{0}));
}

/// Of 4 and 4 values the extremes have a chance of 1/70 each: the interval is the range of all ratios.
TEST(IndependentRatio, HasTheRangeAsIntervalOfFourAndFour) {
  const auto estimate = independent_ratio(Values{10, 11, 12, 13}, Values{1, 2, 3, 4});
  EXPECT_NEAR(estimate->interval->low, 10.0 / 4, 1e-12);
  EXPECT_NEAR(estimate->interval->high, 13.0, 1e-12);
  EXPECT_FALSE(independent_ratio(Values{10, 11, 12}, Values{1, 2, 3})->interval);
}

/// 9 and 9 values: the interval leaves out the factor with a chance of at most 5 %, by its table 4.0 %.
TEST(IndependentRatio, IntervalCoversAsOftenAsItSays) {
  std::mt19937_64 generator(1);
  int covered = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const auto interval =
        independent_ratio(noisy(generator, 9, 3, 0.1), noisy(generator, 9, 2, 0.1))->interval;
    covered += interval->low <= 1.5 && 1.5 <= interval->high;
  }
  EXPECT_NEAR(covered / 4000.0, 0.96, 0.01);
}

TEST(IndependentRatio, LiesBeyondAFactorWhenTheChanceIsSmall) {
  std::mt19937_64 generator(2);
  int beyond = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Values a = noisy(generator, 9, 1.1, 0.05), b = noisy(generator, 7, 1, 0.05);
    const bool small = chance_of_ranks(a, b, 1.05) <= (1 - kConfidence) / 2;
    EXPECT_EQ(independent_ratio(a, b)->interval->low > 1.05, small);
    beyond += small;
  }
  EXPECT_GT(beyond, 100);
  EXPECT_LT(beyond, 900);
}

/// Halves of 5 and 5 differ by chance in 3.2 % of samples.
TEST(SameTwice, FindsNothingWhereNothingChanged) {
  std::mt19937_64 generator(1);
  std::vector<Values> samples(2000);
  for (Values& sample : samples) sample = noisy(generator, 10, 1000, 0.02);
  samples.push_back({1, 2, 3, 4, 5, 6, 7});
  const SameTwice check = same_twice(samples);
  EXPECT_EQ(check.samples, 2000u);
  EXPECT_NEAR(static_cast<double>(check.differ) / 2000, 0.032, 0.01);
  EXPECT_GT(check.chance, 0.5);
}

TEST(SameTwice, FindsAMachineThatBecomesSlower) {
  std::mt19937_64 generator(1);
  std::vector<Values> samples(100);
  for (Values& sample : samples) {
    sample = noisy(generator, 10, 1000, 0.02);
    for (std::size_t i = 0; i < sample.size(); ++i) sample[i] *= 1 + 0.02 * static_cast<double>(i);
  }
  const SameTwice check = same_twice(samples);
  EXPECT_GT(check.differ, 80u);
  EXPECT_LT(check.chance, 1e-6);
}

/// Two samples of which one differs: the chance of one or two is 1 - 0.95^2.
TEST(SameTwice, HasTheChanceOfTheBinomialDistribution) {
  const std::vector<Values> samples{{1, 2, 3, 4, 15, 16, 17, 18}, {1, 8, 2, 7, 3, 6, 4, 5}};
  EXPECT_EQ(same_twice(samples).differ, 1u);
  EXPECT_NEAR(same_twice(samples).chance, 1 - 0.95 * 0.95, 1e-12);
  EXPECT_EQ(same_twice({}).chance, 1);
}

}  // namespace
}  // namespace rayshoot::analysis
