// What makes hug that technique: filtering by size, clustering by closeness, and a hierarchy of the clusters' grids.
#include "accel/tests/conformance.h"
#include "accel/tests/two_caveats.h"

namespace rayshoot {
namespace {

constexpr const char* kHug = "hug";

double grids(const Scene& scene, const Given& given) {
  const Geometry<double> geometry(scene);
  return build(kHug, geometry, given)->structure().figures.at("grids");
}

/// A row of spheres of radius 1 along x, whose boxes are `gap` apart.
void row(SceneBuilder& builder, double start, double gap, int spheres) {
  for (int i = 0; i < spheres; ++i) builder.sphere({start + i * (2 + gap), 0, 0}, 1);
}

/// Two rows of ten spheres each that touch, 10 apart.
Scene two_rows(double gap) {
  SceneBuilder builder;
  row(builder, 0, gap, 10);
  row(builder, 30, gap, 10);
  return std::move(builder).finish();
}

/// With the grid of the scene there is one for each cluster.
TEST(Hug, GivesEachClusterAGrid) {
  EXPECT_EQ(grids(two_rows(0), {}), 3);
  EXPECT_EQ(grids(two_rows(0), {{"min_cluster", "11"}}), 1) << "too few objects for a grid";
}

/// The diagonal of a sphere's box is 3.46.
TEST(Hug, ConnectivitySaysWhatIsClose) {
  EXPECT_EQ(grids(two_rows(0.3), {}), 1) << "no sphere is close to another";
  EXPECT_EQ(grids(two_rows(0.3), {{"connectivity", "0.05"}}), 3) << "0.35 is more than the gap";
  EXPECT_EQ(grids(two_rows(0), {{"connectivity", "-0.05"}}), 1) << "to touch is not to overlap";
  EXPECT_EQ(grids(two_rows(-0.5), {{"connectivity", "-0.05"}}), 3) << "they overlap by more than 0.35";
  EXPECT_EQ(grids(two_rows(0), {{"connectivity", "3"}}), 2) << "both rows are one cluster";
}

/// A row of small spheres inside a row of large ones.
Scene small_within_large() {
  SceneBuilder builder;
  row(builder, 0, 0, 10);
  for (int i = 0; i < 10; ++i) builder.sphere({8 + 0.02 * i, 0, 0}, 0.01);
  return std::move(builder).finish();
}

TEST(Hug, FiltersObjectsBySize) {
  EXPECT_EQ(grids(small_within_large(), {{"levels", "1"}}), 2) << "one cluster";
  EXPECT_EQ(grids(small_within_large(), {{"levels", "2"}}), 3) << "one of large and one of small spheres";
}

/// The small spheres' grid is listed in that of the large ones, which holds it, and this in the scene's.
TEST(Hug, ListsAGridInTheSmallestThatHoldsIt) {
  const Geometry<double> geometry(small_within_large());
  EXPECT_EQ(build(kHug, geometry, {})->structure().max_depth, 3u);
}

/// The small spheres' cluster reaches out of that of the large ones, and both are listed in the scene's grid.
TEST(Hug, ListsAGridBesideOneThatDoesNotHoldIt) {
  SceneBuilder builder;
  row(builder, 0, 0, 10);
  for (int i = 0; i < 10; ++i) builder.sphere({8, 0.9 + 0.02 * i, 0}, 0.01);
  const Geometry<double> geometry(std::move(builder).finish());
  const StructureStats stats = build(kHug, geometry, {})->structure();
  EXPECT_EQ(stats.figures.at("grids"), 3);
  EXPECT_EQ(stats.max_depth, 2u);
}

/// The row is 20 long, and each of its spheres is in one or two cells of its grid; the scene's grid lists the row's in
/// several cells, but a ray along it walks through it once.
TEST(Hug, WalksAGridOnceARay) {
  SceneBuilder builder;
  row(builder, 0, 0, 10);
  builder.sphere({0, 40, 0}, 0.5);
  builder.sphere({60, 0, 0}, 0.5);
  const Geometry<double> geometry(std::move(builder).finish());
  const auto engine = build(kHug, geometry, {{"density", "100"}, {"mailbox", "off"}});
  const Ray<double> above{.origin = {-5, 0.99, 0.99}, .direction = {1, 0, 0}};
  const Work work = counted(*engine, Query::closest, {above}).work;
  EXPECT_EQ(work.events[0], 1u) << "grids entered";
  EXPECT_GT(work.events[1], 0u) << "grids met again";
}

/// Long thin triangles across the whole cluster, each in nearly every cell of its grid.
TEST(Hug, KeepsItsReferencesWithinBounds) {
  SceneBuilder builder;
  for (int i = 0; i < 2000; ++i) builder.triangle({0, 0, 0.001 * i}, {10, 10, 10}, {10, 10 - 0.001 * i, 10});
  const Geometry<double> geometry(std::move(builder).finish());
  EXPECT_LE(build(kHug, geometry, {{"density", "100"}})->structure().references, 2000u * 256);
}

/// One level, and everything in one cluster: the scene's grid of a single cell lists one grid of 4x4x4.
const Given kOneCluster{{"levels", "1"}, {"connectivity", "4"}, {"min_cluster", "1"}, {"density", "16"}};

TEST(Hug, TestsAnObjectOnceARay) {
  caveats::check_repeated_tests(kHug, kOneCluster);
  caveats::check_mailbox_changes_no_answer(kHug, {});
}

TEST(Hug, GoesOnWhereAHitLiesBeyondTheVoxel) { caveats::check_hit_beyond_the_voxel(kHug, kOneCluster, 4); }

}  // namespace
}  // namespace rayshoot
