#include "analysis/statistics/priced_sums.h"

#include <gmock/gmock.h>

#include <cmath>

namespace rayshoot::analysis {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;

constexpr double kSquares = 1e9;

/// Two amounts at two prices.
PricedSum two(double first, double second) { return {{first, {{0, 1}}}, {second, {{1, 1}}}}; }

TEST(PricedSums, AreWorthTheirAmountsTimesPrices) {
  const PricedSum sum{{2, {{0, 1}, {1, 3}}}, {5, {}}, {0, {{1, 1000}}}};
  EXPECT_DOUBLE_EQ(value_of(sum, std::vector{0.5, 0.25}), 2 * std::exp(0.5 + 0.75) + 5);
}

TEST(PricedSums, FindPricesThatAreThere) {
  const std::vector<PricedSum> sums{two(1, 0), two(1, 4), two(0, 3), two(7, 1)};
  std::vector<double> values;
  for (const PricedSum& sum : sums)
    values.push_back(value_of(sum, std::vector{std::log(8.0), std::log(0.5)}));
  EXPECT_THAT(fit_priced_sums(sums, values, std::vector<Belief>(2), kSquares),
              ElementsAre(DoubleNear(std::log(8.0), 1e-4), DoubleNear(std::log(0.5), 1e-4)));
}

/// One measurement of 9 and a belief in 1 that counts as much as two: the logarithm is a third of the way.
TEST(PricedSums, WeighBeliefsAgainstMeasurements) {
  const std::vector<PricedSum> sums{{{1, {{0, 1}}}}};
  EXPECT_THAT(fit_priced_sums(sums, std::vector{9.0}, std::vector<Belief>{{0, 2}}, kSquares),
              ElementsAre(DoubleNear(std::log(9.0) / 3, 1e-6)));
  EXPECT_THAT(fit_priced_sums(sums, std::vector{9.0}, std::vector<Belief>{{0, 0}, {3, 1}}, kSquares),
              ElementsAre(DoubleNear(std::log(9.0), 1e-6), DoubleNear(3, 1e-6)))
      << "what no sum speaks of is what was believed";
}

/// Of 1, 1 and 8 least squares make the geometric mean 2; by lengths beyond 0.1 each draws as much as another.
TEST(PricedSums, AreNotDrawnFarByWhatIsFar) {
  const std::vector<PricedSum> sums(3, {{1, {{0, 1}}}});
  const std::vector<double> values{1, 1, 8};
  EXPECT_THAT(fit_priced_sums(sums, values, std::vector<Belief>(1), kSquares),
              ElementsAre(DoubleNear(std::log(2.0), 1e-6)));
  EXPECT_THAT(fit_priced_sums(sums, values, std::vector<Belief>(1), 0.1),
              ElementsAre(DoubleNear(0.05, 1e-3)));
}

/// A power of 2 makes the price a square; one of a half is shared by two amounts.
TEST(PricedSums, KnowPowers) {
  const std::vector<PricedSum> sums{{{3, {{0, 2}}}}, {{5, {{0, 0.5}, {1, 1}}}}};
  EXPECT_THAT(fit_priced_sums(sums, std::vector{48.0, 60.0}, std::vector<Belief>(2), kSquares),
              ElementsAre(DoubleNear(std::log(4.0), 1e-4), DoubleNear(std::log(6.0), 1e-4)));
}

}  // namespace
}  // namespace rayshoot::analysis
