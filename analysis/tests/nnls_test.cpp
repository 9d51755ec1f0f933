#include "analysis/statistics/nnls.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace rayshoot::analysis {
namespace {

using Rows = std::vector<std::vector<double>>;
using Values = std::vector<double>;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::SizeIs;

/// Signs free, the normal equations of (1, 1), (1, 2), (1, 3) and 1, 2, 4 give -2/3 and 3/2; with the first one held at
/// 0 the second is 17/14, and what is left over has the square 21 - 17^2 / 14 = 5/14.
TEST(NonNegativeLeastSquares, HoldsAtZeroWhatWouldBeNegative) {
  const auto fit = non_negative_least_squares(Rows{{1, 1}, {1, 2}, {1, 3}}, Values{1, 2, 4});
  EXPECT_EQ(fit->coefficients[0], 0);
  EXPECT_NEAR(fit->coefficients[1], 17.0 / 14, 1e-12);
  EXPECT_NEAR(fit->residual, std::sqrt(5.0 / 14), 1e-12);
}

TEST(NonNegativeLeastSquares, FindsTheLineThatIsThere) {
  const auto fit = non_negative_least_squares(Rows{{1, 10, 3}, {1, 20, 1}, {1, 5, 9}, {1, 40, 2}},
                                              Values{35.5, 57.5, 32, 109});
  EXPECT_THAT(fit->coefficients,
              ElementsAre(DoubleNear(6, 1e-9), DoubleNear(2.5, 1e-9), DoubleNear(1.5, 1e-9)));
}

/// Columns a million times larger or smaller than each other.
TEST(NonNegativeLeastSquares, DoesNotMindUnits) {
  const auto fit = non_negative_least_squares(Rows{{1e-6, 1e6}, {2e-6, 1e6}, {3e-6, 5e6}}, Values{3, 5, 11});
  ASSERT_TRUE(fit);
  const auto same = non_negative_least_squares(Rows{{1, 1}, {2, 1}, {3, 5}}, Values{3, 5, 11});
  EXPECT_NEAR(fit->coefficients[0] * 1e-6, same->coefficients[0], 1e-9);
  EXPECT_NEAR(fit->coefficients[1] * 1e6, same->coefficients[1], 1e-9);
}

TEST(NonNegativeLeastSquares, LeavesOutWhatOthersMakeUp) {
  const auto fit = non_negative_least_squares(Rows{{1, 2, 0}, {2, 4, 0}, {3, 6, 0}}, Values{2, 4, 6});
  EXPECT_EQ(fit->coefficients[2], 0);
  EXPECT_NEAR(fit->coefficients[0] + 2 * fit->coefficients[1], 2, 1e-9);
  EXPECT_NEAR(fit->residual, 0, 1e-9);
  EXPECT_THAT(non_negative_least_squares(Rows{{1}, {2}}, Values{-1, -2})->coefficients, ElementsAre(0));
}

TEST(NonNegativeLeastSquares, NeedsNumbersInRowsOfOneLength) {
  EXPECT_FALSE(non_negative_least_squares(Rows{}, Values{}));
  EXPECT_FALSE(non_negative_least_squares(Rows{{1}, {1, 2}}, Values{1, 2}));
  EXPECT_FALSE(non_negative_least_squares(Rows{{1}, {2}}, Values{1}));
  EXPECT_FALSE(non_negative_least_squares(Rows{{std::numeric_limits<double>::quiet_NaN()}}, Values{1}));
  EXPECT_FALSE(non_negative_least_squares(Rows{{1}}, Values{std::numeric_limits<double>::infinity()}));
}

/// The conditions of Kuhn and Tucker, which the best coefficients fulfil and no others: the gradient is 0 where
/// a coefficient is positive, and none of those at 0 would lessen the error.
TEST(NonNegativeLeastSquares, FulfilsTheConditionsOfTheOptimum) {
  std::mt19937_64 generator(1);
  std::normal_distribution<double> normal;
  std::size_t zeros = 0, positive = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const std::size_t columns = 1 + static_cast<std::size_t>(trial) % 7;
    Rows rows(12, Values(columns));
    Values values(12);
    for (auto& row : rows)
      for (double& entry : row) entry = normal(generator);
    for (double& value : values) value = normal(generator);
    const auto fit = non_negative_least_squares(rows, values);
    ASSERT_THAT(fit->coefficients, SizeIs(columns));
    for (std::size_t j = 0; j < columns; ++j) {
      double gradient = 0;
      for (std::size_t i = 0; i < rows.size(); ++i)
        gradient += rows[i][j] * (values[i] - std::inner_product(rows[i].begin(), rows[i].end(),
                                                                 fit->coefficients.begin(), 0.0));
      if (fit->coefficients[j] > 0) {
        ++positive;
        EXPECT_NEAR(gradient, 0, 1e-9);
      } else {
        ++zeros;
        EXPECT_EQ(fit->coefficients[j], 0);
        EXPECT_LT(gradient, 1e-9);
      }
    }
  }
  EXPECT_GT(zeros, 300u);
  EXPECT_GT(positive, 300u);
}

}  // namespace
}  // namespace rayshoot::analysis
