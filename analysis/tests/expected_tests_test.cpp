#include <gmock/gmock.h>

#include "analysis/cost_models/expected_tests.h"
#include "analysis/tests/find_cell.h"
#include "analysis/tests/report_by_law.h"

namespace rayshoot::analysis {
namespace {

using report::Measurement;
using report::Report;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Optional;
using ::testing::SizeIs;

/// Every model errs by what was planted.
TEST(ExpectedTests, AreHeldAgainstCountedOnes) {
  Report report = report_by_law(havrans_law);
  for (Measurement& cell : report.measurements) {
    if (rate(cell, &report::Work::volume_tests) == 0) continue;
    const report::Predicted counted{rate(cell, &report::Work::object_tests),
                                    rate(cell, &report::Work::volume_tests)};
    auto wrong = counted, close = counted;
    wrong.volume_tests_per_ray *= 2, close.object_tests_per_ray *= cell.scene == "scene3" ? 0.9 : 0.96;
    cell.predicted = wrong;
    cell.sampled_prediction = report::SampledPrediction{25, wrong, close, counted};
  }
  const std::vector<Group> all = groups(report);
  const std::vector<const CostModel*> models{&model("havran"), &model("equation_3"),
                                             &model("equation_3_occluded"), &model("equation_3_ordered")};
  const std::vector<Table> tables = tests_tables(all, models);
  ASSERT_THAT(tables, SizeIs(4)) << "verdicts, by technique as well, and the cells of two distributions";
  const auto all_rays = [](std::size_t which) { return 3 * which + 2; };
  EXPECT_EQ(cell_in_row(tables[0], all_rays(0), "distribution").text, "all");
  EXPECT_EQ(number_in_row(tables[0], all_rays(0), "cells"), 12);
  EXPECT_EQ(number_in_row(tables[0], all_rays(0), "right"), 0);
  EXPECT_NEAR(number_in_row(tables[0], all_rays(0), "max_volumes_percent"), 100, 1e-9);
  EXPECT_EQ(number_in_row(tables[0], all_rays(1), "right"), 10) << "all but those of scene3";
  EXPECT_NEAR(number_in_row(tables[0], all_rays(1), "median_objects_percent"), 4, 1e-9);
  EXPECT_NEAR(number_in_row(tables[0], all_rays(1), "max_objects_percent"), 10, 1e-9);
  EXPECT_EQ(number_in_row(tables[0], all_rays(2), "right"), 12);
  EXPECT_FALSE(cell_in_row(tables[0], all_rays(0), "right_elsewhere").number)
      << "surface areas need no sample";
  EXPECT_EQ(number_in_row(tables[0], all_rays(1), "right_elsewhere"), 10);
  EXPECT_EQ(number_in_row(tables[0], all_rays(2), "right_elsewhere"), 12);
  EXPECT_THAT(row_names(tables[1]), ElementsAre("technique0", "technique1"));
  EXPECT_EQ(number_in(tables[1], "technique1", "cells"), 6);
  EXPECT_EQ(number_in(tables[1], "technique1", "equation_3_right"), 0);
  EXPECT_EQ(number_in(tables[1], "technique1", "equation_3_occluded_right"), 5);
  EXPECT_THAT(tables[2].rows, SizeIs(6));
  EXPECT_NEAR(number_in_row(tables[2], 0, "equation_3_volume_error"), 1, 1e-9);
  EXPECT_NEAR(number_in_row(tables[2], 0, "equation_3_occluded_object_error"), -0.04, 1e-9);
  EXPECT_TRUE(tests_hold(all, {&model("equation_3_ordered")}, 0.05));
  EXPECT_FALSE(tests_hold(all, {&model("equation_3_occluded")}, 0.05));
  EXPECT_TRUE(tests_hold(all, {&model("equation_3_occluded")}, 0.11));
  EXPECT_FALSE(tests_hold(all, {&model("equation_3_by_rays"), &model("equation_3")}, 0.05));
  for (Measurement& cell : report.measurements) cell.predicted.reset(), cell.sampled_prediction.reset();
  EXPECT_THAT(tests_tables(all, models), IsEmpty());
  EXPECT_FALSE(tests_hold(all, models, 100)) << "what cannot be checked does not hold";
}

/// Sampled rays take 3 % more than all: 4 % more than the others where they are a quarter, 6 % where they are nearly half.
TEST(ExpectedTests, AreHeldAgainstRaysOutsideOfTheSample) {
  for (const std::uint64_t sampled : {25u, 49u}) {
    Report report = report_by_law(havrans_law);
    for (Measurement& cell : report.measurements) {
      const double more = 1.03;
      const report::Predicted inside{more * rate(cell, &report::Work::object_tests),
                                     more * rate(cell, &report::Work::volume_tests)};
      if (inside.volume_tests_per_ray > 0)
        cell.sampled_prediction = report::SampledPrediction{sampled, inside, inside, inside};
    }
    const std::vector<Group> all = groups(report);
    const auto cells = cells_of_tests(all, {&model("equation_3_ordered")});
    const double share = static_cast<double>(sampled) / 100;
    const double error = 1.03 * (1 - share) / (1 - 1.03 * share) - 1;
    for (const CellOfTests& cell : cells) {
      EXPECT_THAT(cell.errors_elsewhere[0], Optional(DoubleNear(error, 1e-9)));
    }
    const TestsVerdict verdict = verdict_of_tests(cells, 0, "");
    EXPECT_EQ(verdict.right, 12u);
    EXPECT_EQ(verdict.right_elsewhere, sampled == 25 ? 12u : 0u);
  }
}

}  // namespace
}  // namespace rayshoot::analysis
