#include <gmock/gmock.h>

#include "analysis/tables/comparison.h"
#include "analysis/tests/find_cell.h"

namespace rayshoot::analysis {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;

constexpr std::array kSizes = {100u, 1000u, 10000u, 100000u};

report::Measurement& add(report::Report& report, const std::string& technique, std::uint64_t objects,
                         double ns, double build_ns, std::uint64_t bytes) {
  const std::string scene = report.scenes.back().id;
  report::Measurement cell{
      .scene = scene, .rays = scene + "/chords", .technique = technique, .scalar = "float"};
  cell.trace_ns = {10 * ns}, cell.build_ns = {build_ns};
  cell.work = report::Work{.rays = 10, .object_tests = 10 * objects};
  cell.structure = report::Structure{.bytes = bytes};
  return report.measurements.emplace_back(cell);
}

/// Ten chords through a scene in four sizes. The time of one technique grows with the square root of the objects, its build
/// with their power 1.5; that of the other does not grow, and in the largest size it is wrong.
report::Report growing(const std::string& arguments = "") {
  report::Report report;
  for (const std::uint64_t objects : kSizes) {
    const std::string scene = fmt::format("tetra:{}/curves{}", objects, arguments);
    const double n = static_cast<double>(objects);
    report.scenes.push_back({.id = scene, .generator = "tetra", .form = "curves", .objects = objects});
    report.ray_sets.push_back({.id = scene + "/chords", .scene = scene, .rays = 10});
    add(report, "bvh_sah", objects, 7 * std::sqrt(n), 2 * std::pow(n, 1.5), 48 * objects);
    add(report, "uniform_grid", objects, 90, n, 100 + objects).verdict.status =
        objects == kSizes.back() ? report::Status::wrong : report::Status::ok;
  }
  return report;
}

TEST(Growth, FindsExponentsAndTheMemoryOfAnObject) {
  const std::vector<Table> tables = growth_tables({growing()});
  ASSERT_THAT(tables, SizeIs(1));
  const Table& table = tables[0];
  EXPECT_EQ(table.title, "tetra as curves, chords, float: growth from 100 to 100000 objects");
  EXPECT_NEAR(number_in(table, "bvh_sah", "time_exponent"), 0.5, 1e-12);
  EXPECT_NEAR(number_in(table, "bvh_sah", "tests_exponent"), 1, 1e-12);
  EXPECT_NEAR(number_in(table, "bvh_sah", "build_exponent"), 1.5, 1e-12);
  EXPECT_NEAR(number_in(table, "bvh_sah", "memory_exponent"), 1, 1e-12);
  EXPECT_EQ(find_cell(table, "bvh_sah", "time_exponent_text").text, "0.50 [0.50, 0.50]");
  EXPECT_EQ(number_in(table, "bvh_sah", "bytes_per_object"), 48);
  EXPECT_EQ(number_in(table, "bvh_sah", "sizes"), 4);
  EXPECT_NEAR(number_in(table, "bvh_sah", "trace_ns_per_ray"), 7 * std::sqrt(1e5), 1e-9);
}

TEST(Growth, SortsByTheGrowthOfTimeAndLeavesWrongCellsOut) {
  const Table table = growth_tables({growing()}).at(0);
  EXPECT_THAT(row_names(table), ElementsAre("uniform_grid", "bvh_sah"));
  EXPECT_EQ(number_in(table, "uniform_grid", "sizes"), 3);
  EXPECT_EQ(number_in(table, "uniform_grid", "objects_to"), 10000);
  EXPECT_NEAR(number_in(table, "uniform_grid", "time_exponent"), 0, 1e-12);
  EXPECT_NEAR(number_in(table, "uniform_grid", "bytes_per_object"), 1.01, 1e-12);
}

TEST(Growth, IntervalsAreWiderWhereTheLineIsNotStraight) {
  report::Report report = growing();
  report.measurements[2].trace_ns[0] *= 2;
  const Table table = growth_tables({report}).at(0);
  const double exponent = number_in(table, "bvh_sah", "time_exponent");
  EXPECT_LT(number_in(table, "bvh_sah", "time_exponent_low"), exponent - 0.1);
  EXPECT_GT(number_in(table, "bvh_sah", "time_exponent_high"), exponent + 0.1);
}

TEST(Growth, HasNoExponentOfWhatWasNotMeasuredThreeTimes) {
  report::Report report = growing();
  for (const std::size_t size : {0u, 2u}) report.measurements[2 * size].trace_ns.clear();
  const Table table = growth_tables({report}).at(0);
  EXPECT_FALSE(find_cell(table, "bvh_sah", "time_exponent").number);
  EXPECT_THAT(find_cell(table, "bvh_sah", "time_exponent_text").text, IsEmpty());
  EXPECT_TRUE(find_cell(table, "bvh_sah", "tests_exponent").number);
}

TEST(Growth, IsOfOneSceneInThreeSizes) {
  report::Report report = growing();
  report.measurements.resize(4);
  EXPECT_THAT(growth_tables({report}), IsEmpty());
  EXPECT_THAT(render_growth({report}, Format::text), IsEmpty());
  // Other arguments make another scene.
  report = growing();
  const report::Report other = growing("(ratio=10)");
  report.scenes.insert(report.scenes.end(), other.scenes.begin(), other.scenes.end());
  report.ray_sets.insert(report.ray_sets.end(), other.ray_sets.begin(), other.ray_sets.end());
  report.measurements.insert(report.measurements.end(), other.measurements.begin(), other.measurements.end());
  const std::vector<Table> tables = growth_tables({report});
  ASSERT_THAT(tables, SizeIs(2));
  EXPECT_THAT(tables[1].title, HasSubstr("tetra as curves (ratio=10), chords"));
  EXPECT_EQ(number_in(tables[1], "bvh_sah", "sizes"), 4);
}

TEST(Growth, StandsBelowTheComparisonButNotInCsv) {
  EXPECT_THAT(render_comparison({growing()}, Format::text), HasSubstr("growth from 100 to 100000 objects"));
  EXPECT_THAT(render_comparison({growing()}, Format::csv), Not(HasSubstr("time_exponent")));
  const std::string csv = render_growth({growing()}, Format::csv);
  EXPECT_THAT(csv,
              StartsWith("technique,scene,rays,precision,sizes,objects_to,time_exponent,time_exponent_low,"));
  EXPECT_THAT(csv, HasSubstr("\nbvh_sah,tetra as curves,chords,float,4,100000,"));
}

}  // namespace
}  // namespace rayshoot::analysis
