// What moving the subtrees of a hierarchy promises.
#include "accel/parts/reinsertion.h"

#include <gtest/gtest.h>

#include <set>

#include "accel/parts/sah_build.h"
#include "accel/tests/nasty_scenes.h"

namespace rayshoot {
namespace {

/// Boxes along a line, of the given extents.
std::vector<BoxedObject<float>> boxes_along_x(const std::vector<std::pair<float, float>>& extents) {
  std::vector<BoxedObject<float>> objects;
  for (std::uint32_t i = 0; i < extents.size(); ++i)
    objects.push_back({{{extents[i].first, 0, 0}, {extents[i].second, 1, 1}}, i});
  return objects;
}

/// The chain whose node i has the leaf i beside all leaves behind it.
PairTree<float> chain_of(const std::vector<BoxedObject<float>>& objects) {
  const auto count = static_cast<std::uint32_t>(objects.size());
  PairTree<float> tree{.nodes = HugeVector<PairNode<float>>(count - 1), .root = {0, 0}};
  Box<float> behind = objects.back().box;
  for (std::uint32_t i = count - 1; i-- > 0;) {
    tree.nodes[i].boxes.set(0, objects[i].box);
    tree.nodes[i].boxes.set(1, behind);
    tree.nodes[i].child[0] = {i, 1};
    tree.nodes[i].child[1] = i + 2 < count ? ChildReference{i + 1, 0} : ChildReference{i + 1, 1};
    behind.include(objects[i].box);
  }
  tree.bounds = behind;
  return tree;
}

double area_below(const PairTree<float>& tree, const ChildReference& child) {
  if (child.leaf()) return 0;
  const PairNode<float>& node = tree.nodes[child.first];
  double sum = 0;
  for (int side = 0; side < 2; ++side)
    sum += area_below(tree, node.child[side]) +
           (node.child[side].leaf() ? 0 : node.boxes.box(side).surface_area());
  return sum;
}

std::uint32_t depth_below(const PairTree<float>& tree, const ChildReference& child) {
  if (child.leaf()) return 0;
  const PairNode<float>& node = tree.nodes[child.first];
  return 1 + std::max(depth_below(tree, node.child[0]), depth_below(tree, node.child[1]));
}

/// Neighbours in space that the chain 0, 1, 2, 3 keeps apart: 0 and 2 belong together, so do 1 and 3.
TEST(Reinsertion, BringsTogetherWhatBelongsTogether) {
  auto objects = boxes_along_x({{0, 1}, {10, 11}, {0.5f, 1.5f}, {10.5f, 11.5f}});
  const PairTree<float> chain = chain_of(objects);
  const PairTree<float> tree = reinserted<float>(chain, objects);
  EXPECT_EQ(tree.nodes.size(), 3u);
  const double pair_area = 2 * (1.5 + 1.5 + 1);
  EXPECT_DOUBLE_EQ(area_below(tree, tree.root), 2 * pair_area);
  EXPECT_EQ(objects[0].object % 2, objects[1].object % 2) << "the objects follow";
}

/// Nested boxes cost least as a chain, each beside all smaller ones, which would be 400 deep.
TEST(Reinsertion, MakesNoTreeDeeperThanSearchesAllow) {
  std::vector<std::pair<float, float>> nested;
  for (int i = 0; i < 400; ++i) nested.emplace_back(0.f, std::pow(1.1f, -static_cast<float>(i)));
  auto objects = boxes_along_x(nested);
  PairTree<float> tree = sah_tree<float>(objects, {.method = SahMethod::binned, .max_objects = 1});
  const std::uint32_t before = depth_below(tree, tree.root);
  for (int again = 0; again < 20; ++again) tree = reinserted<float>(tree, objects);
  EXPECT_GT(depth_below(tree, tree.root), before);
  EXPECT_LE(depth_below(tree, tree.root), static_cast<std::uint32_t>(kMaxSahDepth));
}

std::vector<BoxedObject<float>> random_boxes(std::uint32_t seed, std::uint32_t count) {
  nasty::Random random(seed);
  std::vector<BoxedObject<float>> objects;
  for (std::uint32_t object = 0; object < count; ++object) {
    Vec3<float> lo, size;
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = static_cast<float>(nasty::uniform(random, 0, 1));
      size[axis] = static_cast<float>(std::pow(nasty::uniform(random, 0, 1), 4));
    }
    objects.push_back({{lo, lo + size}, object});
  }
  return objects;
}

/// A tree that can be altered: parents, both children of each node or none, boxes of leaves.
struct LooseTree {
  std::vector<int> parent;
  std::vector<std::array<int, 2>> child;
  std::vector<Box<float>> box;
  int root = 0;

  int add(const PairTree<float>& tree, const ChildReference& from, const Box<float>& bounds, int above) {
    const int node = static_cast<int>(parent.size());
    parent.push_back(above), child.push_back({-1, -1}), box.push_back(bounds);
    if (from.leaf()) return node;
    for (int side = 0; side < 2; ++side) {
      const PairNode<float>& pair = tree.nodes[from.first];
      const int made = add(tree, pair.child[side], pair.boxes.box(side), node);
      child[static_cast<std::size_t>(node)][static_cast<std::size_t>(side)] = made;
    }
    return node;
  }
  std::array<int, 2>& children(int node) { return child[static_cast<std::size_t>(node)]; }
  int& above(int node) { return parent[static_cast<std::size_t>(node)]; }
  bool is_below(int node, int other) {
    while (node >= 0 && node != other) node = above(node);
    return node == other;
  }
  void replace(int at, int old, int by) {
    above(by) = at;
    if (at < 0)
      root = by;
    else
      children(at)[children(at)[1] == old] = by;
  }
  void move(int node, int place) {
    const int with = above(node), sibling = children(with)[children(with)[0] == node];
    replace(above(with), with, sibling);
    replace(above(place), place, with);
    children(with) = {place, node};
    above(place) = above(node) = with;
  }
  /// The areas of all interior nodes below, and the box.
  double area(int node, Box<float>& bounds) {
    if (children(node)[0] < 0) return bounds = box[static_cast<std::size_t>(node)], 0;
    Box<float> right;
    const double sum = area(children(node)[0], bounds) + area(children(node)[1], right);
    bounds.include(right);
    return sum + bounds.surface_area();
  }
  double area() {
    Box<float> bounds;
    return area(root, bounds);
  }
};

double least_area_after_one_move(const LooseTree& tree) {
  double least = std::numeric_limits<double>::infinity();
  const int nodes = static_cast<int>(tree.parent.size());
  for (int node = 0; node < nodes; ++node)
    for (int place = 0; place < nodes; ++place) {
      LooseTree moved = tree;
      if (node == moved.root || moved.is_below(place, node) || place == moved.above(node)) continue;
      if (moved.above(place) == moved.above(node)) continue;
      moved.move(node, place);
      least = std::min(least, moved.area());
    }
  return least;
}

TEST(Reinsertion, EndsWhereNoMoveGains) {
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    auto objects = random_boxes(seed, 12);
    PairTree<float> tree = chain_of(objects);
    for (int again = 0; again < 10; ++again) tree = reinserted<float>(tree, objects);
    LooseTree loose;
    loose.add(tree, tree.root, tree.bounds, -1);
    EXPECT_GE(least_area_after_one_move(loose), loose.area() * (1 - 1e-6)) << "seed " << seed;
  }
}

/// Moves that were found at once can get into each other's way.
TEST(Reinsertion, MakesATreeOfAnyTree) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    auto objects = random_boxes(seed, 70);
    const PairTree<float> chain = chain_of(objects);
    const PairTree<float> tree = reinserted<float>(chain, objects);
    EXPECT_LT(area_below(tree, tree.root), area_below(chain, chain.root));
    std::set<std::uint32_t> seen;
    tree.for_each_leaf([&](const Box<float>& box, std::uint32_t first, std::uint32_t count) {
      EXPECT_EQ(count, 1u);
      EXPECT_EQ(box, objects[first].box);
      seen.insert(objects[first].object);
    });
    EXPECT_EQ(seen.size(), objects.size());
  }
}

}  // namespace
}  // namespace rayshoot
