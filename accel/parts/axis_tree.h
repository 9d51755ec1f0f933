#pragma once

#include "accel/core/technique.h"
#include "accel/parts/branch.h"

namespace rayshoot {

/// No axis tree is deeper.
inline constexpr int kMaxAxisTreeDepth = 60;

/// A binary tree that divides a box by axis-aligned planes, in 8 bytes a node for floats: the lower child of a node is
/// the next node, the upper one is linked.
template <class Real>
class AxisTree {
 public:
  class Node {
   public:
    static Node interior(int axis, Real plane) {
      Node node;
      node.plane_ = plane, node.link_ = static_cast<std::uint32_t>(axis);
      return node;
    }
    static Node leaf(std::uint32_t first_reference, std::uint32_t count) {
      Node node;
      node.first_ = first_reference, node.link_ = count << 2 | kLeaf;
      return node;
    }

    bool is_leaf() const { return (link_ & 3) == kLeaf; }
    int axis() const { return static_cast<int>(link_ & 3); }
    Real plane() const { return plane_; }

    /// Distance of the upper child.
    std::uint32_t upper() const { return link_ >> 2; }
    void link_upper(std::uint32_t distance) { link_ |= distance << 2; }
    std::uint32_t first() const { return first_; }
    std::uint32_t count() const { return link_ >> 2; }

   private:
    static constexpr std::uint32_t kLeaf = 3;
    union {
      Real plane_;
      std::uint32_t first_;
    };
    std::uint32_t link_;
  };

  /// Without a box there is nothing.
  Box<Real> box;
  std::vector<Node> nodes;
  std::vector<std::uint32_t> references;

  bool empty() const { return nodes.empty(); }
  std::span<const std::uint32_t> objects(const Node& leaf) const {
    return {references.data() + leaf.first(), leaf.count()};
  }

  /// Call visit(box, key, objects) for each leaf with objects.
  template <class Visit>
  void for_each_cell(const Visit& visit) const {
    if (!empty()) for_each_cell_below(nodes[0], box, visit);
  }

  StructureStats structure() const {
    StructureStats stats{.nodes = nodes.size(),
                         .references = references.size(),
                         .bytes = nodes.size() * sizeof(Node) + references.size() * sizeof(references[0])};
    if (!empty()) measure(nodes[0], 0, stats);
    return stats;
  }

 private:
  template <class Visit>
  void for_each_cell_below(const Node& node, const Box<Real>& cell, const Visit& visit) const {
    if (node.is_leaf()) {
      if (node.count() > 0) visit(cell, objects(node).data(), objects(node));
      return;
    }
    Box<Real> lower = cell, upper = cell;
    lower.hi[node.axis()] = upper.lo[node.axis()] = node.plane();
    for_each_cell_below(*(&node + 1), lower, visit);
    for_each_cell_below(*(&node + node.upper()), upper, visit);
  }

  void measure(const Node& node, std::uint64_t depth, StructureStats& stats) const {
    if (node.is_leaf()) {
      ++stats.leaves, stats.empty_leaves += node.count() == 0;
      stats.max_depth = std::max(stats.max_depth, depth);
      return;
    }
    measure(*(&node + 1), depth + 1, stats);
    measure(*(&node + node.upper()), depth + 1, stats);
  }
};

/// A ray as it crosses the planes of an axis tree, which are `margin` thick on both sides.
template <class Real>
class AxisTreeRay {
 public:
  AxisTreeRay(const Ray<Real>& ray, Real margin = 0) : crossings_(ray), margin_(margin) {
    for (int axis = 0; axis < 3; ++axis) {
      origin_[axis] = crossings_.origin[axis];
      earliest_[axis] = crossings_.earliest[axis], latest_[axis] = crossings_.latest[axis];
      if (crossings_.inverse[axis] < 0) backwards_ |= 1u << axis;
    }
  }

  /// Whether the ray goes down along an axis.
  bool backwards(int axis) const { return backwards_ >> axis & 1; }
  /// The parameters before which it has not passed a plane, and after which it has.
  Real enter(int axis, Real plane) const { return (plane - origin_[axis]) * earliest_[axis]; }
  Real exit(int axis, Real plane) const { return (plane - origin_[axis]) * latest_[axis]; }
  Interval<Real> near(int axis, Real plane) const {
    const Real along = backwards(axis) ? -margin_ : margin_;
    return {enter(axis, plane - along), exit(axis, plane + along)};
  }
  Interval<Real> inside(const Box<Real>& box) const {
    const Vec3<Real> by{margin_, margin_, margin_};
    return crossings_.inside({box.lo - by, box.hi + by});
  }

 private:
  Crossings<Real> crossings_;
  Real origin_[3], earliest_[3], latest_[3];
  Real margin_;
  unsigned backwards_ = 0;
};

/// Jansen's recursive traversal (1986; Arvo & Kirk Figure 12), with a stack of its own: clip the ray's interval at each
/// dividing plane, and go into the nearer child with the part before it and into the farther one with the part behind.
/// Visits the leaves in which the clipped interval is not empty, near to far.
///   visit(leaf)  is called with the node of each leaf; true ends the walk
///   Thick        whether the ray's planes have a margin
template <bool Thick, class Real, class Counter, class Reach, class Visit>
void walk_clipped(const AxisTree<Real>& tree, const AxisTreeRay<Real>& ray, Real t_min, Counter count,
                  const Reach& reach, const Visit& visit) {
  if (tree.empty()) return;
  const Interval<Real> whole = ray.inside(tree.box);
  struct Postponed {
    const typename AxisTree<Real>::Node* node;
    Interval<Real> inside;
  };
  Postponed stack[kMaxAxisTreeDepth];
  int postponed = 0;
  const auto* node = tree.nodes.data();
  Interval<Real> inside{std::max(whole.enter, t_min), std::min(whole.exit, reach())};
  if (!(inside.enter <= inside.exit)) return;
  while (true) {
    count.step();
    while (!node->is_leaf()) {
      // Cross the plane: before it the ray is in the nearer child, behind it in the farther one.
      const int axis = node->axis();
      const auto* lower = node + 1;
      const auto* upper = node + node->upper();
      const auto* nearer = ray.backwards(axis) ? upper : lower;
      const auto* farther = ray.backwards(axis) ? lower : upper;
      const Interval<Real> crossing =
          Thick ? ray.near(axis, node->plane())
                : Interval<Real>{ray.enter(axis, node->plane()), ray.exit(axis, node->plane())};
      count.step();
      if (inside.exit < crossing.enter) {
        keep_branch();
        node = nearer;
      } else if (crossing.exit < inside.enter) {
        keep_branch();
        node = farther;
      } else {
        stack[postponed++] = {farther, {std::max(inside.enter, crossing.enter), inside.exit}};
        inside.exit = std::min(inside.exit, crossing.exit);
        node = nearer;
      }
    }
    if (visit(*node)) return;
    // Come back to the nearest postponed child that no hit has made pointless.
    do {
      if (postponed == 0) return;
      --postponed;
    } while (!(stack[postponed].inside.enter <= reach()));
    node = stack[postponed].node;
    inside = stack[postponed].inside;
  }
}

}  // namespace rayshoot
