// What makes bsp_kaplan and bsp_jansen those techniques: one tree that halves x, y and z in turn, and the same leaves on
// every ray, found by locating points or by clipping the ray.
#include "accel/bsp/bsp_jansen.cpp"
#include "accel/bsp/bsp_kaplan.cpp"
#include "accel/tests/conformance.h"
#include "accel/tests/leaf_sequence.h"
#include "accel/tests/two_caveats.h"

namespace rayshoot {
namespace {

using Node = AxisTree<double>::Node;

constexpr BspConfig kFine{.max_depth = 15, .max_objects = 2};

/// Calls visit(node, depth) for all nodes.
template <class Visit>
void for_each_node(const Node& node, int depth, const Visit& visit) {
  visit(node, depth);
  if (node.is_leaf()) return;
  for_each_node(*(&node + 1), depth + 1, visit);
  for_each_node(*(&node + node.upper()), depth + 1, visit);
}

/// The cell of a node: those of the lower subtree lie before those of the upper one.
Box<double> cell_of(const AxisTree<double>& tree, const Node& of) {
  Box<double> cell = tree.box;
  for (const Node* node = tree.nodes.data(); node != &of;) {
    const Node* upper = node + node->upper();
    const bool above = &of >= upper;
    (above ? cell.lo : cell.hi)[node->axis()] = node->plane();
    node = above ? upper : node + 1;
  }
  return cell;
}

TEST(BspTree, HalvesItsCellsAlongXYAndZInTurn) {
  const Geometry<double> geometry(soup_scene(200));
  const AxisTree<double> tree = build_bsp(geometry, kFine);
  int interior = 0;
  for_each_node(tree.nodes[0], 0, [&](const Node& node, int depth) {
    if (node.is_leaf()) return;
    ++interior;
    EXPECT_EQ(node.axis(), depth % 3);
    EXPECT_EQ(node.plane(), cell_of(tree, node).centre()[node.axis()]);
  });
  EXPECT_GT(interior, 500);
}

TEST(BspTree, ListsAnObjectInEveryLeafThatItsBoundsTouch) {
  const Geometry<double> geometry(soup_scene(200));
  const AxisTree<double> tree = build_bsp(geometry, kFine);
  for_each_node(tree.nodes[0], 0, [&](const Node& node, int) {
    if (!node.is_leaf()) return;
    std::vector<std::uint32_t> touching;
    for (std::uint32_t object = 0; object < geometry.size(); ++object)
      if (geometry.bounds(object).overlaps(cell_of(tree, node))) touching.push_back(object);
    const auto listed = tree.objects(node);
    EXPECT_TRUE(std::equal(listed.begin(), listed.end(), touching.begin(), touching.end()));
  });
}

TEST(BspTree, EndsWhereDivisionSeparatesNothing) {
  SceneBuilder builder;
  for (int i = 0; i < 100; ++i) builder.sphere({1, 2, 3}, 1);
  const Geometry<double> geometry(std::move(builder).finish());
  EXPECT_EQ(build("bsp_jansen", geometry)->structure().max_depth, 3u);
}

/// Rays through the middles of cells, their edges and corners, besides those of the conformance tests.
std::vector<Ray<double>> rays_through(const Geometry<double>& geometry) {
  return octrees::rays_through(geometry, Lattice<double>::over(geometry.bounds(), 4));
}

TEST(BspTree, BothTraversalsVisitTheSameLeavesInTheSameOrder) {
  const Geometry<double> geometry(soup_scene(200));
  const auto kaplan = BspKaplan<double>::build({geometry}, kFine);
  const auto jansen = BspJansen<double>::build({geometry}, kFine);
  std::size_t leaves = 0;
  for (const Ray<double>& ray : rays_through(geometry)) {
    const auto clipped = octrees::visited_by(jansen, ray);
    ASSERT_EQ(octrees::visited_by(kaplan, ray), clipped) << conformance::describe(ray);
    leaves += clipped.size();
  }
  EXPECT_GT(leaves, 5000u);
}

/// The leaves of a ray that crosses no edge are those whose cells it passes, near to far.
TEST(BspTree, VisitsExactlyTheLeavesThatTheRayPasses) {
  const Geometry<double> geometry(soup_scene(200));
  const AxisTree<double> tree = build_bsp(geometry, kFine);
  const auto jansen = BspJansen<double>::build({geometry}, kFine);
  const Vec3d size = geometry.bounds().extent();
  for (int i = 0; i < 100; ++i) {
    const Vec3d start =
        geometry.bounds().lo + Vec3d{-0.1, size.y * (0.013 + 0.0097 * i), size.z * (0.97 - 0.0091 * i)};
    const Ray<double> ray{.origin = start, .direction = {1, 0.1 - 0.0017 * i, 0.023 * (i % 7) - 0.07}};
    std::vector<std::pair<double, octrees::Objects>> passed;
    for_each_node(tree.nodes[0], 0, [&](const Node& node, int) {
      if (!node.is_leaf()) return;
      const Interval<double> inside = interval_inside(cell_of(tree, node), ray);
      if (inside.enter <= inside.exit)
        passed.emplace_back(inside.enter,
                            octrees::Objects(tree.objects(node).begin(), tree.objects(node).end()));
    });
    std::stable_sort(passed.begin(), passed.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<octrees::Objects> expected;
    for (auto& [enter, objects] : passed) expected.push_back(objects);
    ASSERT_EQ(octrees::visited_by(jansen, ray), expected) << conformance::describe(ray);
  }
}

/// An even tree of depth 6: a ray along x passes 4 leaves.
Geometry<double> even() {
  SceneBuilder builder;
  for (int i = 0; i < 64; ++i) builder.sphere({0.5 + i % 4, 0.5 + i / 4 % 4, 0.5 + i / 16}, 0.45);
  builder.sphere({0.01, 0.01, 0.01}, 0.01), builder.sphere({3.99, 3.99, 3.99}, 0.01);
  return Geometry<double>(std::move(builder).finish());
}

Work along_x(const char* id) {
  const Geometry<double> geometry = even();
  const Ray<double> ray{.origin = {-1, 0.48, 0.48}, .direction = {1, 0, 0}};
  return counted(*build(id, geometry, {{"max_depth", "6"}, {"max_objects", "1"}}), Query::strict, {ray}).work;
}

TEST(BspKaplan, GoesTheWholeWayFromTheRootForEveryLeaf) {
  const Work work = along_x("bsp_kaplan");
  EXPECT_EQ(work.cells, 4u);
  EXPECT_EQ(work.steps, 4u * 7) << "six interior nodes and a leaf";
  EXPECT_EQ(work.events[0], 4u) << "points located";
  EXPECT_EQ(work.events[1], 0u) << "rays clipped";
}

TEST(BspJansen, PassesEveryNodeOnce) {
  const Work work = along_x("bsp_jansen");
  EXPECT_EQ(work.cells, 4u);
  EXPECT_EQ(work.steps, 1u + 2 * 2 + 2 + 4 * 3)
      << "on x; on y and z in both halves; on x; on y and z to four leaves";
}

TEST(BspTree, TestsAnObjectOnceARayAndGoesOnBehindAHitBeyondTheVoxel) {
  for (const char* id : {"bsp_kaplan", "bsp_jansen"}) {
    SCOPED_TRACE(id);
    caveats::check_repeated_tests(id, {{"max_depth", "6"}, {"max_objects", "1"}});
    caveats::check_mailbox_changes_no_answer(id, {});
    caveats::check_hit_beyond_the_voxel(id, {{"max_depth", "6"}, {"max_objects", "1"}}, 3);
  }
}

}  // namespace
}  // namespace rayshoot
