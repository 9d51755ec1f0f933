#pragma once

#include "accel/parts/huge_pages.h"
#include "accel/parts/lanes.h"

namespace rayshoot {

/// Deeper nodes are halved, which bounds the depth.
inline constexpr int kBalancedDepth = 48;
/// Hence no tree is deeper than this.
inline constexpr int kMaxSahDepth = kBalancedDepth + 32;

/// A child of an interior node: a leaf with objects [first, first + count), or the interior node `first`.
struct ChildReference {
  std::uint32_t first;
  std::uint32_t count;

  bool leaf() const { return count > 0; }
};

/// An interior node holds the boxes of both its children, so that one fetch decides where to go.
template <class Real>
struct alignas(64) PairNode {
  BoxPair<Real> boxes;
  ChildReference child[2];
};

/// A binary hierarchy of boxes over objects in the order of its leaves. The root may be a leaf.
template <class Real>
struct PairTree {
  HugeVector<PairNode<Real>> nodes;
  ChildReference root{0, 0};
  Box<Real> bounds;

  /// What a child is at a time: itself. Trees that know times define it otherwise (spacetime_tree.h).
  ChildReference at_time(const ChildReference& child, Real) const { return child; }

  bool empty() const { return nodes.empty() && !root.leaf(); }
  /// Nodes and leaves.
  std::uint64_t size() const { return empty() ? 0 : 2 * nodes.size() + 1; }
  std::size_t bytes() const { return nodes.size() * sizeof(PairNode<Real>); }

  /// Call visit(box, first, count) for each leaf.
  template <class Visit>
  void for_each_leaf(const Visit& visit) const {
    if (!empty()) for_each_leaf_below(root, bounds, visit);
  }

 private:
  template <class Visit>
  void for_each_leaf_below(const ChildReference& node, const Box<Real>& box, const Visit& visit) const {
    if (node.leaf()) return visit(box, node.first, node.count);
    for (int side = 0; side < 2; ++side)
      for_each_leaf_below(nodes[node.first].child[side], nodes[node.first].boxes.box(side), visit);
  }
};

}  // namespace rayshoot
