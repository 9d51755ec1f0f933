// What makes octree_glassner that technique: names, hashing, surfaces, and the walk from point to point. The file itself
// is part of the test, for its table of nodes and its voxels, which nobody else sees.
#include "accel/octree/octree_glassner.cpp"

#include "accel/tests/conformance.h"
#include "accel/tests/leaf_sequence.h"
#include "accel/tests/two_caveats.h"

namespace rayshoot {
namespace {

using ::testing::Contains;
using ::testing::Not;

constexpr const char* kOctree = "octree_glassner";

/// A node of an octree where it stands, named as the paper says: in digits, each octant's behind its parent's.
struct Place {
  std::string name;
  const Octree<double>::Node* node;
  LatticeCell cell;
};

std::vector<Place> places(const Octree<double>& octree) {
  std::vector<Place> all{{"1", &octree.nodes[0], octree.lattice.whole()}};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Place parent = all[i];
    if (!parent.node->interior()) continue;
    for (unsigned octant = 0; octant < 8; ++octant)
      all.push_back({parent.name + std::string("12345678")[octant],
                     &octree.nodes[parent.node->first + octant],
                     parent.cell.child(octant, parent.cell.centre())});
  }
  return all;
}

NodeTable::Name number(const std::string& name) { return std::stoull(name); }

/// An octree over a soup that has leaves of several sizes, empty ones among them.
Octree<double> soup_octree(int max_depth, Assignment assignment = Assignment::surface) {
  const Geometry<double> geometry(soup_scene(200));
  return build_octree(geometry, {.max_depth = max_depth, .max_objects = 2, .assignment = assignment});
}

TEST(OctreeNames, AppendTheDigitOfTheOctantToTheParent) {
  EXPECT_EQ(NodeTable::kRoot, 1u);
  EXPECT_EQ(NodeTable::child(NodeTable::kRoot, 0), 11u);
  EXPECT_EQ(NodeTable::child(NodeTable::kRoot, 7), 18u);
  EXPECT_EQ(NodeTable::child(18, 2), 183u);
  NodeTable::Name deepest = NodeTable::kRoot;
  for (int depth = 0; depth < kMaxOctreeDepth; ++depth) deepest = NodeTable::child(deepest, 7);
  EXPECT_EQ(std::to_string(deepest), "1" + std::string(kMaxOctreeDepth, '8')) << "fits 64 bits";
}

TEST(OctreeNames, LeadToExactlyTheNodesThatAreNotEmpty) {
  const Octree<double> octree = soup_octree(5);
  const NodeTable table = named(octree);
  std::size_t kept = 0, left_out = 0;
  for (const Place& place : places(octree)) {
    const NodeTable::Node* found = table.find(number(place.name));
    ASSERT_EQ(found != nullptr, place.node->count > 0) << place.name;
    if (!found) {
      ++left_out;
      continue;
    }
    ++kept;
    EXPECT_EQ(found->name, number(place.name));
    EXPECT_EQ(found->interior(), place.node->interior());
    EXPECT_EQ(found->count, place.node->count);
    if (!place.node->interior()) {
      EXPECT_EQ(found->first, place.node->first) << place.name;
    }
  }
  EXPECT_EQ(table.nodes().size(), kept);
  EXPECT_GT(left_out, 100u) << "the scene has voids";
}

TEST(OctreeNames, ThatNobodyHasLeadNowhere) {
  const Octree<double> octree = soup_octree(5);
  const NodeTable table = named(octree);
  for (const Place& place : places(octree)) {
    EXPECT_FALSE(table.find(number(place.name + "9")));
    EXPECT_FALSE(table.find(number(place.name + "0")));
    if (place.node->interior()) continue;
    EXPECT_FALSE(table.find(number(place.name + "1"))) << "below a leaf";
  }
  for (const NodeTable::Name name : {0ull, 2ull, 10ull, 19ull, ~0ull}) EXPECT_FALSE(table.find(name)) << name;
  EXPECT_FALSE(NodeTable().find(NodeTable::kRoot)) << "nothing is in a table without nodes";
}

/// A ball, number 0, and crumbs inside of it.
Scene stuffed_ball() {
  SceneBuilder builder;
  nasty::Random random(6);
  builder.sphere({0, 0, 0}, 1);
  for (int i = 0; i < 60; ++i) builder.sphere(nasty::uniform_point(random, -0.5, 0.5), 0.01);
  return std::move(builder).finish();
}

TEST(OctreeGlassner, ListsASurfaceWhereItPenetratesAndNotInsideOfABall) {
  const Geometry<double> geometry(stuffed_ball());
  const auto engine = [&](const char* assignment) {
    return build(kOctree, geometry, {{"max_objects", "1"}, {"max_depth", "5"}, {"assignment", assignment}});
  };
  const auto surface = engine("surface"), box = engine("box");
  EXPECT_LT(surface->structure().references, box->structure().references);
  const Ray<double> inside{.origin = {-0.2, -0.2, -0.2}, .direction = {1, 1, 1}, .t_max = 0.4};
  EXPECT_THAT(candidates(*surface, Query::strict, inside), Not(Contains(0u)));
  EXPECT_THAT(candidates(*box, Query::strict, inside), Contains(0u));
}

TEST(OctreeGlassner, EveryAssignmentAndLimitEqualsExhaustiveSearch) {
  for (const Scene& scene : {stuffed_ball(), soup_scene(150)}) {
    const Geometry<double> geometry(scene);
    const auto rays = nasty::rays(geometry, 1, 100);
    const auto truths = conformance::truths<double>(geometry, rays);
    for (const char* assignment : {"surface", "box"})
      for (const char* depth : {"1", "2", "6"})
        for (const char* objects : {"1", "5", "1000"}) {
          const Given given{{"assignment", assignment}, {"max_depth", depth}, {"max_objects", objects}};
          conformance::check_engine<double>(*build(kOctree, geometry, given), rays, truths);
        }
  }
}

TEST(OctreeGlassner, DividesAVoxelWithTooManyObjectsUntilItIsAsDeepAsAllowed) {
  const Geometry<double> geometry(soup_scene(400));
  for (const int depth : {1, 3, 5})
    for (const std::uint32_t objects : {1u, 4u, 20u}) {
      const Octree<double> octree = build_octree(geometry, {.max_depth = depth, .max_objects = objects});
      EXPECT_LE(octree.depth, depth);
      for (const Place& place : places(octree))
        if (!place.node->interior() && place.node->count > objects) {
          EXPECT_EQ(place.name.size(), 1u + depth) << place.name << " could have been divided";
        }
      const StructureStats stats =
          build(kOctree, geometry,
                {{"max_depth", std::to_string(depth)}, {"max_objects", std::to_string(objects)}})
              ->structure();
      EXPECT_EQ(stats.nodes, octree.nodes.size());
      EXPECT_EQ(stats.references, octree.references.size());
      EXPECT_EQ(stats.max_depth, static_cast<std::uint64_t>(octree.depth));
    }
}

TEST(OctreeGlassner, DoesNotDivideWhatHasFewObjects) {
  const Geometry<double> geometry(soup_scene(400));
  const Octree<double> octree = build_octree(geometry, {.max_depth = 6, .max_objects = 10});
  for (const Place& place : places(octree)) {
    if (!place.node->interior()) continue;
    std::set<std::uint32_t> below;
    for (const Place& leaf : places(octree))
      if (!leaf.node->interior() && leaf.name.starts_with(place.name))
        below.insert(octree.objects(*leaf.node).begin(), octree.objects(*leaf.node).end());
    EXPECT_GT(below.size(), 10u) << place.name;
  }
}

TEST(OctreeGlassner, EndsDivisionThatSeparatesNothing) {
  SceneBuilder builder;
  for (int i = 0; i < 50; ++i) builder.sphere({0, 0, 0}, 1);
  const Geometry<double> geometry(std::move(builder).finish());
  const StructureStats stats =
      build(kOctree, geometry, {{"max_depth", "18"}, {"assignment", "box"}})->structure();
  EXPECT_LE(stats.max_depth, 1u) << "every voxel lies in all bounds";
}

/// Coincident squares of which every level of four times as many voxels lists all: the fifth, with 20 million
/// references, would be beyond 64 an object and 2^24.
TEST(OctreeGlassner, EndsDivisionThatTakesTooMuchStorage) {
  SceneBuilder builder;
  for (int i = 0; i < 20'000; ++i) nasty::square(builder, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const Geometry<double> geometry(std::move(builder).finish());
  const StructureStats stats =
      build(kOctree, geometry, {{"max_depth", "18"}, {"assignment", "box"}})->structure();
  EXPECT_EQ(stats.max_depth, 4u);
  EXPECT_EQ(stats.references, 4u * 4 * 4 * 4 * 20'000);
}

/// The names of the voxels on a ray that begin within `reach`.
template <class Counter>
std::vector<std::string> names_on(const OctreeGlassner<double>& technique, const Ray<double>& ray,
                                  double reach, Counter count) {
  std::vector<std::string> names;
  technique.visit_voxels(
      ray, count, [&] { return reach; },
      [&](const OctreeGlassner<double>::Voxel& voxel) {
        names.push_back(std::to_string(voxel.node.name));
        return false;
      });
  return names;
}

/// A leaf that a ray passes, by a computation of its own.
struct Passed {
  std::string name;
  double enter, exit;
};

/// All leaves whose interval on the ray is longer than `length`, near to far.
std::vector<Passed> passed(const Octree<double>& octree, const Ray<double>& ray, double length) {
  std::vector<Passed> passed;
  for (const Place& place : places(octree)) {
    if (place.node->interior()) continue;
    const Box<double> box = octree.lattice.cell(place.cell);
    double enter = ray.t_min, exit = ray.t_max;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (box.lo[axis] - ray.origin[axis]) / ray.direction[axis];
      const double b = (box.hi[axis] - ray.origin[axis]) / ray.direction[axis];
      enter = std::max(enter, std::min(a, b)), exit = std::min(exit, std::max(a, b));
    }
    if (exit - enter > length) passed.push_back({place.name, enter, exit});
  }
  std::sort(passed.begin(), passed.end(), [](const Passed& a, const Passed& b) { return a.enter < b.enter; });
  return passed;
}

std::vector<std::string> names_of(const std::vector<Passed>& passed) {
  std::vector<std::string> names;
  for (const Passed& leaf : passed) names.push_back(leaf.name);
  return names;
}

/// A technique and the same octree, whose leaves are known.
struct SoupTechnique {
  Geometry<double> geometry{soup_scene(200)};
  OctreeLimits limits{.max_depth = 5, .max_objects = 2};
  Octree<double> octree = build_octree(geometry, limits);
  OctreeGlassner<double> technique = OctreeGlassner<double>::build({geometry}, {.limits = limits});
};

/// Rays in general position, from inside and from outside of the scene, in all directions.
std::vector<Ray<double>> random_rays(int count) {
  nasty::Random random(4);
  std::vector<Ray<double>> rays;
  for (int i = 0; i < count; ++i) {
    rays.push_back({.origin = nasty::uniform_point(random, -9, 9)});
    rays.back().direction = nasty::uniform_point(random, -4, 4) - rays.back().origin;
    if (i % 3 == 0) rays.back().t_min = 0.3;
    if (i % 4 == 0) rays.back().t_max = 1.1;
  }
  return rays;
}

/// Leaves that a ray touches in hardly more than a point may be visited or not, at any time.
TEST(OctreeWalk, MeetsTheLeavesOnTheRayInTheirOrder) {
  constexpr double hardly = 1e-9;
  const SoupTechnique soup;
  std::size_t leaves = 0, touched = 0;
  for (const Ray<double>& ray : random_rays(500)) {
    std::vector<std::string> visited = names_on(soup.technique, ray, ray.t_max, NoCount{});
    const auto expected = names_of(passed(soup.octree, ray, hardly));
    const auto possible = names_of(passed(soup.octree, ray, -hardly));
    const auto all = visited.size();
    std::erase_if(visited, [&](const std::string& name) {
      EXPECT_THAT(possible, Contains(name));
      return std::find(expected.begin(), expected.end(), name) == expected.end();
    });
    ASSERT_EQ(visited, expected) << conformance::describe(ray);
    leaves += expected.size(), touched += all - expected.size();
  }
  EXPECT_GT(leaves, 1000u);
  EXPECT_LT(touched, 5u);
}

/// From the root to the voxel of every point: as many look-ups as its name has digits.
TEST(OctreeWalk, TakesAStepForEveryNameOnTheWayFromTheRoot) {
  const SoupTechnique soup;
  for (const Ray<double>& ray : random_rays(200)) {
    Work work;
    const std::vector<std::string> visited = names_on(soup.technique, ray, ray.t_max, Count(work));
    std::size_t digits = 0;
    for (const std::string& name : visited) digits += name.size();
    ASSERT_EQ(work.steps, digits) << conformance::describe(ray);
  }
}

TEST(OctreeWalk, EndsAtTheReach) {
  const SoupTechnique soup;
  for (const Ray<double>& ray : random_rays(200)) {
    const std::vector<std::string> visited = names_on(soup.technique, ray, 0.5, NoCount{});
    Ray<double> shorter = ray;
    shorter.t_max = 0.5;
    ASSERT_EQ(visited, names_of(passed(soup.octree, shorter, 0)));
  }
}

TEST(OctreeCaveats, AnObjectIsTestedOnceForARay) {
  caveats::check_repeated_tests(kOctree, {{"max_depth", "2"}, {"max_objects", "1"}});
  caveats::check_mailbox_changes_no_answer(kOctree, {});
}

TEST(OctreeGlassner, VisitsTheLeavesInTheOrderOfAllOctrees) {
  octrees::check_leaves_in_order<OctreeGlassner<double>>();
}

TEST(OctreeCaveats, AHitBeyondTheVoxelDoesNotEndTheWalk) {
  caveats::check_hit_beyond_the_voxel(kOctree, {{"max_depth", "2"}, {"max_objects", "1"}}, 3);
}

}  // namespace
}  // namespace rayshoot
