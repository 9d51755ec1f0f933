// What makes grid_1d the adaptive 1-D grid of Jevans (1990): what a ray finds of a traversal state, and that voxels are
// subdivided when a ray comes to them, which changes no answer and no count.
#include <gmock/gmock.h>

#include "accel/parts/grid_1d_walk.h"
#include "accel/tests/conformance.h"
#include "accel/tests/two_caveats.h"

namespace rayshoot {
namespace {

constexpr const char* kId = "grid_1d";
using ::testing::ElementsAre;

/// Balls that fill the cells of a block, so that halving along x, y and z ends where each has a voxel of its own.
Scene block(int x, int y, int z) {
  SceneBuilder builder;
  for (int i = 0; i < x * y * z; ++i)
    builder.sphere({1.0 + 2 * (i % x), 1.0 + 2 * (i / x % y), 1.0 + 2 * (i / x / y)}, 0.99);
  return std::move(builder).finish();
}

const Given kHalving{{"max_granularity", "2"}, {"intcost", "1000"}};

/// Events of one ray through a scene that is halved, by kind, and then its steps.
std::vector<std::uint64_t> events(const Scene& scene, const Ray<double>& ray) {
  const Geometry<double> geometry(scene);
  const Work work = counted(*build(kId, geometry, kHalving), Query::strict, {ray}).work;
  return {work.events[states_initialized], work.events[states_reused],   work.events[uniform_cases],
          work.events[adjacent_cases],     work.events[differing_cases], work.steps};
}

TEST(Grid1dStates, AreReadyInAUniformSubdivision) {
  // Down to a ball along x, y and z; then one step along x, down again through voxels of the same states and extents.
  EXPECT_THAT(events(block(2, 2, 2), {.origin = {-3, 1, 1.1}, .direction = {1, 1e-3, 2e-3}}),
              ElementsAre(3, 0, 2, 0, 0, 3 + 1 + 2));
  EXPECT_THAT(events(block(2, 2, 2), {.origin = {7, 1, 1.1}, .direction = {-1, 1e-3, 2e-3}}),
              ElementsAre(3, 0, 2, 0, 0, 3 + 1 + 2));
}

TEST(Grid1dStates, KnowTheIndexWhereVoxelsTouch) {
  // Four balls along x take a second level of x below z: the ray goes from its last subvoxel to the first of the next.
  for (const double sign : {1.0, -1.0}) {
    const Ray<double> ray{.origin = {4 - sign * 7, 1, 1.1}, .direction = {sign, 1e-3, 2e-3}};
    EXPECT_THAT(events(block(4, 2, 2), ray), ElementsAre(4, 0, 2, 1, 0, 4 + 1 + 1 + 3 + 1));
  }
}

TEST(Grid1dStates, AreKnownAgainByTheSignatureOfTheRay) {
  // The middle ball is missing: its neighbours beyond it find the state of the ray, but no voxel to compare with.
  SceneBuilder builder;
  for (const double x : {1.0, 3.0, 9.0, 11.0})
    for (const double y : {1.0, 3.0}) builder.sphere({x, y, 1}, 0.99);
  const Geometry<double> geometry(std::move(builder).finish());
  const auto engine = build(kId, geometry, {{"max_granularity", "3"}, {"intcost", "1000"}});
  const Ray<double> ray{.origin = {-3, 1, 1.1}, .direction = {1, 1e-3, 2e-3}};
  const Work once = counted(*engine, Query::strict, {ray}).work;
  EXPECT_GT(once.events[states_reused], 0u);
  const Work twice = counted(*engine, Query::strict, {ray, ray}).work;
  EXPECT_EQ(twice.events[states_initialized], 2 * once.events[states_initialized]);
}

TEST(Grid1dStates, AllCasesOccurInASceneThatIsNotUniform) {
  const Geometry<double> geometry(soup_scene(1000));
  const auto engine = build(kId, geometry, {{"max_granularity", "4"}});
  const Work work = counted(*engine, Query::strict, nasty::rays(geometry, 1, 1000)).work;
  for (std::size_t kind = 0; kind < kGrid1dEvents.size(); ++kind)
    EXPECT_GT(work.events[kind], 0u) << kGrid1dEvents[kind];
}

/// A cluster of balls at either end of a long room.
Scene two_clusters() {
  SceneBuilder builder;
  nasty::Random random(8);
  for (int i = 0; i < 600; ++i)
    builder.sphere(nasty::uniform_point(random, 0, 1) + Vec3d{i % 2 ? 20.0 : 0, 0, 0}, 0.01);
  return std::move(builder).finish();
}

/// Rays across the room at one end.
std::vector<Ray<double>> rays_at(double x) {
  nasty::Random random(6);
  std::vector<Ray<double>> rays;
  for (int i = 0; i < 100; ++i) {
    const Vec3d from = nasty::uniform_point(random, 0, 1) + Vec3d{x, -3, 0};
    const Vec3d to = nasty::uniform_point(random, 0, 1) + Vec3d{x, 1, 0};
    rays.push_back({.origin = from, .direction = to - from});
  }
  return rays;
}

class Grid1dLazy : public ::testing::Test {
 protected:
  /// An engine that was shown rays at the near end.
  std::unique_ptr<Engine<double>> engine() const {
    const TechniqueEntry& entry = technique_entry(kId);
    return entry.build<double>({geometry_, Arguments(entry.info.parameters, {}, kId), nullptr, {near_, 100}});
  }
  static double subdivided(const Engine<double>& engine) {
    return engine.structure().figures.at("voxels_subdivided");
  }

  Geometry<double> geometry_{two_clusters()};
  std::vector<Ray<double>> near_ = rays_at(0), far_ = rays_at(20);
};

TEST_F(Grid1dLazy, SpaceIsSubdividedWhenARayComesToIt) {
  const auto engine = this->engine();
  const StructureStats before = engine->structure();
  EXPECT_GT(before.figures.at("candidates_untouched"), 0);

  // The sample has been at the near end; other rays there subdivide little, those at the far end a good deal.
  counted(*engine, Query::strict, near_);
  const double near = subdivided(*engine);
  counted(*engine, Query::strict, {{.origin = {10, -5, 0.5}, .direction = {0, 1, 0}}});
  EXPECT_EQ(subdivided(*engine), near) << "nothing is in the middle";
  counted(*engine, Query::strict, {{.origin = {-50, 30, 0.5}, .direction = {1, 0, 0}}});
  EXPECT_EQ(subdivided(*engine), near) << "this ray misses the room";
  counted(*engine, Query::strict, far_);
  EXPECT_GT(subdivided(*engine), near + 20);
  const double both = subdivided(*engine);
  counted(*engine, Query::strict, far_);
  EXPECT_EQ(subdivided(*engine), both);
}

TEST_F(Grid1dLazy, WhatStandsBehindAWallStaysWhole) {
  SceneBuilder builder;
  nasty::Random random(8);
  for (int i = 0; i < 300; ++i) builder.sphere(nasty::uniform_point(random, 0, 1) + Vec3d{9, 0, 0}, 0.01);
  nasty::square(builder, {1, -0.5, -0.5}, {0, 2, 0}, {0, 0, 2});
  const Geometry<double> geometry(std::move(builder).finish());
  std::vector<Ray<double>> rays;
  for (int i = 0; i < 100; ++i)
    rays.push_back(
        {.origin = {-3, 0.5, 0.5}, .direction = nasty::uniform_point(random, -0.1, 0.1) + Vec3d{1, 0, 0}});
  const TechniqueEntry& entry = technique_entry(kId);
  const auto engine =
      entry.build<double>({geometry, Arguments(entry.info.parameters, {}, kId), nullptr, {rays, 1000}});
  counted(*engine, Query::closest, rays);
  const double seen = subdivided(*engine);
  counted(*engine, Query::strict, rays);
  EXPECT_GT(subdivided(*engine), seen);
}

TEST_F(Grid1dLazy, CountsDoNotDependOnWhatIsSubdividedAlready) {
  std::vector<Ray<double>> rays = near_;
  rays.insert(rays.end(), far_.begin(), far_.end());
  for (const Query query : {Query::closest, Query::any, Query::strict}) {
    const auto engine = this->engine(), later = this->engine();
    const auto first = counted(*engine, query, rays), second = counted(*engine, query, rays);
    EXPECT_EQ(first.work, second.work);
    EXPECT_EQ(first.hits, second.hits);
    counted(*later, Query::strict, std::vector(rays.rbegin(), rays.rend()));
    const auto third = counted(*later, query, rays);
    EXPECT_EQ(first.work, third.work);
    EXPECT_EQ(first.hits, third.hits);
  }
}

TEST_F(Grid1dLazy, ThreadsSubdivideTheSame) {
  const Geometry<double> geometry(soup_scene(4000));
  const std::vector<Ray<double>> rays = nasty::rays(geometry, 1, 20'000);
  const auto result = [&](int threads) {
    const auto fresh = build(kId, geometry);
    ThreadScratch<double> scratch(*fresh);
    Counted<double> counted{.hits = std::vector<Hit<double>>(rays.size())};
    counted.work = count_work<double>(*fresh, Query::closest, rays, counted.hits, scratch, threads).total;
    return std::pair(std::move(counted), fresh->structure());
  };
  const auto [one, one_structure] = result(1);
  for (const int threads : {2, 3}) {
    const auto [many, many_structure] = result(threads);
    EXPECT_EQ(one.work, many.work);
    EXPECT_EQ(one.hits, many.hits);
    EXPECT_EQ(one_structure.figures, many_structure.figures);
    EXPECT_EQ(one_structure.references, many_structure.references);
    EXPECT_EQ(one_structure.nodes, many_structure.nodes);
  }
}

TEST(Grid1d, AnswersEqualExhaustiveSearchHoweverItIsCut) {
  const Geometry<float> geometry(soup_scene(400));
  const std::vector<Ray<float>> rays = nasty::rays(geometry, 1, 300);
  const auto truths = conformance::truths<float>(geometry, rays);
  for (const char* granularity : {"2", "3", "20", "500"})
    for (const char* axes : {"alternate", "paying"})
      for (const char* intcost : {"1", "16", "10000"}) {
        SCOPED_TRACE(fmt::format("max_granularity={} axes={} intcost={}", granularity, axes, intcost));
        const Given given{{"max_granularity", granularity}, {"axes", axes}, {"intcost", intcost}};
        conformance::check_engine<float>(*build<float>(kId, geometry, given), rays, truths);
      }
}

TEST(Grid1d, ARayAlongTheEdgesOfVoxelsMeetsAllThatTouchThem) {
  const Geometry<double> geometry(block(8, 8, 8));
  const auto engine = build(kId, geometry, kHalving);
  std::vector<Ray<double>> rays;
  for (int i = 0; i <= 16; ++i) {
    const double at = i;
    rays.push_back({.origin = {at, 0, -1}, .direction = {0, 1, 1}});
    rays.push_back({.origin = {8, at, -1}, .direction = {0, 0, 1}});
    rays.push_back({.origin = {-1, -1, -1}, .direction = {1, 1, 1}});
    rays.push_back({.origin = {17, at, 17}, .direction = {-1, 0, -1}});
  }
  conformance::check_engine<double>(*engine, rays, conformance::truths<double>(geometry, rays));
}

TEST(Grid1d, LeavesASceneThatIsNotWorthItWhole) {
  const Geometry<double> geometry(soup_scene(100));
  const StructureStats whole = build(kId, geometry, {{"subcost", "1000000000"}})->structure();
  EXPECT_EQ(whole.nodes, 1u);
  EXPECT_EQ(whole.references, geometry.size());
  EXPECT_EQ(build(kId, geometry, {{"max_granularity", "1"}})->structure().nodes, 1u);
}

/// Timings at which the room of the caveats is cut into four along x, and no further.
const Given kQuarters{{"max_granularity", "4"}, {"intcost", "20"}, {"vertcost", "30"}};

TEST(Grid1dCaveats, AnObjectIsTestedOnceForARay) {
  caveats::check_repeated_tests(kId, kQuarters);
  caveats::check_mailbox_changes_no_answer(kId, {});
}

TEST(Grid1dCaveats, AHitBeyondTheVoxelDoesNotEndTheWalk) {
  caveats::check_hit_beyond_the_voxel(kId, kQuarters, 4);
}

}  // namespace
}  // namespace rayshoot
