// What makes kd_tree that technique: the cheapest plane, found by sweeping sorted ends; empty space cut off; clipped objects.
#include <random>

#include "accel/parts/clipped_bounds.h"
#include "accel/parts/kd_build.h"
#include "accel/tests/conformance.h"
#include "accel/tests/two_caveats.h"

namespace rayshoot {
namespace {

constexpr const char* kTree = "kd_tree";

std::vector<Box<double>> random_boxes(int count, std::mt19937& random) {
  // Few different coordinates, so that ends, beginnings and flat boxes share planes.
  std::uniform_int_distribution<int> coordinate(0, 12), size(0, 3);
  std::vector<Box<double>> boxes(static_cast<std::size_t>(count));
  for (Box<double>& box : boxes)
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = coordinate(random);
      box.hi[axis] = box.lo[axis] + size(random);
    }
  return boxes;
}

/// The least cost over all planes, from counting all boxes anew for each.
double least_cost(const Box<double>& cell, const std::vector<Box<double>>& boxes, const KdRules& rules) {
  double least = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    for (const Box<double>& at : boxes)
      for (const double plane : {at.lo[axis], at.hi[axis]}) {
        if (!(cell.lo[axis] < plane && plane < cell.hi[axis])) continue;
        Box<double> lower = cell, upper = cell;
        lower.hi[axis] = upper.lo[axis] = plane;
        int below = 0, above = 0, flat = 0;
        for (const Box<double>& box : boxes)
          if (box.lo[axis] == plane && box.hi[axis] == plane)
            ++flat;
          else
            below += box.lo[axis]<plane, above += box.hi[axis]> plane;
        for (const auto& [in_lower, in_upper] :
             {std::pair(below + flat, above), std::pair(below, above + flat)}) {
          const double tests =
              (lower.surface_area() * in_lower + upper.surface_area() * in_upper) / cell.surface_area();
          const double bonus = in_lower == 0 || in_upper == 0 ? 1 - rules.empty_bonus : 1;
          least = std::min(least, bonus * (rules.traversal_cost + rules.intersection_cost * tests));
        }
      }
  return least;
}

TEST(KdTree, SweepsToTheCheapestOfAllPlanes) {
  std::mt19937 random(1);
  const Box<double> cell{{0, 0, 0}, {15, 15, 15}};
  for (int trial = 0; trial < 200; ++trial) {
    const auto boxes = random_boxes(1 + trial % 17, random);
    BoundsEvents<double> events;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) add_events(events, boxes[i], i);
    for (auto& along_axis : events) std::sort(along_axis.begin(), along_axis.end());
    const KdRules rules;
    ASSERT_DOUBLE_EQ(best_plane(cell, boxes.size(), events, rules).cost, least_cost(cell, boxes, rules))
        << trial;
  }
}

/// A cluster in one corner of a large box that a single sphere in the other spans.
Scene corners() {
  SceneBuilder builder;
  for (int i = 0; i < 125; ++i) builder.sphere({1.0 * (i % 5), 1.0 * (i / 5 % 5), 1.0 * (i / 25)}, 0.3);
  builder.sphere({100, 100, 100}, 0.3);
  return std::move(builder).finish();
}

TEST(KdTree, CutsEmptySpaceOff) {
  const Geometry<double> geometry(corners());
  const auto engine = build(kTree, geometry, {{"intersection_cost", "1.5"}});
  const Ray<double> through_the_void{.origin = {-10, 50, 50}, .direction = {1, 0.01, 0.01}};
  const Work work = counted(*engine, Query::closest, {through_the_void}).work;
  EXPECT_EQ(work.object_tests, 0u);
  EXPECT_EQ(work.cells, work.empty_cells);
  EXPECT_LE(work.cells, 4u);
}

/// Without a bonus, a plane that only cuts empty space off must pay by itself.
TEST(KdTree, ABonusForEmptySpaceCutsMoreOfItOff) {
  const Geometry<double> geometry(soup_scene(500));
  const auto empty = [&](const char* bonus) {
    return build(kTree, geometry, {{"empty_bonus", bonus}, {"clipped", "off"}})->structure().empty_leaves;
  };
  EXPECT_GT(empty("0.2"), empty("0"));
  EXPECT_GT(empty("0.5"), empty("0.2"));
}

/// Slender triangles along the diagonal, whose boxes are mostly void.
Scene slanted(int triangles) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0, 10);
  SceneBuilder builder;
  for (int i = 0; i < triangles; ++i) {
    const Vec3d base{place(random), place(random), place(random)};
    builder.triangle(base, base + Vec3d{3, 3, 3}, base + Vec3d{3, 3, 3.05});
  }
  return std::move(builder).finish();
}

TEST(KdTree, ClippingTestsFewer) {
  const Geometry<double> geometry(slanted(500));
  std::vector<Ray<double>> rays;
  for (int i = 0; i < 400; ++i)
    rays.push_back({.origin = {-1, 0.5 * (i % 20), 0.5 * (i / 20)}, .direction = {1, 0.1, 0.2}});
  const auto bounds = build(kTree, geometry, {{"clipped", "off"}});
  const auto clipped = build(kTree, geometry, {{"clipped", "on"}});
  const Counted<double> by_bounds = counted(*bounds, Query::closest, rays),
                        by_part = counted(*clipped, Query::closest, rays);
  EXPECT_EQ(by_bounds.hits, by_part.hits);
  EXPECT_LT(by_part.work.object_tests, by_bounds.work.object_tests / 2);
}

TEST(KdTree, BoundsOfAClippedTriangleAreThoseOfItsPart) {
  SceneBuilder builder;
  builder.triangle({0, 0, 0}, {8, 8, 0}, {8, 8, 8});
  const Geometry<double> geometry(std::move(builder).finish());
  const Box<double> part = clipped_bounds(geometry, 0, Box<double>{{2, 0, 0}, {4, 8, 8}}, 0.0);
  EXPECT_NEAR(part.lo.y, 2, 1e-12);
  EXPECT_NEAR(part.hi.y, 4, 1e-12);
  EXPECT_NEAR(part.hi.z, 4, 1e-12);
  EXPECT_TRUE(clipped_bounds(geometry, 0, Box<double>{{2, 5, 0}, {4, 8, 8}}, 0.0).empty());
}

TEST(KdTree, IsNoDeeperThanAllowed) {
  const Geometry<double> geometry(soup_scene(500));
  for (const std::uint64_t depth : {1u, 3u, 6u})
    EXPECT_EQ(build(kTree, geometry, {{"max_depth", std::to_string(depth)}})->structure().max_depth, depth);
}

/// The default depth is 8 + 1.3 log2 n, even where the heuristic would go on.
TEST(KdTree, EndsWhereDivisionDoesNotPay) {
  const Geometry<double> geometry(soup_scene(500));
  const StructureStats cheap = build(kTree, geometry, {{"traversal_cost", "0"}})->structure(),
                       dear = build(kTree, geometry, {{"traversal_cost", "20"}})->structure();
  EXPECT_LT(dear.nodes, cheap.nodes / 2);
  EXPECT_LE(cheap.max_depth, 8 + 1.3 * std::log2(500));
}

const Given kFine{{"traversal_cost", "0"}, {"clipped", "off"}};

TEST(KdTree, TestsAnObjectOnceARay) {
  caveats::check_mailbox_changes_no_answer(kTree, kFine);
  caveats::check_repeated_tests(kTree, kFine);
}

}  // namespace
}  // namespace rayshoot
