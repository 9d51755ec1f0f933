#include "analysis/tables/pivot.h"

#include <gmock/gmock.h>

#include "analysis/tests/find_cell.h"
#include "analysis/tests/small_report.h"

namespace rayshoot::analysis {
namespace {

using report::Report;
using report::ReportError;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::ThrowsMessage;

/// The small report, and its scene in another size, on which all is twice as slow.
Report two_scenes() {
  Report report = small_report();
  report.scenes.push_back(report.scenes[0]);
  report.scenes[1].id = "balls:3/curves";
  report.ray_sets.push_back(report.ray_sets[0]);
  report.ray_sets[2].id = "balls:3/curves/whitted@9";
  for (report::Measurement cell : std::vector(report.measurements)) {
    cell.scene = "balls:3/curves", cell.rays = "balls:3/curves/whitted@9";
    for (double& time : cell.trace_ns) time *= 2;
    report.measurements.push_back(std::move(cell));
  }
  return report;
}

std::vector<std::string> column_keys(const Table& table) {
  std::vector<std::string> keys;
  for (const Column& column : table.columns) keys.push_back(column.key);
  return keys;
}

TEST(Pivot, PutsMetricsIntoColumnsAndEverythingElseIntoTables) {
  const auto tables = pivot_tables({two_scenes()}, {.metrics = {"m", "trace_ns_per_ray"}});
  ASSERT_THAT(tables, SizeIs(2));
  EXPECT_EQ(tables[0].title, "balls:2/curves, whitted@9, float");
  EXPECT_EQ(tables[1].title, "balls:3/curves, whitted@9, float");
  EXPECT_THAT(column_keys(tables[0]),
              ElementsAre("technique", "scene", "rays", "precision", "m", "trace_ns_per_ray"));
  EXPECT_EQ(number_in(tables[0], "bvh_sah", "m"), 0.06);
  EXPECT_EQ(number_in(tables[0], "bvh_sah", "trace_ns_per_ray"), 90);
  EXPECT_EQ(number_in(tables[1], "bvh_sah", "trace_ns_per_ray"), 180);
  EXPECT_EQ(find_cell(tables[0], "octree_glassner", "trace_ns_per_ray").text, "WRONG");
}

TEST(Pivot, PutsScenesIntoColumns) {
  const auto tables = pivot_tables({two_scenes()}, {.columns = {"scene"}});
  ASSERT_THAT(tables, SizeIs(1));
  EXPECT_EQ(tables[0].title, "whitted@9, float, time");
  EXPECT_EQ(number_in(tables[0], "bvh_sah", "balls:2/curves"), 90);
  EXPECT_EQ(number_in(tables[0], "bvh_sah", "balls:3/curves"), 180);
  EXPECT_EQ(tables[0].columns.back().unit, "ns/ray");
}

TEST(Pivot, HasATableForEveryMetricThatStandsNowhere) {
  const auto tables =
      pivot_tables({two_scenes()},
                   {.metrics = {"trace_ns_per_ray", "nodes"}, .rows = {"scene"}, .columns = {"technique"}});
  ASSERT_THAT(tables, SizeIs(2));
  EXPECT_EQ(number_in(tables[0], "balls:3/curves", "bvh_sah"), 180);
  EXPECT_EQ(tables[1].title, "whitted@9, float, nodes");
  EXPECT_EQ(number_in(tables[1], "balls:3/curves", "bvh_sah"), 99);
}

TEST(Pivot, CombinesDimensions) {
  const auto tables = pivot_tables(
      {two_scenes()},
      {.metrics = {"m", "nodes"}, .rows = {"scene", "technique"}, .columns = {"precision", "metric"}});
  ASSERT_THAT(tables, SizeIs(1));
  EXPECT_THAT(column_keys(tables[0]), ElementsAre("scene", "technique", "rays", "float m", "float nodes"));
  EXPECT_THAT(tables[0].rows, SizeIs(14));
}

/// sqrt(90 * 180); a technique that misses a cell has no mean and stands behind.
TEST(Pivot, TakesGeometricMeansOfRowsThatMissNothing) {
  Report report = two_scenes();
  report.measurements.back().trace_ns.clear();
  const auto table = pivot_tables({report}, {.columns = {"scene"}, .mean = true}).at(0);
  EXPECT_NEAR(number_in(table, "bvh_sah", "geometric_mean"), 127.279, 1e-3);
  EXPECT_FALSE(find_cell(table, "uniform_grid(density=8)", "geometric_mean").number);
  const auto names = row_names(table);
  EXPECT_THAT(std::vector(names.begin(), names.begin() + 4),
              ElementsAre("zero_overhead", "embree", "bvh_sah", "uniform_grid(density=1)"));
  EXPECT_THAT([] { pivot_tables({small_report()}, {.mean = true}); },
              ThrowsMessage<ReportError>(HasSubstr("metrics have no mean")));
}

TEST(Pivot, SortsByMeansTheBestFirst) {
  Report report = two_scenes();
  report.measurements.back().trace_ns.clear();
  const auto table =
      pivot_tables({report}, {.metrics = {"times_embree"}, .columns = {"scene"}, .mean = true}).at(0);
  const auto names = row_names(table);
  EXPECT_THAT(std::vector(names.begin(), names.begin() + 4),
              ElementsAre("zero_overhead", "embree", "bvh_sah", "uniform_grid(density=1)"));
  EXPECT_FALSE(table.rows.back().back().number) << "what has no mean stands behind";
}

TEST(Pivot, ShowsOnlyWhatMatches) {
  const auto names = [](std::vector<std::string> patterns) {
    return row_names(
        pivot_tables({small_report()},
                     {.metrics = {"m"}, .only = {{"technique", std::move(patterns)}, {"scene", {}}}})
            .at(0));
  };
  EXPECT_THAT(names({"bvh_s*"}), ElementsAre("bvh_sah"));
  EXPECT_THAT(names({"bvh_s?h", "embree"}), ElementsAre("embree", "bvh_sah"));
  EXPECT_THAT([&] { names({"bhv_*"}); },
              ThrowsMessage<ReportError>(
                  AllOf(HasSubstr("nothing matches; technique is one of"), HasSubstr("bvh_sah"))));
}

TEST(Pivot, RefusesTwoCellsInOnePlaceAndADimensionTwice) {
  EXPECT_THAT(
      [] {
        pivot_tables({small_report(), small_report()}, {});
      },
      ThrowsMessage<ReportError>(HasSubstr("give every report once")));
  EXPECT_THAT([] { pivot_tables({small_report()}, {.columns = {"technique"}}); },
              ThrowsMessage<ReportError>(HasSubstr("'technique' can stand in one place only")));
  EXPECT_THAT([] { pivot_tables({Report{}}, {}); }, ThrowsMessage<ReportError>(HasSubstr("nothing to show")));
}

/// In CSV every row says all of where it stands.
TEST(Pivot, IsCompleteInCsv) {
  const auto tables = pivot_tables({two_scenes()}, {.metrics = {"m"}, .only = {{"technique", {"bvh_sah"}}}});
  EXPECT_EQ(render(tables, Format::csv),
            "technique,scene,rays,precision,m\nbvh_sah,balls:2/curves,whitted@9,float,0.06\n"
            "bvh_sah,balls:3/curves,whitted@9,float,0.06\n");
}

TEST(Pivot, HasEveryMetric) {
  for (const std::string& metric : metric_keys())
    EXPECT_THAT(pivot_tables({small_report()}, {.metrics = {metric}}).at(0).columns, SizeIs(5)) << metric;
}

}  // namespace
}  // namespace rayshoot::analysis
