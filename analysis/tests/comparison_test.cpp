#include "analysis/tables/comparison.h"

#include <gmock/gmock.h>

#include "analysis/tests/find_cell.h"
#include "analysis/tests/small_report.h"

namespace rayshoot::analysis {
namespace {

using report::Status;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

/// The table of the measured cells of a report like the small one.
Table measured(const report::Report& report) { return comparison_tables({report}).at(0); }

report::Measurement& measurement(report::Report& report, const std::string& technique) {
  return *std::find_if(report.measurements.begin(), report.measurements.end(),
                       [&](const auto& m) { return m.technique == technique; });
}

TEST(Comparison, SortsByTimeAndPutsWrongAndFailedLast) {
  EXPECT_THAT(row_names(measured(small_report())),
              ElementsAre("zero_overhead", "embree*", "bvh_sah", "uniform_grid(density=8)",
                          "uniform_grid(density=1)", "octree_glassner", "bvh_goldsmith_salmon"));
}

TEST(Comparison, SortsByTestsWhereNothingIsTimed) {
  report::Report report = small_report();
  for (report::Measurement& m : report.measurements) m.trace_ns.clear();
  EXPECT_THAT(row_names(measured(report)),
              ElementsAre("zero_overhead", "bvh_sah", "uniform_grid(density=8)", "uniform_grid(density=1)",
                          "embree*", "octree_glassner", "bvh_goldsmith_salmon"));
}

/// Medians: 5.625 ns a ray of zero_overhead, 45 of embree, 90 of bvh_sah.
TEST(Comparison, RatiosAreThoseToTheBaselines) {
  const Table table = measured(small_report());
  EXPECT_DOUBLE_EQ(number_in(table, "bvh_sah", "trace_ns_per_ray"), 90);
  EXPECT_DOUBLE_EQ(number_in(table, "bvh_sah", "times_zero_overhead"), 16);
  EXPECT_DOUBLE_EQ(number_in(table, "bvh_sah", "times_embree"), 0.5);
  EXPECT_DOUBLE_EQ(number_in(table, "zero_overhead", "times_zero_overhead"), 1);
  EXPECT_DOUBLE_EQ(number_in(table, "zero_overhead", "times_embree"), 8);
  EXPECT_DOUBLE_EQ(number_in(table, "embree*", "times_embree"), 1);
}

TEST(Comparison, RatiosAreOfPairedRepetitions) {
  report::Report report = small_report();
  measurement(report, "bvh_sah").trace_ns = {4000, 8400, 8800, 9600, 9200, 50000};
  const Table table = measured(report);
  EXPECT_DOUBLE_EQ(number_in(table, "bvh_sah", "times_embree"), 0.5);
  EXPECT_DOUBLE_EQ(number_in(table, "bvh_sah", "times_embree_low"), 0.1);
  EXPECT_DOUBLE_EQ(number_in(table, "bvh_sah", "times_embree_high"), 1);
}

TEST(Comparison, HasNoRatioToABaselineThatIsMissingOrNotTimed) {
  report::Report report = small_report();
  measurement(report, "embree").trace_ns.clear();
  std::erase_if(report.measurements, [](const auto& m) { return m.technique == kZeroOverhead; });
  const Table table = measured(report);
  EXPECT_FALSE(find_cell(table, "bvh_sah", "times_zero_overhead").number);
  EXPECT_FALSE(find_cell(table, "bvh_sah", "times_embree").number);
  EXPECT_TRUE(find_cell(table, "bvh_sah", "trace_ns_per_ray").number);
}

TEST(Comparison, ComparesWithAnEmbreeThatTracesRayByRay) {
  report::Report report = small_report();
  measurement(report, "embree").config = {{"mode", "single"}};
  report::Measurement packet = measurement(report, "embree");
  packet.config = {{"mode", "packet"}};
  for (double& ns : packet.trace_ns) ns /= 2;
  report.measurements.push_back(packet);
  Table table = measured(report);
  EXPECT_DOUBLE_EQ(number_in(table, "bvh_sah", "times_embree"), 0.5);
  EXPECT_DOUBLE_EQ(number_in(table, "embree(mode=packet)*", "times_embree"), 2);
  EXPECT_THAT(table.notes,
              Contains("Compared with embree(mode=single), the fastest of those that trace ray by ray."));
  // Where there is none, the fastest of the others.
  measurement(report, "embree").config = {{"mode", "stream"}};
  table = measured(report);
  EXPECT_DOUBLE_EQ(number_in(table, "bvh_sah", "times_embree"), 0.25);
  EXPECT_THAT(table.notes, Contains("Compared with embree(mode=packet), the fastest of 2."));
}

TEST(Comparison, SaysWhereEmbreeWasBuiltWithAssertions) {
  const auto says_so = Contains(HasSubstr("built with assertions"));
  report::Report report = small_report();
  EXPECT_THAT(comparison_tables({report}).back().notes, Not(says_so));
  report.environment.packages["embree_assertions"] = "off";
  EXPECT_THAT(comparison_tables({report}).back().notes, Not(says_so));
  report.environment.packages["embree_assertions"] = "on";
  EXPECT_THAT(comparison_tables({report}).back().notes, says_so);
  std::erase_if(report.measurements, [](const auto& m) { return m.technique == kEmbree; });
  EXPECT_THAT(comparison_tables({report}).back().notes, Not(says_so)) << "nothing is compared with it";
}

TEST(Comparison, ComparesWithTheFastestOfSeveralBaselinesAndSaysSo) {
  report::Report report = small_report();
  measurement(report, "embree").config = {{"robust", true}};
  report::Measurement fast = measurement(report, "embree");
  fast.config = {{"robust", false}};
  for (double& ns : fast.trace_ns) ns /= 2;
  report::Measurement untimed = fast;
  untimed.trace_ns.clear();
  report.measurements.insert(report.measurements.end(), {fast, untimed});
  const Table table = measured(report);
  EXPECT_DOUBLE_EQ(number_in(table, "bvh_sah", "times_embree"), 0.25);
  EXPECT_THAT(table.notes, Contains("Compared with embree(robust=off), the fastest of 2."));
}

TEST(Comparison, AWrongAnswerStandsInPlaceOfATime) {
  const Table table = measured(small_report());
  const Cell time = find_cell(table, "octree_glassner", "trace_ns_per_ray");
  EXPECT_EQ(time.text, "WRONG");
  EXPECT_FALSE(time.number);
  EXPECT_FALSE(find_cell(table, "octree_glassner", "times_zero_overhead").number);
  EXPECT_THAT(table.notes,
              Contains("WRONG octree_glassner: 12 of 100 checked rays (12.0 %) differ from exhaustive."));
}

TEST(Comparison, AFailureStandsInPlaceOfATime) {
  const Table table = measured(small_report());
  EXPECT_EQ(find_cell(table, "bvh_goldsmith_salmon", "trace_ns_per_ray").text, "FAILED");
  EXPECT_THAT(table.notes, Contains("FAILED bvh_goldsmith_salmon: out of memory"));
}

TEST(Comparison, AGradedEngineHasAFootnoteAndATime) {
  const Table table = measured(small_report());
  EXPECT_DOUBLE_EQ(number_in(table, "embree*", "trace_ns_per_ray"), 45);
  EXPECT_THAT(table.notes,
              Contains("* embree has an object test of its own: 1 of 100 checked rays (1.00 %) differ from "
                       "exhaustive."));
}

TEST(Comparison, RightTechniquesHaveNoNote) {
  EXPECT_THAT(measured(small_report()).notes, Each(Not(HasSubstr("bvh_sah"))));
}

/// The light rays were never made: no row, but a table of their own with the one reason.
TEST(Comparison, NamesWhatWasLeftOutAndWhy) {
  report::Report report = small_report();
  report.left_out.push_back(report.left_out[0]);
  report.left_out.back().technique = "octree_glassner";
  const std::vector<Table> tables = comparison_tables({report});
  ASSERT_THAT(tables, SizeIs(2));
  EXPECT_THAT(tables[0].notes, Contains("Left out exhaustive, octree_glassner: it would take an hour"));
  EXPECT_THAT(tables[1].title, HasSubstr("light"));
  EXPECT_THAT(tables[1].rows, IsEmpty());
  EXPECT_THAT(tables[1].notes, ElementsAre("Left out: the scene has no lights"));
}

TEST(Comparison, NamesTheTechniqueWhereReasonsDiffer) {
  report::Report report = small_report();
  report.left_out[2].why = "embree traces in float";
  EXPECT_THAT(
      comparison_tables({report}).at(1).notes,
      ElementsAre("Left out bvh_sah: the scene has no lights", "Left out embree: embree traces in float"));
}

TEST(Comparison, ErrorIsThatOfTheStrictOptimizer) {
  report::Report report = small_report();
  Table table = measured(report);
  EXPECT_DOUBLE_EQ(number_in(table, "bvh_sah", "predicted_object_tests_error"), 7.6 / 8 - 1);
  EXPECT_DOUBLE_EQ(number_in(table, "bvh_sah", "predicted_volume_tests_error"), 12.6 / 12 - 1);
  EXPECT_EQ(find_cell(table, "bvh_sah", "predicted_error_basis").text, "strict");
  measurement(report, "bvh_sah").strict_work.reset();
  table = measured(report);
  EXPECT_DOUBLE_EQ(number_in(table, "bvh_sah", "predicted_object_tests_error"), 7.6 / 3 - 1);
  EXPECT_EQ(find_cell(table, "bvh_sah", "predicted_error_basis").text, "closest");
}

TEST(Comparison, CountsArePerRayOfTheirOwnWork) {
  const Table table = measured(small_report());
  EXPECT_DOUBLE_EQ(number_in(table, "uniform_grid(density=1)", "object_tests_per_ray"), 12);
  EXPECT_DOUBLE_EQ(number_in(table, "uniform_grid(density=1)", "distinct_objects_per_ray"), 10);
  EXPECT_DOUBLE_EQ(number_in(table, "uniform_grid(density=1)", "mailbox_hits_per_ray"), 0.3);
  EXPECT_DOUBLE_EQ(number_in(table, "uniform_grid(density=1)", "strict_object_tests_per_ray"), 20);
  EXPECT_DOUBLE_EQ(number_in(table, "uniform_grid(density=1)", "build_ms"), 3);
  EXPECT_DOUBLE_EQ(number_in(table, "uniform_grid(density=1)", "memory_mb"), 0.001234);
}

TEST(Comparison, LabelsHaveTheKeysThatDifferAndThoseThatAreNotAlwaysThere) {
  report::Report report = small_report();
  report.measurements.back().config.erase("mailbox");
  EXPECT_THAT(row_names(measured(report)), Contains("uniform_grid(density=1, mailbox=on)"));
  EXPECT_THAT(row_names(measured(report)), Contains("uniform_grid(density=8)"));
}

TEST(Comparison, GroupsByPrecisionAndKeepsTheOrderOfScenes) {
  report::Report report = small_report();
  report.scenes.insert(report.scenes.begin(), {.id = "gears:1/curves", .objects = 7});
  report::Measurement other = measurement(report, "bvh_sah");
  other.scalar = "double";
  report.measurements.push_back(other);
  other.intersector = "watertight";
  report.measurements.push_back(other);
  other.scene = "gears:1/curves", other.rays = "gears:1/curves/chords";
  report.measurements.push_back(other);
  std::vector<std::string> titles;
  for (const Table& table : comparison_tables({report})) titles.push_back(table.title);
  EXPECT_THAT(titles, ElementsAre("gears:1/curves, chords, double, watertight; 7 objects",
                                  "balls:2/curves, whitted@9, float; 50 objects; 100 rays",
                                  "balls:2/curves, whitted@9, double; 50 objects; 100 rays",
                                  "balls:2/curves, whitted@9, double, watertight; 50 objects; 100 rays",
                                  "balls:2/curves, light, float; 50 objects"));
}

TEST(Comparison, SaysWithHowManyThreadsTimesWereTaken) {
  report::Report report = small_report();
  for (report::Measurement& m : report.measurements) m.trace_threads = 4;
  EXPECT_THAT(measured(report).title, HasSubstr("100 rays; 4 threads"));
}

TEST(Comparison, SeveralReportsAreToldApartByTheirRuns) {
  report::Report second = small_report();
  second.run.id = "run-2";
  const std::vector<Table> tables = comparison_tables({small_report(), second});
  ASSERT_THAT(tables, SizeIs(4));
  EXPECT_THAT(tables[0].title, HasSubstr("[run-1] balls:2/curves"));
  EXPECT_THAT(tables[2].title, HasSubstr("[run-2] balls:2/curves"));
  EXPECT_THAT(measured(second).title, Not(HasSubstr("run-2")));
}

TEST(Comparison, SaysWhichRunWasInterrupted) {
  report::Report whole = small_report(), interrupted = small_report(), empty;
  interrupted.run.complete = empty.run.complete = false;
  const std::vector<Table> tables = comparison_tables({interrupted, whole, empty});
  ASSERT_THAT(tables, SizeIs(4));
  EXPECT_THAT(tables[1].notes, Contains(HasSubstr("interrupted")));
  for (const std::size_t other : {0u, 2u, 3u})
    EXPECT_THAT(tables[other].notes, Each(Not(HasSubstr("interrupted"))));
}

TEST(Comparison, KeysOfColumnsAreUnique) {
  std::set<std::string> keys;
  for (const ComparisonColumn& column : comparison_columns())
    EXPECT_TRUE(keys.insert(column.column.key).second) << column.column.key;
}

/// The median is 22500, the median distance from it 1500: 22500 + 10 * 1.4826 * 1500 is 44739.
TEST(Comparison, TellsOutliersAndKeepsThem) {
  report::Report report = small_report();
  EXPECT_EQ(number_in(measured(report), "uniform_grid(density=1)", "outliers"), 0);
  const double before = number_in(measured(report), "uniform_grid(density=1)", "trace_ns_per_ray");
  measurement(report, "uniform_grid").trace_ns.back() = 45000;
  EXPECT_EQ(number_in(measured(report), "uniform_grid(density=1)", "outliers"), 1);
  EXPECT_EQ(number_in(measured(report), "uniform_grid(density=1)", "repetitions"), 6);
  EXPECT_EQ(number_in(measured(report), "uniform_grid(density=1)", "trace_ns_per_ray"), before);
}

}  // namespace
}  // namespace rayshoot::analysis
