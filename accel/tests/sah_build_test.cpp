// What the builder of hierarchies by the surface area heuristic promises, whatever the technique.
#include "accel/parts/sah_build.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <numeric>

#include "accel/tests/built_engine.h"
#include "scenes/io/load_scene.h"

namespace rayshoot {
namespace {

constexpr SahMethod kMethods[] = {SahMethod::binned, SahMethod::fast, SahMethod::sweep, SahMethod::quality};

/// Boxes of very different sizes in a cube, denser towards a corner of it.
template <class Real>
std::vector<BoxedObject<Real>> random_boxes(std::size_t count) {
  nasty::Random random(7);
  std::vector<BoxedObject<Real>> objects(count);
  for (std::uint32_t object = 0; object < count; ++object) {
    Vec3<Real> lo, size;
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = static_cast<Real>(std::pow(nasty::uniform(random, 0, 1), 3));
      size[axis] = static_cast<Real>(0.1 * std::pow(nasty::uniform(random, 0, 1), 6));
    }
    objects[object] = {{lo, lo + size}, object};
  }
  return objects;
}

template <class Real>
struct Built {
  std::vector<BoxedObject<Real>> objects;
  PairTree<Real> tree;
};

template <class Real>
Built<Real> built(std::vector<BoxedObject<Real>> objects, const SahConfig& config) {
  Built<Real> result{.objects = std::move(objects)};
  result.tree = sah_tree<Real>(result.objects, config);
  return result;
}

template <class Real>
Box<Real> box_of(std::span<const BoxedObject<Real>> objects) {
  Box<Real> box;
  for (const BoxedObject<Real>& object : objects) box.include(object.box);
  return box;
}

/// Call visit(node, left, right) with the objects on both sides for all nodes below; returns the objects below.
template <class Real, class Visit>
std::span<const BoxedObject<Real>> walk(const Built<Real>& built, const ChildReference& child, int depth,
                                        const Visit& visit) {
  const std::span<const BoxedObject<Real>> all = built.objects;
  if (child.leaf()) return all.subspan(child.first, child.count);
  const PairNode<Real>& node = built.tree.nodes[child.first];
  const auto left = walk(built, node.child[0], depth + 1, visit);
  const auto right = walk(built, node.child[1], depth + 1, visit);
  EXPECT_EQ(left.data() + left.size(), right.data()) << "objects are in the order of the leaves";
  visit(node, depth, left, right);
  return {left.data(), left.size() + right.size()};
}

template <class Real>
void expect_valid(const Built<Real>& built, std::size_t max_objects) {
  std::size_t nodes = 0;
  const auto below = walk(built, built.tree.root, 0, [&](const auto& node, int depth, auto left, auto right) {
    ++nodes;
    EXPECT_EQ(node.boxes.box(0), box_of(left));
    EXPECT_EQ(node.boxes.box(1), box_of(right));
    EXPECT_LT(depth, kMaxSahDepth);
  });
  EXPECT_EQ(below.size(), built.objects.size());
  EXPECT_EQ(nodes, built.tree.nodes.size()) << "no gaps";
  EXPECT_EQ(built.tree.bounds, box_of(below));
  built.tree.for_each_leaf(
      [&](const auto&, std::uint32_t, std::uint32_t count) { EXPECT_LE(count, max_objects); });
  std::vector<bool> seen(built.objects.size());
  for (const BoxedObject<Real>& object : built.objects) seen[object.object] = true;
  EXPECT_EQ(std::count(seen.begin(), seen.end(), true), std::ssize(built.objects));
}

TEST(SahBuild, BoxesHoldTheObjectsAndEveryObjectHasOnePlace) {
  for (const SahMethod method : kMethods)
    for (const std::size_t max_objects : {1, 4})
      for (const std::size_t count : {1, 2, 3, 31, 32, 33, 600, 5000, 150'000}) {
        SCOPED_TRACE(fmt::format("{} objects, {} a leaf", count, max_objects));
        expect_valid(built(random_boxes<float>(count), {method, max_objects}), max_objects);
        if (count < 10'000)
          expect_valid(built(random_boxes<double>(count), {method, max_objects}), max_objects);
        if (::testing::Test::HasFailure()) return;
      }
}

TEST(SahBuild, NothingMakesAnEmptyTree) {
  for (const SahMethod method : kMethods) EXPECT_TRUE(built<float>({}, {method}).tree.empty());
}

/// The least of S(left) n(left) + S(right) n(right) over all splits between neighbours along an axis.
template <class Real>
double cheapest_split(std::span<const BoxedObject<Real>> objects) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<BoxedObject<Real>> sorted(objects.begin(), objects.end());
  for (int axis = 0; axis < 3; ++axis) {
    std::ranges::sort(sorted, {}, [&](const auto& object) { return object.twice_centre(axis); });
    for (std::size_t left = 1; left < sorted.size(); ++left) {
      const std::span<const BoxedObject<Real>> all = sorted;
      least = std::min(
          least, box_of(all.first(left)).surface_area() * static_cast<double>(left) +
                     box_of(all.subspan(left)).surface_area() * static_cast<double>(sorted.size() - left));
    }
  }
  return least;
}

template <class Real>
void expect_cheapest_splits(std::size_t count, SahMethod method) {
  const Built<Real> tree = built(random_boxes<Real>(count), {method, 1});
  walk(tree, tree.tree.root, 0, [&](const auto& node, int, auto left, auto right) {
    const double cost = node.boxes.box(0).surface_area() * static_cast<double>(left.size()) +
                        node.boxes.box(1).surface_area() * static_cast<double>(right.size());
    const std::span<const BoxedObject<Real>> both(left.data(), left.size() + right.size());
    EXPECT_LE(cost, cheapest_split<Real>(both) * (1 + 1e-12)) << both.size() << " objects";
  });
}

TEST(SahBuild, SweepTakesTheCheapestOfAllSplits) {
  expect_cheapest_splits<float>(300, SahMethod::sweep);
  expect_cheapest_splits<double>(300, SahMethod::sweep);
}

TEST(SahBuild, FewObjectsAreSweptHoweverItIsBuilt) {
  expect_cheapest_splits<float>(32, SahMethod::binned);
  expect_cheapest_splits<double>(32, SahMethod::binned);
}

TEST(SahBuild, TheTreeIsTheSameHoweverManyThreadsThereAre) {
  for (const SahMethod method : kMethods) {
    const std::size_t max_objects = method == SahMethod::fast ? 8 : 1;
    const auto tree = built(random_boxes<float>(200'000), {method, max_objects});
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const auto again = built(random_boxes<float>(200'000), {method, max_objects});
    ASSERT_EQ(tree.tree.nodes.size(), again.tree.nodes.size());
    EXPECT_TRUE(std::ranges::equal(tree.objects, again.objects, {}, &BoxedObject<float>::object,
                                   &BoxedObject<float>::object));
    EXPECT_EQ(std::memcmp(tree.tree.nodes.data(), again.tree.nodes.data(),
                          tree.tree.nodes.size() * sizeof tree.tree.nodes[0]),
              0);
  }
}

TEST(SahBuild, HalvesWhatNoSplitTellsApart) {
  for (const SahMethod method : kMethods) {
    std::vector<BoxedObject<float>> objects(1000);
    for (std::uint32_t i = 0; i < objects.size(); ++i) objects[i] = {{{0, 0, 0}, {1, 1, 1}}, i};
    const auto tree = built(objects, {method, 1});
    expect_valid(tree, 1);
    int deepest = 0;
    walk(tree, tree.tree.root, 0,
         [&](const auto&, int depth, auto, auto) { deepest = std::max(deepest, depth); });
    EXPECT_LE(deepest, 9);
  }
}

/// Equation (3) with both external costs equal.
double expected_tests(const char* technique, const Geometry<float>& geometry, const char* how) {
  const auto prediction = build<float>(technique, geometry, {{"build", how}})->predicted();
  return prediction->object_tests + prediction->volume_tests;
}

constexpr const char* kScenes[] = {"balls:3/patches",   "rings:3/patches",  "tree:6/patches",
                                   "lattice:4/patches", "mount:5",          "tetra:5",
                                   "gears:2/patches",   "teapot:6/patches", "jacks:2/curves"};

/// The most that one build costs more than another on these scenes.
void expect_at_most(double times, const char* one, const char* other) {
  for (const char* technique : {"bvh_sah", "bvh_wide"})
    for (const char* spec : kScenes) {
      const Geometry<float> geometry(load_scene(spec).scene);
      EXPECT_LE(expected_tests(technique, geometry, one), times * expected_tests(technique, geometry, other))
          << technique << " on " << spec;
    }
}

TEST(SahBuild, BinsCostAtMostFivePercentMoreThanAFullSweep) { expect_at_most(1.05, "binned", "sweep"); }

TEST(SahBuild, QualityCostsNoMoreThanBins) { expect_at_most(1, "quality", "binned"); }

TEST(SahBuild, AFastBuildCostsAtMostFifteenPercentMoreThanBins) { expect_at_most(1.15, "fast", "binned"); }

TEST(SahBuild, AFastBuildLeavesAnObjectAloneThatIsMuchLarger) {
  auto objects = random_boxes<float>(2000);
  const Box<float> large{{-1, -1, -1}, {2, 2, 2}};
  objects[1234].box = large;
  const auto tree = built(objects, {SahMethod::fast, 8});
  int found = 0;
  tree.tree.for_each_leaf([&](const Box<float>& box, std::uint32_t, std::uint32_t count) {
    if (box == large) found += count == 1 ? 1 : 1000;
  });
  EXPECT_EQ(found, 1);
}

}  // namespace
}  // namespace rayshoot
