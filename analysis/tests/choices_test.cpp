#include <gmock/gmock.h>

#include "analysis/tables/comparison.h"
#include "analysis/tables/regret.h"
#include "analysis/tests/find_cell.h"
#include "analysis/tests/small_report.h"

namespace rayshoot::analysis {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

/// The small report, in which bvh_sah takes 90 ns a ray, the fine grid 120 and the coarse one 225, with a choice for its rays.
report::Report report_with_choice(const std::string& pick) {
  report::Report report = small_report();
  const auto candidate = [](const std::string& spec, const std::string& technique) {
    return report::Candidate{
        .spec = spec, .technique = technique, .build_ns = 1e6, .predicted_ns_per_ray = 100};
  };
  report::Choice choice{.scene = "balls:2/curves",
                        .rays = "balls:2/curves/whitted@9",
                        .scalar = "float",
                        .statistics = {{"objects", 50}},
                        .left_out = {{"hug", "it is even"}, {"grid_1d", "it is even"}},
                        .constants = "a machine",
                        .predicted = "uniform_grid",
                        .pick = pick,
                        .why = "it is so"};
  choice.candidates = {candidate("uniform_grid", "uniform_grid"), candidate("bvh_sah", "bvh_sah")};
  choice.candidates[0].config = report.measurements[1].config;
  choice.candidates[1].race_ns_per_ray = {89, 91, 90};
  report.choices = {choice};
  return report;
}

double regret_of(const report::Report& report) {
  const std::vector<report::Report> reports{report};
  return judged_choices(reports).at(0).regret(report.choices[0].pick).value_or(0);
}

TEST(Regret, IsTheCostOfTheChoiceOverTheLeastThatWasMeasured) {
  EXPECT_DOUBLE_EQ(regret_of(report_with_choice("bvh_sah")), 1);
  EXPECT_DOUBLE_EQ(regret_of(report_with_choice("uniform_grid")), 225.0 / 90);
}

TEST(Regret, SeesWhatWasLeftOutButNoBaseline) {
  report::Report report = report_with_choice("bvh_sah");
  report.choices[0].candidates.pop_back();
  report.choices[0].pick = "uniform_grid";
  const std::vector<report::Report> reports{report};
  const JudgedChoice judged = judged_choices(reports).at(0);
  EXPECT_EQ(judged.best(), "bvh_sah");
  EXPECT_DOUBLE_EQ(*judged.regret("uniform_grid"), 2.5);
  EXPECT_FALSE(judged.cost("embree") || judged.cost("zero_overhead"));
}

TEST(Regret, TellsConfigurationsApart) {
  const std::vector<report::Report> reports{report_with_choice("uniform_grid")};
  const JudgedChoice judged = judged_choices(reports).at(0);
  EXPECT_EQ(judged.cost("uniform_grid"), 225);
  EXPECT_EQ(judged.cost("uniform_grid(density=8)"), 120);
}

TEST(Regret, HasItsShareOfTheBuild) {
  report::Report report = report_with_choice("bvh_sah");
  report.choices[0].expected_rays = 1000;  // builds take 123456 ns and 3 ms
  const std::vector<report::Report> reports{report};
  const JudgedChoice judged = judged_choices(reports).at(0);
  EXPECT_DOUBLE_EQ(*judged.cost("bvh_sah"), 90 + 123.456);
  EXPECT_DOUBLE_EQ(*judged.cost("uniform_grid"), 225 + 3000);
}

TEST(Regret, IsUnknownWhereACandidateWasNotMeasured) {
  report::Report report = report_with_choice("bvh_sah");
  report.choices[0].candidates.push_back({.spec = "hug", .technique = "hug"});
  EXPECT_EQ(regret_of(report), 0);
}

TEST(Choices, AreExplained) {
  const std::vector<Table> tables = choice_tables({report_with_choice("uniform_grid")});
  ASSERT_THAT(tables, SizeIs(1)) << "one choice is no statistics";
  EXPECT_THAT(row_names(tables[0]), ElementsAre("uniform_grid", "bvh_sah"));
  EXPECT_EQ(number_in(tables[0], "bvh_sah", "race_ns_per_ray"), 90);
  EXPECT_EQ(number_in(tables[0], "bvh_sah", "measured_ns_per_ray"), 90);
  EXPECT_EQ(number_in(tables[0], "uniform_grid", "expected_ns_per_ray"), 100);
  EXPECT_THAT(tables[0].notes, Contains("Left out hug, grid_1d: it is even"));
  EXPECT_THAT(tables[0].notes,
              Contains("Chosen: uniform_grid. it is so. Measured, it costs 2.50 times the least, "
                       "which is that of bvh_sah."));
}

TEST(Choices, SayWhatABuildAdds) {
  report::Report report = report_with_choice("bvh_sah");
  EXPECT_FALSE(find_cell(choice_tables({report})[0], "bvh_sah", "expected_cost_ns_per_ray").number);
  report.choices[0].expected_rays = 10'000;  // builds took 1 ms
  EXPECT_EQ(number_in(choice_tables({report})[0], "bvh_sah", "expected_cost_ns_per_ray"), 200);
}

TEST(Choices, AreCountedOverReports) {
  report::Report good = report_with_choice("bvh_sah"), bad = report_with_choice("uniform_grid");
  good.choices[0].fitted = true;
  const std::vector<Table> tables = choice_tables({good, bad});
  ASSERT_THAT(tables, SizeIs(3));
  const Table& table = tables[2];
  ASSERT_THAT(table.rows, SizeIs(2));
  EXPECT_DOUBLE_EQ(number_in_row(table, 0, "regret"), 1);
  EXPECT_DOUBLE_EQ(number_in_row(table, 1, "regret"), 2.5);
  EXPECT_DOUBLE_EQ(number_in_row(table, 0, "predicted_regret"), 2.5);
  EXPECT_THAT(table.notes,
              Contains("Chosen: 1 of 2 within 1.3 times the least; geometric mean 1.58, worst 2.50."));
  EXPECT_THAT(table.notes,
              Contains("Chosen, other scenes: 0 of 1 within 1.3 times the least; geometric mean 2.50, "
                       "worst 2.50."));
  EXPECT_THAT(table.notes,
              Contains(HasSubstr("The best fixed choice would have been bvh_sah, whose geometric mean is "
                                 "1.00")));
}

TEST(Choices, CostNothingThatWasNotMeasured) {
  EXPECT_THAT(render_regret({report_with_choice("bvh_sah")}, Format::text), HasSubstr("bvh_sah"));
  EXPECT_EQ(render_regret({small_report()}, Format::text), "");
}

}  // namespace
}  // namespace rayshoot::analysis
