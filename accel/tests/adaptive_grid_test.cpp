// What makes adaptive_grid that technique: grids for the clusters that a hierarchy finds, and orphans beside them.
#include "accel/tests/conformance.h"
#include "accel/tests/two_caveats.h"

namespace rayshoot {
namespace {

constexpr const char* kAdaptive = "adaptive_grid";

/// A cube of 6^3 spheres of radius 0.4 around every place, a unit apart.
void cube(SceneBuilder& builder, const Vec3d& corner) {
  for (int i = 0; i < 216; ++i)
    builder.sphere(corner + Vec3d{1.0 * (i % 6), 1.0 * (i / 6 % 6), 1.0 * (i / 36)}, 0.4);
}

Scene two_cubes() {
  SceneBuilder builder;
  cube(builder, {0, 0, 0});
  cube(builder, {1000, 0, 0});
  return std::move(builder).finish();
}

double figure(const Scene& scene, const char* name, const Given& given = {}) {
  const Geometry<double> geometry(scene);
  return build(kAdaptive, geometry, given)->structure().figures.at(name);
}

/// Clusters that are given nothing for merging stay single objects, each an orphan: the hierarchy is all there is.
TEST(AdaptiveGrid, WithoutMergingIsABoundingVolumeHierarchy) {
  const Geometry<double> geometry(soup_scene(300));
  const auto rays = nasty::rays(geometry, 1, 200);
  const auto ours = build(kAdaptive, geometry, {{"merge", "0"}});
  const auto hierarchy = build("bvh_sah", geometry, {{"max_objects", "1"}, {"traversal_cost", "0"}});
  EXPECT_EQ(ours->structure().figures.at("grids"), 0);
  for (const Query query : {Query::closest, Query::any, Query::strict}) {
    const Work adaptive = counted(*ours, query, rays).work, bvh = counted(*hierarchy, query, rays).work;
    EXPECT_EQ(adaptive.object_tests, bvh.object_tests);
    EXPECT_EQ(adaptive.volume_tests, bvh.volume_tests);
  }
}

TEST(AdaptiveGrid, OfOneClusterIsARecursiveGrid) {
  const Geometry<double> geometry(soup_scene(300));
  const auto rays = nasty::rays(geometry, 1, 200);
  const auto ours = build(kAdaptive, geometry, {{"merge", "100"}, {"max_area", "1"}});
  const auto recursive = build("recursive_grid", geometry);
  EXPECT_EQ(ours->structure().references, recursive->structure().references);
  for (const Query query : {Query::closest, Query::any, Query::strict}) {
    const Work adaptive = counted(*ours, query, rays).work, grid = counted(*recursive, query, rays).work;
    EXPECT_EQ(adaptive.object_tests, grid.object_tests);
    EXPECT_EQ(adaptive.cells, grid.cells);
  }
}

/// The space between the clusters has no cells: the ray takes the two steps of the hierarchy and those of a grid.
TEST(AdaptiveGrid, GivesEachClusterAGrid) {
  const Given of_one_level = {{"max_depth", "1"}};
  EXPECT_EQ(figure(two_cubes(), "grids", of_one_level), 2);
  EXPECT_EQ(figure(two_cubes(), "orphans", of_one_level), 0);
  EXPECT_EQ(figure(two_cubes(), "hierarchy_nodes", of_one_level), 3);
  const Geometry<double> geometry(two_cubes());
  const Ray<double> between{.origin = {500, -10, 3}, .direction = {0, 1, 0}};
  EXPECT_EQ(counted(*build(kAdaptive, geometry), Query::closest, {between}).work.cells, 0u);
  EXPECT_GT(counted(*build("uniform_grid", geometry), Query::closest, {between}).work.cells, 0u);
}

/// A wall as large as the cube behind it would be in many of the cells of its grid.
Scene cube_with_walls() {
  SceneBuilder builder;
  cube(builder, {0, 0, 0});
  builder.polygon(
      std::array{Vec3d{-0.4, -0.4, 2.5}, Vec3d{5.4, -0.4, 2.5}, Vec3d{5.4, 5.4, 2.5}, Vec3d{-0.4, 5.4, 2.5}});
  builder.polygon(
      std::array{Vec3d{-0.4, -0.4, 3.5}, Vec3d{5.4, -0.4, 3.5}, Vec3d{5.4, 5.4, 3.5}, Vec3d{-0.4, 5.4, 3.5}});
  return std::move(builder).finish();
}

TEST(AdaptiveGrid, TestsObjectsThatAreLargeInTheirClusterByThemselves) {
  const Given one_cluster = {{"merge", "100"}, {"max_depth", "1"}};
  EXPECT_EQ(figure(cube_with_walls(), "orphans", one_cluster), 2);
  EXPECT_EQ(figure(cube_with_walls(), "grids", one_cluster), 1);
  EXPECT_EQ(figure(cube_with_walls(), "orphans", {{"merge", "100"}, {"max_area", "1"}}), 0);
  EXPECT_EQ(figure(cube_with_walls(), "grids", {{"merge", "100"}, {"max_depth", "1"}, {"orphans", "grid"}}),
            2);
}

/// One cluster in a grid of 4x4x4.
const Given kOneGrid{{"merge", "100"}, {"max_area", "1"}, {"density", "16"}, {"max_depth", "1"}};

TEST(AdaptiveGrid, TestsAnObjectOnceARay) {
  caveats::check_repeated_tests(kAdaptive, kOneGrid);
  caveats::check_mailbox_changes_no_answer(kAdaptive, {{"merge", "4"}, {"max_area", "1"}});
}

TEST(AdaptiveGrid, GoesOnWhereAHitLiesBeyondTheVoxel) {
  caveats::check_hit_beyond_the_voxel(kAdaptive, kOneGrid, 4);
}

}  // namespace
}  // namespace rayshoot
