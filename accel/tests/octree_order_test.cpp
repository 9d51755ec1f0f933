// The traversals of explicit nodes visit the same leaves of the same octree in the same order; the steps they take differ.
#include "accel/octree/octree_dda.cpp"
#include "accel/octree/octree_gargantini.cpp"
#include "accel/octree/octree_revelles.cpp"
#include "accel/octree/octree_samet.cpp"
#include "accel/tests/leaf_sequence.h"
#include "accel/tests/two_caveats.h"

namespace rayshoot {
namespace {

const char* const kTraversals[] = {"octree_glassner", "octree_samet", "octree_gargantini", "octree_dda",
                                   "octree_revelles"};

TEST(OctreeOrder, IsThatOfRevelles) { octrees::check_leaves_in_order<OctreeRevelles<double>>(); }
TEST(OctreeOrder, IsThatOfGargantini) { octrees::check_leaves_in_order<OctreeGargantini<double>>(); }
TEST(OctreeOrder, IsThatOfSamet) { octrees::check_leaves_in_order<OctreeSamet<double>>(); }
TEST(OctreeOrder, IsThatOfDda) { octrees::check_leaves_in_order<OctreeDda<double>>(); }

/// What each of the five does on the same rays; all but steps and events is the same.
std::map<std::string, Work> works() {
  const Geometry<double> geometry(soup_scene(400));
  const auto rays = nasty::rays(geometry, 1, 200);
  std::map<std::string, Work> works;
  for (const char* id : kTraversals)
    works[id] = counted(*build(id, geometry, {{"assignment", "box"}}), Query::closest, rays).work;
  return works;
}

TEST(OctreeOrder, AllFiveTestTheSameObjectsInTheSameVoxels) {
  for (auto [id, work] : works()) {
    Work expected = works()["octree_revelles"];
    work.steps = expected.steps;
    work.events = expected.events;
    EXPECT_EQ(work, expected) << id;
  }
}

TEST(OctreeOrder, TheirStepsDiffer) {
  std::map<std::string, Work> of = works();
  EXPECT_EQ(of["octree_gargantini"].steps, of["octree_revelles"].steps)
      << "both enter each node on the ray once";
  EXPECT_LT(of["octree_revelles"].steps, of["octree_glassner"].steps) << "every voxel is named from the root";
  EXPECT_LT(of["octree_samet"].steps, of["octree_glassner"].steps) << "links lead to neighbours";
  EXPECT_LT(of["octree_dda"].steps, of["octree_samet"].steps)
      << "a step among siblings is one, not up and down";
}

/// Steps are the events of which they consist.
TEST(OctreeOrder, StepsAreReportedByKind) {
  std::map<std::string, Work> of = works();
  EXPECT_EQ(of["octree_samet"].steps, of["octree_samet"].events[0] + of["octree_samet"].events[1]);
  const Work& dda = of["octree_dda"];
  EXPECT_EQ(dda.steps, dda.events[0] + dda.events[1] + dda.events[2]);
  for (const std::uint64_t events : {dda.events[0], dda.events[1], dda.events[2]}) EXPECT_GT(events, 0u);
}

/// A scene of [-1, 1] on every axis, divided at 0, with a triangle whose longest edge passes the middle axis at that
/// distance, in the plane z = 0.1.
Geometry<float> edge_beside_the_middle(float distance) {
  SceneBuilder builder;
  for (const double corner : {-1.0, 1.0})
    builder.polygon(std::array{Vec3d{corner, corner, corner}, Vec3d{corner, 0.9 * corner, corner},
                               Vec3d{0.9 * corner, corner, corner}});
  builder.polygon(
      std::array{Vec3d{-0.5, 0.5 + distance, 0.1}, Vec3d{0.5 + distance, -0.5, 0.1}, Vec3d{0.5, 0.5, 0.1}});
  return Geometry<float>(std::move(builder).finish());
}

/// Whether a ray that starts at `z` and keeps on the other side of the middle axis is given the triangle.
bool is_candidate(const char* id, float distance, float z) {
  const Geometry<float> geometry = edge_beside_the_middle(distance);
  const auto engine = build<float>(id, geometry, {{"max_depth", "1"}, {"max_objects", "1"}});
  Ray<float> ray;
  ray.origin = {-1e-7f, -1e-7f, z}, ray.direction = {0, 0, 1};
  const auto objects = candidates(*engine, Query::strict, ray);
  return std::find(objects.begin(), objects.end(), 2u) != objects.end();
}

/// A hit is exact to some units in the last place of the way to it: so far beside a surface it must be found all the same,
/// and by a ray from afar farther beside.
TEST(OctreeMargin, GrowsWithTheWayFromTheRaysOrigin) {
  for (const char* id : kTraversals) {
    EXPECT_TRUE(is_candidate(id, 1e-5f, -2)) << id;
    EXPECT_FALSE(is_candidate(id, 1e-3f, -2)) << id;
    EXPECT_TRUE(is_candidate(id, 1e-3f, -1e4f)) << id;
  }
}

/// Samet: in a tree of 4x4x4 leaves a ray along x goes 2 down to the first leaf, 1 up and 1 down, 2 up and 2 down, 1 up and
/// 1 down, and 2 up to leave.
TEST(OctreeSamet, GoesUpToTheNearestCommonAncestorAlone) {
  SceneBuilder builder;
  for (int i = 0; i < 64; ++i) builder.sphere({0.5 + i % 4, 0.5 + i / 4 % 4, 0.5 + i / 16}, 0.45);
  builder.sphere({0.01, 0.01, 0.01}, 0.01), builder.sphere({3.99, 3.99, 3.99}, 0.01);
  const Geometry<double> geometry(std::move(builder).finish());
  const Ray<double> along_x{.origin = {-1, 0.48, 0.48}, .direction = {1, 0, 0}};
  const auto work = [&](const char* id) {
    return counted(*build(id, geometry, {{"max_depth", "2"}, {"max_objects", "1"}, {"assignment", "box"}}),
                   Query::strict, {along_x})
        .work;
  };
  const Work samet = work("octree_samet"), dda = work("octree_dda");
  ASSERT_EQ(samet.cells, 4u);
  EXPECT_EQ(samet.events[0], 6u) << "links up";
  EXPECT_EQ(samet.events[1], 6u) << "links down";
  EXPECT_EQ(dda.events[0], 3u) << "horizontal steps";
  EXPECT_EQ(dda.events[1], 3u) << "steps up";
  EXPECT_EQ(dda.events[2], 3u) << "steps down";
}

/// A ray that crosses a dividing plane on one axis alone sorts one crossing; what is behind its origin is not sorted.
TEST(OctreeGargantini, SortsTheCrossingsAheadAlone) {
  SceneBuilder builder;
  for (int i = 0; i < 8; ++i) builder.sphere({1.0 + 2 * (i & 1), 1.0 + (i & 2), 1.0 + (i >> 1 & 2)}, 0.9);
  const Geometry<double> geometry(std::move(builder).finish());
  const auto engine = build("octree_gargantini", geometry, {{"max_depth", "1"}, {"max_objects", "1"}});
  const auto sorted = [&](const Ray<double>& ray) {
    return counted(*engine, Query::strict, {ray}).work.events[0];
  };
  EXPECT_EQ(sorted({.origin = {0.5, 0.5, 0.5}, .direction = {1, 2, 3}}), 3u);
  EXPECT_EQ(sorted({.origin = {3.5, 0.5, 0.5}, .direction = {1, 2, 3}}), 2u);
  EXPECT_EQ(sorted({.origin = {3.5, 3.5, 3.5}, .direction = {1, 2, 3}}), 0u);
}

TEST(OctreeOrder, AllTestAnObjectOnceWithAMailboxAndGoOnBehindAHitBeyondTheVoxel) {
  for (const char* id : kTraversals) {
    SCOPED_TRACE(id);
    caveats::check_repeated_tests(id, {{"max_depth", "2"}, {"max_objects", "1"}});
    caveats::check_mailbox_changes_no_answer(id, {});
    caveats::check_hit_beyond_the_voxel(id, {{"max_depth", "2"}, {"max_objects", "1"}}, 3);
  }
}

}  // namespace
}  // namespace rayshoot
