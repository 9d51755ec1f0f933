// What makes recursive_grid that technique: grids within the cells of grids, where the scene is crowded and nowhere else.
#include "accel/parts/grid_nesting.h"
#include "accel/tests/conformance.h"
#include "accel/tests/two_caveats.h"

namespace rayshoot {
namespace {

constexpr const char* kRecursive = "recursive_grid";

/// Small spheres close together in the corner of a large scene.
Scene crowded_corner(int along_edge) {
  SceneBuilder builder;
  for (int i = 0; i < along_edge * along_edge * along_edge; ++i)
    builder.sphere(
        {0.1 * (i % along_edge), 0.1 * (i / along_edge % along_edge), 0.1 * (i / along_edge / along_edge)},
        0.04);
  builder.sphere({1000, 1000, 1000}, 1);
  return std::move(builder).finish();
}

StructureStats structure(const Geometry<double>& geometry, const Given& given = {}) {
  return build(kRecursive, geometry, given)->structure();
}

/// Of one level it is the uniform grid of that resolution, step by step.
TEST(RecursiveGrid, OfOneLevelIsTheUniformGrid) {
  const Geometry<double> geometry(soup_scene(300));
  const auto rays = nasty::rays(geometry, 1, 200);
  const auto recursive = build(kRecursive, geometry, {{"max_depth", "1"}, {"density", "5"}});
  const auto uniform = build("uniform_grid", geometry, {{"density", "5"}});
  EXPECT_EQ(recursive->structure().references, uniform->structure().references);
  for (const Query query : {Query::closest, Query::any, Query::strict}) {
    const auto ours = counted(*recursive, query, rays), theirs = counted(*uniform, query, rays);
    EXPECT_EQ(ours.hits, theirs.hits);
    EXPECT_EQ(ours.work, theirs.work);
  }
}

/// Jevans 1990, §2: where complexity is local, the uniform grid holds it in one cell.
TEST(RecursiveGrid, DividesTheCrowdedCornerOfALargeScene) {
  const Geometry<double> geometry(crowded_corner(10));
  Ray<double> ray{.origin = {-1, 0.45, 0.42}, .direction = {1, 0, 0}};
  const auto tests = [&](const char* id) {
    return counted(*build(id, geometry), Query::closest, {ray}).work.object_tests;
  };
  EXPECT_EQ(tests("uniform_grid"), 1000u);
  EXPECT_LT(tests(kRecursive), 50u);
  EXPECT_GT(structure(geometry).max_depth, 1u);
}

TEST(RecursiveGrid, LeavesNoCellWithMoreObjectsThanAllowed) {
  const Geometry<double> geometry(crowded_corner(8));
  for (const std::uint32_t max_objects : {2u, 5u, 20u}) {
    NestingRules rules;
    rules.max_objects = max_objects;
    rules.max_depth = 10;
    rules.nested_density = 8;
    std::vector<std::uint32_t> all(geometry.size());
    for (std::uint32_t i = 0; i < geometry.size(); ++i) all[i] = i;
    NestedGrids<double> grids(geometry.size());
    const std::uint32_t root = GridNesting<double>(geometry, rules, grids).outermost(geometry.bounds(), all);
    for (std::uint32_t grid = geometry.size(); grid <= root; ++grid)
      for (std::uint64_t cell = 0; cell < grids[grid].planes.cells(); ++cell)
        EXPECT_LE(grids[grid].cells.objects(cell).size(), max_objects);
  }
}

TEST(RecursiveGrid, IsNoDeeperThanAllowed) {
  const Geometry<double> geometry(crowded_corner(8));
  for (const std::uint64_t depth : {1u, 2u, 3u})
    EXPECT_EQ(structure(geometry, {{"max_depth", std::to_string(depth)}, {"max_objects", "1"}}).max_depth,
              depth);
}

/// Copies of one object cannot be told apart by any grid.
TEST(RecursiveGrid, DoesNotDivideWhatNoGridSeparates) {
  SceneBuilder builder;
  for (int i = 0; i < 100; ++i) builder.sphere({1, 2, 3}, 1);
  const StructureStats stats = structure(Geometry<double>(std::move(builder).finish()));
  EXPECT_EQ(stats.leaves, 1u);
  EXPECT_EQ(stats.references, 100u);
}

/// Long thin objects across the whole scene, each in nearly every cell of every grid.
TEST(RecursiveGrid, KeepsItsReferencesWithinBounds) {
  SceneBuilder builder;
  for (int i = 0; i < 400; ++i) builder.triangle({0, 0, 0.001 * i}, {10, 10, 10}, {10, 10 - 0.001 * i, 10});
  const Geometry<double> geometry(std::move(builder).finish());
  const StructureStats stats =
      structure(geometry, {{"max_objects", "1"}, {"max_depth", "16"}, {"nested_density", "100"}});
  EXPECT_LE(stats.references, 400u * 256);
}

/// The box of the caveats in eight cells; that in which the ray begins, with three objects, in eight more.
const Given kTwoLevels{
    {"density", "2"}, {"nested_density", "2.667"}, {"max_objects", "1"}, {"max_depth", "2"}};

TEST(RecursiveGrid, TestsAnObjectOnceARay) {
  caveats::check_repeated_tests(kRecursive, kTwoLevels);
  caveats::check_mailbox_changes_no_answer(kRecursive, {{"max_objects", "2"}});
}

TEST(RecursiveGrid, GoesOnWhereAHitLiesBeyondTheVoxel) {
  caveats::check_hit_beyond_the_voxel(kRecursive, kTwoLevels, 3);
}

}  // namespace
}  // namespace rayshoot
