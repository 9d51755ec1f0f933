// Errors of answers: rates with their bounds, gradings of the numerical suite, error against run time.
#include <gmock/gmock.h>

#include "analysis/statistics/rate.h"
#include "analysis/tables/comparison.h"
#include "analysis/tables/grading.h"
#include "analysis/tests/find_cell.h"
#include "analysis/work_precision/frontier.h"
#include "analysis/work_precision/work_precision.h"

namespace rayshoot::analysis {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Rate, FollowsTheRuleOfThreeWithoutEvents) {
  EXPECT_EQ(per_billion(0, 3'000'000'000), 0);
  EXPECT_EQ(upper_bound_per_billion(0, 3'000'000'000), 1);
  EXPECT_EQ(upper_bound_per_billion(0, 1), 1e9) << "no rate is above one";
  EXPECT_FALSE(per_billion(0, 0));
  EXPECT_FALSE(upper_bound_per_billion(0, 0));
}

/// Wilson's upper limit for 10 of 100 is 0.17437 (Newcombe 1998).
TEST(Rate, IsBoundedByWilsonsInterval) {
  EXPECT_EQ(per_billion(10, 100), 1e8);
  EXPECT_NEAR(*upper_bound_per_billion(10, 100), 0.17437e9, 1e4);
}

report::Grading grading(const std::string& technique, const std::string& setting, std::uint64_t leaks) {
  return {.torture_case = "closed_vertex",
          .setting = setting,
          .property = "always_hit",
          .technique = technique,
          .scalar = "float",
          .intersector = "watertight",
          .parameter = 0,
          .rays = 1000,
          .errors = report::Errors{100, {{"exact", 90}, {"false_miss", 10}}, report::Ulps{0.5, 2, 3, 4}},
          .leaks = leaks,
          .work = report::Work{.rays = 10, .object_tests = 50, .steps = 50}};
}

report::Report graded_report() {
  report::Report report;
  report.gradings = {grading("bvh_sah", "level=2", 1), grading("bvh_sah", "level=3", 2)};
  report.gradings[1].base = "level=2";
  report.gradings[1].work->object_tests = 250;
  report.gradings[1].errors.ulps_of_t->max = 9;
  report.gradings[1].message = "given up after 20 crashes";
  return report;
}

TEST(GradingTables, HaveARowForAllSettingsOfACase) {
  const std::vector<Table> tables = grading_tables({graded_report()}, false);
  ASSERT_EQ(tables.size(), 1u);
  ASSERT_EQ(tables[0].rows.size(), 1u);
  EXPECT_EQ(tables[0].title, "closed_vertex, always_hit");
  EXPECT_EQ(number_in_row(tables[0], 0, "rays"), 2000);
  EXPECT_EQ(number_in_row(tables[0], 0, "exact_answers"), 180);
  EXPECT_EQ(number_in_row(tables[0], 0, "false_miss_answers"), 20);
  EXPECT_EQ(number_in_row(tables[0], 0, "leaks_per_1e9"), 3e9 / 2000);
  EXPECT_EQ(number_in_row(tables[0], 0, "ulps_of_t_max"), 9) << "the worst of the settings";
  EXPECT_EQ(number_in_row(tables[0], 0, "work_over_base"), 3) << "300 units of work a ray over 100";
  EXPECT_THAT(tables[0].notes, ElementsAre("bvh_sah, watertight, level=3: given up after 20 crashes"));
}

TEST(GradingTables, HaveARowForEverySettingInCsv) {
  const std::string csv = render_comparison({graded_report()}, Format::csv);
  EXPECT_THAT(csv, HasSubstr("closed_vertex,level=2,"));
  EXPECT_THAT(csv, HasSubstr("closed_vertex,level=3,"));
}

TEST(GradingTables, ShowNoColumnOfFaultsWhereThereIsNone) {
  report::Report report = graded_report();
  for (report::Grading& one : report.gradings) one.errors.answers = {{"exact", 100}};
  EXPECT_THAT(render(grading_tables({report}, false), Format::text), Not(HasSubstr("MISS")));
  EXPECT_THAT(render(grading_tables({graded_report()}, false), Format::text), HasSubstr("MISS"));
}

/// A technique that was timed and graded.
report::Measurement point(const std::string& technique, const std::string& scalar, double ns, double ulps,
                          std::uint64_t wrong) {
  return {.scene = "s",
          .rays = "s/r",
          .technique = technique,
          .scalar = scalar,
          .query = "closest",
          .errors =
              report::Errors{
                  1000, {{"exact", 1000 - wrong}, {"false_miss", wrong}}, report::Ulps{0, 0, ulps, ulps}},
          .trace_ns = {ns * 1000}};
}

report::Report timed_report() {
  report::Report report;
  report.scenes = {{.id = "s", .objects = 1, .stiffness = 12}};
  report.ray_sets = {{.id = "s/r", .scene = "s", .rays = 1000}};
  report.measurements = {point("fastest", "float", 10, 8, 2), point("between", "float", 20, 4, 0),
                         point("beaten", "float", 30, 4, 0), point("best", "double", 40, 4, 0)};
  return report;
}

TEST(WorkPrecision, KeepsWhatNothingBeatsInTimeAndErrors) {
  const report::Report report = timed_report();
  const std::vector<Group> all = groups(report);
  const auto diagrams = work_precision_diagrams(all);
  ASSERT_EQ(diagrams.size(), 1u);
  EXPECT_EQ(diagrams[0].stiffness, 12);
  std::vector<std::string> labels, frontier;
  for (const WorkPrecision& one : diagrams[0].points) {
    labels.push_back(one.label);
    if (one.on_frontier) frontier.push_back(one.label);
  }
  EXPECT_THAT(labels, ElementsAre("fastest, float", "between, float", "beaten, float", "best, double"));
  EXPECT_THAT(frontier, ElementsAre("fastest, float", "between, float", "best, double"));
  EXPECT_EQ(diagrams[0].points[0].wrong_per_billion, 2e6);
  EXPECT_EQ(diagrams[0].points[3].float_ulps_p999, 4 * 0x1p-29) << "an ulp of a double is that much smaller";
}

TEST(WorkPrecision, LeavesOutWhatWasNotGradedOrNotTimed) {
  report::Report report = timed_report();
  report.measurements[0].errors.reset();
  report.measurements[1].trace_ns.clear();
  const std::vector<Group> all = groups(report);
  EXPECT_EQ(work_precision_diagrams(all).at(0).points.size(), 2u);
  for (report::Measurement& one : report.measurements) one.errors.reset();
  EXPECT_TRUE(work_precision_tables({report}).empty());
}

TEST(WorkPrecision, HasATableOverStiffnessForSeveralScenes) {
  report::Report report = timed_report();
  report.scenes.push_back({.id = "soft", .objects = 1, .stiffness = 3});
  report.ray_sets.push_back({.id = "soft/r", .scene = "soft", .rays = 1000});
  report.measurements.push_back(point("fastest", "float", 10, 8, 2));
  report.measurements.back().scene = "soft", report.measurements.back().rays = "soft/r";
  const std::vector<Table> tables = work_precision_tables({report});
  ASSERT_EQ(tables.size(), 3u);
  EXPECT_EQ(number_in_row(tables[2], 0, "stiffness"), 3) << "from the least stiffness on";
  EXPECT_EQ(number_in_row(tables[2], 1, "stiffness"), 12);
}

}  // namespace
}  // namespace rayshoot::analysis
