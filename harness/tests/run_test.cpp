#include "harness/measure/run.h"

#include <gmock/gmock.h>

#include <numeric>
#include <set>
#include <thread>

#include "altered_technique.h"
#include "harness/measure/building.h"
#include "harness/measure/phases.h"

namespace rayshoot::test {
namespace {

using report::Status;
using ::testing::Each;
using ::testing::Gt;
using ::testing::IsEmpty;
using ::testing::Optional;
using ::testing::SizeIs;

class SilentObserver final : public RunObserver {
 public:
  void doing(const std::string&) override { ++steps; }
  void finished(std::size_t cells) override { finished_cells += cells; }
  int steps = 0;
  std::size_t finished_cells = 0;
};

/// Runs of whitted@9 on balls:1, which asks for closest and for any hits, with techniques of our own making.
class RunTest : public ::testing::Test {
 protected:
  RunTest() {
    plan_.suite.scenes = {"balls:1"};
    plan_.suite.repetitions = 3;
    plan_.rays = {resolve_rays("whitted@9")};
  }
  void add(const TechniqueEntry& entry) { plan_.techniques.push_back({&entry, {}, entry.info.id}); }
  report::Report run() {
    return rayshoot::run(plan_, {}, observer_, [] { return false; });
  }
  report::Measurement run_one(const TechniqueEntry& entry) {
    add(entry);
    const report::Report report = run();
    EXPECT_EQ(report.measurements.size(), 1u);
    return report.measurements.at(0);
  }

  Plan plan_;
  SilentObserver observer_;
};

TEST_F(RunTest, ARightTechniqueIsVerifiedCountedAndTimed) {
  const report::Measurement m = run_one(technique_entry("exhaustive"));
  EXPECT_EQ(m.verdict.status, Status::ok);
  EXPECT_EQ(m.verdict.wrong_rays, 0u);
  EXPECT_EQ(m.verdict.reference, "exhaustive");
  EXPECT_EQ(m.query, "closest+any");
  ASSERT_TRUE(m.work);
  EXPECT_EQ(m.verdict.checked_rays, m.work->rays);
  EXPECT_EQ(m.strict_work->object_tests, 11 * m.work->rays);
  EXPECT_EQ(m.efficiency->m_strict, 1);
  EXPECT_THAT(m.trace_ns, SizeIs(3));
  EXPECT_THAT(m.build_ns, SizeIs(3));
  EXPECT_THAT(m.trace_ns, Each(Gt(0)));
}

TEST_F(RunTest, MoreIsExpectedOfAHierarchyThanOfAGrid) {
  for (const char* id : {"bvh_sah", "uniform_grid"}) plan_.techniques.push_back(choose_technique(id));
  const report::Report report = run();
  const report::Measurement &hierarchy = report.measurements.at(0), &grid = report.measurements.at(1);
  ASSERT_TRUE(hierarchy.predicted && hierarchy.sampled_prediction && hierarchy.end_point_overlap);
  EXPECT_GE(4 * hierarchy.sampled_prediction->sampled_rays, hierarchy.work->rays);
  EXPECT_LT(hierarchy.sampled_prediction->sampled_rays, hierarchy.work->rays);
  EXPECT_FALSE(grid.predicted || grid.sampled_prediction || grid.end_point_overlap);
  EXPECT_THAT(hierarchy.cells_deviation, Optional(Gt(0)));
  EXPECT_THAT(grid.cells_deviation, Optional(Gt(0)));
}

TEST_F(RunTest, AWrongTechniqueGetsAVerdictAndNoTime) {
  const TechniqueEntry losing = losing_technique("losing");
  const report::Measurement m = run_one(losing);
  EXPECT_EQ(m.verdict.status, Status::wrong);
  EXPECT_GT(m.verdict.wrong_rays, 0u);
  EXPECT_LT(m.verdict.wrong_rays, m.verdict.checked_rays);
  EXPECT_THAT(m.trace_ns, IsEmpty());
  EXPECT_FALSE(m.work || m.efficiency);
}

TEST_F(RunTest, ADistanceThatIsOffByOneUlpIsWrong) {
  const TechniqueEntry shifting = shifting_technique<1 + std::numeric_limits<float>::epsilon()>("shifting");
  EXPECT_EQ(run_one(shifting).verdict.status, Status::wrong);
}

TEST_F(RunTest, AnEngineWithAnObjectTestOfItsOwnIsGraded) {
  TechniqueEntry shifting = shifting_technique<1.0001F>("shifting");
  shifting.info.own_object_test = true;
  const report::Measurement m = run_one(shifting);
  EXPECT_EQ(m.verdict.status, Status::graded);
  EXPECT_EQ(m.verdict.wrong_rays, 0u);
  EXPECT_THAT(m.trace_ns, SizeIs(3));
}

TEST_F(RunTest, GradingCountsTheRaysThatDiffer) {
  TechniqueEntry losing = losing_technique("losing");
  losing.info.own_object_test = true;
  const report::Measurement m = run_one(losing);
  EXPECT_EQ(m.verdict.status, Status::graded);
  EXPECT_GT(m.verdict.wrong_rays, 0u);
  EXPECT_THAT(m.trace_ns, SizeIs(3));
}

TEST_F(RunTest, ATechniqueThatCannotBeBuiltFailsWithItsReason) {
  const TechniqueEntry failing = failing_technique("failing");
  const report::Measurement m = run_one(failing);
  EXPECT_EQ(m.verdict.status, Status::failed);
  EXPECT_EQ(m.verdict.message, "a and b exclude each other");
  EXPECT_THAT(m.trace_ns, IsEmpty());
}

TEST_F(RunTest, OneWrongTechniqueDoesNotTouchTheOthers) {
  const TechniqueEntry losing = losing_technique("losing");
  add(losing);
  add(technique_entry("exhaustive"));
  const report::Report report = run();
  ASSERT_THAT(report.measurements, SizeIs(2));
  EXPECT_EQ(report.measurements[0].verdict.status, Status::wrong);
  EXPECT_EQ(report.measurements[1].verdict.status, Status::ok);
  EXPECT_THAT(report.measurements[1].trace_ns, SizeIs(3));
}

TEST_F(RunTest, PhasesAddUpToTheWallTime) {
  plan_.suite.graded_rays = 5;
  add(technique_entry("exhaustive"));
  const report::Run run = this->run().run;
  std::set<std::string> names;
  double sum = 0;
  for (const auto& [phase, seconds] : run.phase_seconds) {
    EXPECT_GT(seconds, 0) << phase;
    names.insert(phase), sum += seconds;
  }
  EXPECT_EQ(names, (std::set<std::string>(kPhaseNames.begin(), kPhaseNames.end())));
  EXPECT_GE(sum, run.seconds);
}

TEST(Phases, StandStillWhileInnerOnesLast) {
  const auto sleep = [] { std::this_thread::sleep_for(std::chrono::milliseconds(5)); };
  std::map<std::string, double> seconds;
  const double in_all = seconds_of([&] {
    Phases phases;
    const auto outer = phases.scope(Phase::build);
    sleep();
    {
      const auto inner = phases.scope(Phase::count);
      sleep();
    }
    sleep();
    seconds = phases.seconds();
  });
  EXPECT_GE(seconds.at("build"), 0.010);
  EXPECT_GE(seconds.at("count"), 0.005);
  EXPECT_LE(seconds.at("build") + seconds.at("count") + seconds.at("other"), in_all);
  EXPECT_FALSE(seconds.contains("trace"));
}

TEST_F(RunTest, CountsOnlyTakesNoTime) {
  plan_.suite.counts_only = true;
  const report::Measurement m = run_one(technique_entry("exhaustive"));
  EXPECT_EQ(m.verdict.status, Status::ok);
  EXPECT_TRUE(m.work);
  EXPECT_THAT(m.trace_ns, IsEmpty());
}

/// 130 rows of eye rays are 44 rows of tiles, the last of which has one.
TEST_F(RunTest, AMapHoldsTheWorkOfEyeRaysTileByTile) {
  for (const char* id : {"exhaustive", "bvh_sah"}) plan_.techniques.push_back(choose_technique(id));
  plan_.rays = {resolve_rays("primary@130"), resolve_rays("whitted@130"), resolve_rays("chords(rays=9)")};
  plan_.suite.work_maps = {"exhaustive"};
  plan_.suite.counts_only = true;
  std::size_t maps = 0;
  for (const report::Measurement& m : run().measurements) {
    const bool mapped = m.technique == "exhaustive" && !m.rays.ends_with("chords(rays=9)");
    ASSERT_EQ(m.work_map.has_value(), mapped) << m.technique << " " << m.rays;
    if (!m.work_map) continue;
    ++maps;
    ASSERT_EQ(m.work_map->columns(), 44u);
    ASSERT_THAT(m.work_map->object_tests, SizeIs(44 * 44));
    std::uint64_t rays = 0;
    for (std::size_t tile = 0; tile < 44 * 44; ++tile) {
      EXPECT_EQ(m.work_map->object_tests[tile], 11 * m.work_map->rays(tile)) << tile;
      rays += m.work_map->rays(tile);
    }
    EXPECT_EQ(rays, 130u * 130);
  }
  EXPECT_EQ(maps, 2u);
}

TEST_F(RunTest, AMapShowsWhereTheWorkIs) {
  plan_.techniques = {choose_technique("bvh_sah(max_objects=2)")};
  plan_.rays = {resolve_rays("primary@9")};
  plan_.suite.work_maps = {"bvh_sah"};
  const report::Report report = run();
  const report::Measurement& m = report.measurements.at(0);
  ASSERT_TRUE(m.work_map && m.work);
  const auto sum = [](const auto& sums) {
    return std::accumulate(sums.begin(), sums.end(), std::uint64_t{0});
  };
  EXPECT_EQ(sum(m.work_map->object_tests), m.work->object_tests);
  EXPECT_EQ(sum(m.work_map->volume_tests), m.work->volume_tests);
  const auto [least, most] =
      std::minmax_element(m.work_map->volume_tests.begin(), m.work_map->volume_tests.end());
  EXPECT_GT(*most, *least);
}

TEST_F(RunTest, WhatIsLeftOutIsRecordedWithItsReason) {
  const TechniqueEntry float_only = losing_technique("float_only");
  add(float_only);
  plan_.suite.scalars = {"double"};
  const report::Report report = run();
  EXPECT_THAT(report.measurements, IsEmpty());
  ASSERT_THAT(report.left_out, SizeIs(1));
  EXPECT_EQ(report.left_out[0].technique, "float_only");
  EXPECT_EQ(report.left_out[0].why, "float_only does not trace in double");
}

TEST_F(RunTest, ProgressReachesTheNumberOfCells) {
  const TechniqueEntry float_only = losing_technique("float_only");
  add(float_only);
  add(technique_entry("exhaustive"));
  plan_.suite.scalars = {"float", "double"};
  plan_.rays.push_back(resolve_rays("chords(rays=10)"));
  run();
  EXPECT_EQ(observer_.finished_cells, plan_.cells());
}

TEST_F(RunTest, ThreadScalingTimesEveryNumberOfThreads) {
  plan_.suite.thread_scaling = {1, 2};
  const report::Measurement m = run_one(technique_entry("exhaustive"));
  ASSERT_THAT(m.threads, SizeIs(2));
  EXPECT_EQ(m.threads[1].threads, 2);
  EXPECT_THAT(m.threads[1].trace_ns, SizeIs(3));
}

TEST_F(RunTest, AStoppedRunKeepsWhatWasComplete) {
  add(technique_entry("exhaustive"));
  plan_.suite.scenes = {"balls:1", "balls:2"};
  const report::Report report =
      rayshoot::run(plan_, {}, observer_, [&] { return observer_.finished_cells > 0; });
  EXPECT_FALSE(report.run.complete);
  ASSERT_THAT(report.measurements, SizeIs(1));
  EXPECT_EQ(report.measurements[0].scene, report.scenes.at(0).id);
  EXPECT_THAT(report.measurements[0].trace_ns, SizeIs(3));
}

TEST_F(RunTest, EqualSeedsGiveEqualCounts) {
  add(technique_entry("bvh_sah"));
  plan_.techniques[0].arguments = Arguments(plan_.techniques[0].entry->info.parameters, {}, "bvh_sah");
  plan_.rays = {resolve_rays("points(rays=500)")};
  plan_.suite.counts_only = true;
  const report::Report first = run(), second = run();
  EXPECT_EQ(first.ray_sets.at(0).hash, second.ray_sets.at(0).hash);
  EXPECT_EQ(first.measurements.at(0).work->object_tests, second.measurements.at(0).work->object_tests);
  plan_.suite.seed = 2;
  EXPECT_NE(run().ray_sets.at(0).hash, first.ray_sets.at(0).hash);
}

}  // namespace
}  // namespace rayshoot::test
