// What others published on the same scenes, replayed: structures and work are counts and depend on no machine. Tests whose
// names begin with Long are labelled long.
#include <gmock/gmock.h>

#include <regex>

#include "harness/measure/run.h"

namespace rayshoot::test {
namespace {

class SilentObserver final : public RunObserver {
 public:
  void doing(const std::string&) override {}
  void finished(std::size_t) override {}
};

/// The part of a suite that is about the techniques whose specifications a pattern matches.
report::Report replayed(const std::string& suite_name, const std::vector<std::string>& scenes,
                        const std::string& techniques, const std::string& rays = {}) {
  Suite suite = load_suite(suite_name);
  if (!scenes.empty()) suite.scenes = scenes;
  if (!rays.empty()) suite.rays = {rays};
  Plan plan = make_plan(suite);
  std::erase_if(plan.techniques, [pattern = std::regex(techniques)](const TechniqueChoice& choice) {
    return !std::regex_search(choice.spec, pattern);
  });
  SilentObserver observer;
  return run(plan, {}, observer, [] { return false; });
}

/// How far our figures may be from the published ones, relatively; figures that are not here are not looked at.
using Limits = std::map<std::string, double>;

/// Hold every measurement of a report against what was published for it; returns how many figures were.
int expect_within(const report::Report& report, const Limits& limits) {
  int figures = 0;
  for (const report::Measurement& measurement : report.measurements) {
    EXPECT_EQ(measurement.verdict.status, report::Status::ok);
    for (const report::PublishedFigure& figure : measurement.published) {
      const auto limit = limits.find(figure.figure);
      if (limit == limits.end()) continue;
      EXPECT_NEAR(figure.ours.value_or(-1), figure.theirs, limit->second * figure.theirs)
          << measurement.scene << ", " << figure.label << ": " << figure.figure;
      ++figures;
    }
  }
  return figures;
}

/// Cells per ray, his traversal steps of grids, are met within 0.1: shadow rays here end at any occluder that they
/// find, his at one inside the cell that they are in.
void expect_cells(const report::Report& report) {
  for (const report::Measurement& measurement : report.measurements)
    for (const report::PublishedFigure& figure : measurement.published) {
      if (figure.figure != "cells_per_ray") continue;
      EXPECT_NEAR(figure.ours.value_or(-1), figure.theirs, 0.1) << measurement.scene << ", " << figure.label;
    }
}

/// Tests with objects are met within 6 %: for the same reason ours are fewer.
constexpr double kObjectTests = 0.06;

const Limits kStructure{{"leaves", 0}, {"empty_leaves", 0.001}, {"references", 0.02}};

Limits with(Limits limits, const std::string& figure, double limit) {
  limits[figure] = limit;
  return limits;
}

TEST(ReplayTest, HavransUniformGridsHaveHisCells) {
  const report::Report report = replayed("havran-1999", {"balls:4", "tetra:6"}, "uniform_grid", "whitted@9");
  EXPECT_EQ(expect_within(report, kStructure), 18);
  EXPECT_EQ(report.run.bounds, "havran");
}

TEST(ReplayTest, HavransUniformGridsDoHisWorkOnTetra) {
  const report::Report report = replayed("havran-1999", {"tetra:6"}, "uniform_grid");
  EXPECT_EQ(expect_within(report, {{"object_tests_per_ray", kObjectTests}}), 3);
  expect_cells(report);
}

const Limits kSameStructure{{"interior_nodes", 0}, {"leaves", 0}, {"empty_leaves", 0}, {"references", 0}};
/// Octrees that divide at the centre.
const char* const kOctrees[] = {"octree_glassner(?!.*cost)", "octree_samet", "octree_gargantini(?!.*cost)"};

TEST(ReplayTest, HavransOctreesOfTetraHaveHisNodes) {
  for (const char* octree : kOctrees)
    EXPECT_EQ(expect_within(replayed("havran-1999", {"tetra:6"}, octree, "whitted@9"), kSameStructure), 16)
        << octree;
}

TEST(LongReplayTest, HainesTestedObjectsWithoutVolumesAboutThem) {
  const report::Report report =
      replayed("haines-1987", {"balls:4", "gears:4", "mount:6", "rings:7", "tree:11"}, "object_volumes=off");
  EXPECT_EQ(expect_within(report, {{"object_tests", 0.25}}), 5);
}

TEST(LongReplayTest, HavransOctreesHaveHisNodes) {
  for (const char* octree : kOctrees) {
    const report::Report report =
        replayed("havran-1999", {"balls:4", "gears:4", "teapot:12", "tetra:6"}, octree, "whitted@9");
    EXPECT_EQ(expect_within(report, kSameStructure), 64) << octree;
  }
}

/// His traversal of 1993 ends as ours does, with any hit in reach, and steps as often. He counts more of the empty cells.
TEST(ReplayTest, HavransOctreesOf1993DoHisWorkOnTetra) {
  const report::Report report = replayed("havran-1999", {"tetra:6"}, "octree_gargantini(?!.*cost)");
  EXPECT_EQ(expect_within(report, {{"steps_per_ray", 0.001}, {"object_tests_per_hit", 0.003}}), 8);
}

/// Those of 1984 and 1989 end with a hit inside the cell that they are in, and so do more; of 1989 he counts the root too.
TEST(ReplayTest, HavransOctreesOf1984And1989DoAboutHisWorkOnTetra) {
  const Limits limits{
      {"object_tests_per_hit", 0.07}, {"cells_per_ray", 0.015}, {"empty_cells_per_ray", 0.015}};
  EXPECT_EQ(expect_within(replayed("havran-1999", {"tetra:6"}, "octree_samet"),
                          with(limits, "steps_per_ray", 0.05)),
            16);
  const report::Report of_1984 = replayed("havran-1999", {"tetra:6"}, "octree_glassner(?!.*cost)");
  EXPECT_EQ(expect_within(of_1984, with(limits, "steps_per_ray", 0.015)), 16);
}

/// Of what he leaves open the numbers of nodes at least are near: which ten planes he tries, and when a cell gets a grid.
TEST(ReplayTest, HavransOctreesDividedByCostHaveAboutHisNodes) {
  const report::Report report = replayed("havran-1999", {"balls:4", "teapot:12"}, "cost", "whitted@9");
  EXPECT_EQ(expect_within(report, {{"interior_nodes", 0.1}, {"leaves", 0.1}}), 32);
}

TEST(ReplayTest, HavransRecursiveGridsHaveAboutHisGrids) {
  const report::Report report = replayed("havran-1999", {"balls:4", "gears:4", "teapot:12", "tetra:6"},
                                         "recursive_grid.*heterogeneous.*max_depth=2", "whitted@9");
  EXPECT_EQ(expect_within(report, {{"interior_nodes", 0.05}}), 4);
}

TEST(LongReplayTest, HavransUniformGridsWithoutGlass) {
  const Limits limits = with(kStructure, "object_tests_per_ray", kObjectTests);
  const report::Report report = replayed("havran-1999", {"balls:4", "teapot:12", "tetra:6"}, "uniform_grid");
  EXPECT_EQ(expect_within(report, limits), 36);
  expect_cells(report);
}

TEST(LongReplayTest, HavransUniformGridsWithConesAndCylinders) {
  const Limits limits{{"leaves", 0}, {"references", 0.05}, {"object_tests_per_ray", kObjectTests}};
  const report::Report report = replayed("havran-1999", {"rings:7", "tree:11"}, "uniform_grid");
  EXPECT_EQ(expect_within(report, limits), 18);
  expect_cells(report);
}

}  // namespace
}  // namespace rayshoot::test
