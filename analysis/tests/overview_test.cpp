#include <gmock/gmock.h>

#include "analysis/tables/comparison.h"
#include "analysis/tests/find_cell.h"
#include "analysis/tests/small_report.h"

namespace rayshoot::analysis {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

/// The small report with a second scene, where bvh_sah is four times as slow, octree_glassner is right, and the coarse
/// grid failed.
report::Report two_scenes() {
  report::Report report = small_report();
  report.scenes.push_back({.id = "gears:1/curves", .objects = 60});
  report.ray_sets.push_back({.id = "gears:1/curves/chords", .scene = "gears:1/curves", .rays = 100});
  const std::vector<report::Measurement> first = report.measurements;
  for (report::Measurement m : first) {
    m.scene = "gears:1/curves", m.rays = "gears:1/curves/chords";
    if (m.technique == "bvh_sah")
      for (double& ns : m.trace_ns) ns *= 4;
    if (m.technique == "octree_glassner") m.verdict.status = report::Status::ok, m.trace_ns = {300};
    if (m.trace_ns.size() == 6 && m.technique == "uniform_grid") {
      m.verdict.status = report::Status::failed;
      m.trace_ns.clear(), m.threads.clear();
    }
    report.measurements.push_back(m);
  }
  return report;
}

TEST(Overview, HasGeometricMeansOverScenes) {
  const std::vector<Table> tables = overview_tables({two_scenes()});
  ASSERT_THAT(tables, SizeIs(1));
  const Table& table = tables[0];
  EXPECT_EQ(table.title, "All 2 scenes and rays, float");
  EXPECT_DOUBLE_EQ(number_in(table, "bvh_sah", "trace_ns_per_ray"), 180);
  EXPECT_DOUBLE_EQ(number_in(table, "bvh_sah", "times_zero_overhead"), 32);
  EXPECT_DOUBLE_EQ(number_in(table, "bvh_sah", "times_embree"), 0.25);
  EXPECT_DOUBLE_EQ(number_in(table, "bvh_sah", "object_tests_per_ray"), 3);
  EXPECT_DOUBLE_EQ(number_in(table, "bvh_sah", "cells"), 2);
}

TEST(Overview, LeavesOutWrongAndFailedCellsAndSortsByWhatIsLeft) {
  const Table table = overview_tables({two_scenes()}).at(0);
  EXPECT_THAT(row_names(table),
              ElementsAre("zero_overhead", "embree", "uniform_grid(density=8)", "bvh_sah", "octree_glassner",
                          "uniform_grid(density=1)", "bvh_goldsmith_salmon"));
  EXPECT_DOUBLE_EQ(number_in(table, "octree_glassner", "cells"), 1);
  EXPECT_DOUBLE_EQ(number_in(table, "octree_glassner", "trace_ns_per_ray"), 3);
  EXPECT_DOUBLE_EQ(number_in(table, "uniform_grid(density=1)", "cells"), 1);
  EXPECT_DOUBLE_EQ(number_in(table, "bvh_goldsmith_salmon", "cells"), 0);
  EXPECT_FALSE(find_cell(table, "bvh_goldsmith_salmon", "trace_ns_per_ray").number);
}

TEST(Overview, IsForSeveralGroupsOfOnePrecision) {
  EXPECT_THAT(overview_tables({small_report()}), IsEmpty());
  report::Report report = small_report();
  for (report::Measurement m : small_report().measurements) {
    m.scalar = "double";
    report.measurements.push_back(m);
    m.intersector = "watertight";
    report.measurements.push_back(m);
  }
  EXPECT_THAT(overview_tables({report}), IsEmpty());
}

TEST(Overview, OfSeveralReportsAreNamedByTheirRuns) {
  const std::vector<Table> tables = overview_tables({two_scenes(), small_report(), two_scenes()});
  ASSERT_THAT(tables, SizeIs(2));
  EXPECT_THAT(tables[0].title, HasSubstr("[run-1] All 2 scenes"));
}

TEST(Scaling, DividesTheTimesOfRepetitions) {
  report::Report report = small_report();
  for (report::Measurement& m : report.measurements)
    if (m.technique == "bvh_sah") m.threads = {{1, m.trace_ns}, {4, {2000, 2100, 2200, 2400, 2300, 2500}}};
  const std::vector<Table> tables = scaling_tables({report});
  ASSERT_THAT(tables, SizeIs(1));
  EXPECT_EQ(tables[0].title, "balls:2/curves, whitted@9, float: times faster with more threads than with 1");
  EXPECT_THAT(row_names(tables[0]), ElementsAre("bvh_sah", "uniform_grid(density=1)"));
  EXPECT_DOUBLE_EQ(number_in(tables[0], "bvh_sah", "speed_up_1_threads"), 1);
  EXPECT_DOUBLE_EQ(number_in(tables[0], "bvh_sah", "speed_up_4_threads"), 4);
  EXPECT_FALSE(find_cell(tables[0], "bvh_sah", "speed_up_2_threads").number);
  EXPECT_DOUBLE_EQ(number_in(tables[0], "uniform_grid(density=1)", "speed_up_2_threads"), 2);
}

TEST(Scaling, NeedsThreadScalingInTheReport) {
  report::Report report = small_report();
  for (report::Measurement& m : report.measurements) m.threads.clear();
  EXPECT_THAT(scaling_tables({report}), IsEmpty());
}

TEST(RenderComparison, HasAllTablesForReadersAndTheComparisonAloneForPrograms) {
  const std::vector<report::Report> reports{two_scenes()};
  for (const Format format : {Format::text, Format::markdown, Format::latex}) {
    const std::string all = render_comparison(reports, format);
    EXPECT_THAT(all, HasSubstr("100 rays"));
    EXPECT_THAT(all, HasSubstr("All 2 scenes and rays"));
    EXPECT_THAT(all, HasSubstr("more threads"));
  }
  const std::string csv = render_comparison(reports, Format::csv);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 14);
  EXPECT_THAT(csv, Not(HasSubstr("speed_up")));
}

}  // namespace
}  // namespace rayshoot::analysis
