// Whole tables: corrections, outliers, orders, and laws through many points.
#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <vector>

#include "analysis/statistics/multiple.h"
#include "analysis/statistics/outliers.h"
#include "analysis/statistics/power_law.h"
#include "analysis/statistics/rank_correlation.h"

namespace rayshoot::analysis {
namespace {

using Values = std::vector<double>;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// 4 * 0.01, 3 * 0.02, 2 * 0.03 is less than what came before and so as much, 1 * 0.5.
TEST(Holm, MultipliesByWhatIsLeftAndNeverFalls) {
  EXPECT_THAT(holm(Values{0.5, 0.01, 0.03, 0.02}),
              ElementsAre(DoubleNear(0.5, 1e-12), DoubleNear(0.04, 1e-12), DoubleNear(0.06, 1e-12),
                          DoubleNear(0.06, 1e-12)));
  EXPECT_THAT(holm(Values{0.6, 0.7}), ElementsAre(1, 1));
  EXPECT_THAT(holm(Values{}), IsEmpty());
}

/// 0.01 * 4 / 1, 0.02 * 4 / 2, 0.03 * 4 / 3, all 0.04, and 0.5.
TEST(BenjaminiHochberg, MultipliesByTheNumberOverTheRank) {
  EXPECT_THAT(benjamini_hochberg(Values{0.5, 0.01, 0.03, 0.02}),
              ElementsAre(DoubleNear(0.5, 1e-12), DoubleNear(0.04, 1e-12), DoubleNear(0.04, 1e-12),
                          DoubleNear(0.04, 1e-12)));
  EXPECT_THAT(benjamini_hochberg(Values{0.010, 0.011}),
              ElementsAre(DoubleNear(0.011, 1e-12), DoubleNear(0.011, 1e-12)));
  EXPECT_THAT(benjamini_hochberg(Values{}), IsEmpty());
}

/// A hundred chances, all by chance: Holm refuses one of them, or more, in 5 % of tables.
TEST(Holm, ErrsInATableAsOftenAsItSays) {
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> uniform;
  int tables = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    Values chances(100);
    for (double& chance : chances) chance = uniform(generator);
    const Values adjusted = holm(chances);
    tables += *std::min_element(adjusted.begin(), adjusted.end()) <= 0.05;
  }
  EXPECT_NEAR(tables / 4000.0, 0.049, 0.01);
}

/// 80 chances by chance and 20 that are nearly 0: of what is refused 5 % of 80/100 are in error on average.
TEST(BenjaminiHochberg, ErrsInSuchAPartOfWhatItRefuses) {
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> uniform;
  double share = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    Values chances(100, 1e-9);
    for (std::size_t i = 20; i < 100; ++i) chances[i] = uniform(generator);
    const Values adjusted = benjamini_hochberg(chances);
    const auto wrong =
        std::count_if(adjusted.begin() + 20, adjusted.end(), [](double p) { return p <= 0.05; });
    share += static_cast<double>(wrong) / static_cast<double>(20 + wrong) / 2000;
  }
  EXPECT_NEAR(share, 0.04, 0.005);
}

/// Distances from the median 5 are 4, 3, ..., 4: their median is 2, and ten deviations are 29.65.
TEST(Outliers, LieTenDeviationsFromTheMedian) {
  EXPECT_THAT(outliers(Values{1, 2, 3, 4, 5, 6, 7, 8, 34.6}), IsEmpty());
  EXPECT_THAT(outliers(Values{1, 2, 3, 4, 5, 6, 7, 8, 34.7}), ElementsAre(8));
  EXPECT_THAT(outliers(Values{-100, 2, 3, 4, 5, 6, 7, 8, 99}), ElementsAre(0, 8));
  EXPECT_THAT(outliers(Values{1, 1, 1, 1, 2}), IsEmpty());
  EXPECT_THAT(outliers(Values{}), IsEmpty());
}

/// Squared differences of ranks 1 + 1 + 1 + 1: rho = 1 - 6 * 4 / (5 * 24). Two of ten pairs are in opposite order.
TEST(RankCorrelation, HasTheValuesOfTheTextbooks) {
  const Values a{10, 20, 30, 40, 50}, b{2, 1, 4, 3, 9};
  EXPECT_NEAR(*spearman(a, b), 0.8, 1e-12);
  EXPECT_NEAR(*kendall(a, b), 0.6, 1e-12);
  EXPECT_NEAR(*spearman(a, Values{5, 4, 3, 2, 1}), -1, 1e-12);
  EXPECT_NEAR(*kendall(a, Values{5, 4, 3, 2, 1}), -1, 1e-12);
}

/// Ranks 1, 2.5, 2.5, 4 against 1, 2, 3, 4: 4.5 / sqrt(4.5 * 5); five of the six pairs are untied, in the same order.
TEST(RankCorrelation, SharesTheRanksOfEqualValues) {
  const Values tied{1, 2, 2, 3}, b{1, 2, 3, 4};
  EXPECT_NEAR(*spearman(tied, b), 4.5 / std::sqrt(4.5 * 5), 1e-12);
  EXPECT_NEAR(*kendall(tied, b), 5 / std::sqrt(5.0 * 6), 1e-12);
  EXPECT_NEAR(*kendall(b, tied), 5 / std::sqrt(5.0 * 6), 1e-12);
  EXPECT_FALSE(spearman(Values{1, 1}, Values{1, 2}));
  EXPECT_FALSE(kendall(Values{1, 1}, Values{1, 2}));
  EXPECT_FALSE(spearman(Values{1}, Values{1}));
  EXPECT_FALSE(kendall(Values{1, 2}, Values{1}));
}

TEST(PowerLaw, FindsTheExponentThatIsThere) {
  const auto law = fit_power_law(Values{1, 10, 100}, Values{3, 3 * std::sqrt(10), 30});
  EXPECT_NEAR(law->factor, 3, 1e-9);
  EXPECT_NEAR(law->exponent.value, 0.5, 1e-9);
  EXPECT_NEAR(law->exponent.interval->high, 0.5, 1e-6);
  EXPECT_NEAR((*law)(10000), 300, 1e-6);
}

/// Logarithms to base e of y: 0, 2, 1 at x = 0, 1, 2: slope 1/2, deviations -1/2, 1, -1/2 with the squares 3/2, one
/// degree of freedom, t = 12.7062, half width 12.7062 sqrt(3/2 / 2).
TEST(PowerLaw, HasStudentsInterval) {
  const double e = std::exp(1);
  const auto law = fit_power_law(Values{1, e, e * e}, Values{1, e * e, e});
  EXPECT_NEAR(law->exponent.value, 0.5, 1e-12);
  EXPECT_NEAR(law->exponent.interval->high - 0.5, 12.7062 * std::sqrt(0.75), 1e-4);
  EXPECT_FALSE(fit_power_law(Values{1, 2}, Values{1, 2})->exponent.interval);
}

TEST(PowerLaw, NeedsDifferentPositiveValues) {
  EXPECT_FALSE(fit_power_law(Values{1}, Values{1}));
  EXPECT_FALSE(fit_power_law(Values{2, 2}, Values{1, 3}));
  EXPECT_FALSE(fit_power_law(Values{1, 2}, Values{0, 3}));
  EXPECT_FALSE(fit_power_law(Values{1, 2}, Values{1}));
}

}  // namespace
}  // namespace rayshoot::analysis
