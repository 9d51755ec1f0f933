#pragma once

#include "accel/parts/huge_pages.h"
#include "scenes/core/geometry.h"

namespace rayshoot {

/// Children of an interior node of a wide hierarchy, and objects a leaf may hold: what one instruction compares.
inline constexpr int kWideWidth = 8;

/// A child of a wide node: the number of an interior node, or a leaf of successive objects.
class WideChild {
 public:
  /// Objects a tree can number.
  static constexpr std::uint32_t kMostObjects = 1u << 28;

  WideChild() = default;
  static WideChild interior(std::uint32_t node) { return WideChild(node); }
  static WideChild leaf(std::uint32_t first, std::uint32_t count) {
    return WideChild(kLeaf | (count - 1) << kFirstBits | first);
  }

  bool is_leaf() const { return code_ & kLeaf; }
  std::uint32_t node() const { return code_; }
  std::uint32_t first() const { return code_ & (kMostObjects - 1); }
  std::uint32_t count() const { return (code_ >> kFirstBits & (kWideWidth - 1)) + 1; }

 private:
  static constexpr int kFirstBits = 28;
  static constexpr std::uint32_t kLeaf = 1u << 31;

  explicit WideChild(std::uint32_t code) : code_(code) {}

  std::uint32_t code_;
};

/// An interior node: the boxes of its children side by side, for every axis the lower planes and then the upper ones.
/// Places without a child hold empty boxes.
template <class Real>
struct alignas(64) WideNode {
  Real planes[3][2][kWideWidth];
  WideChild child[kWideWidth];
  std::uint32_t children = 0;

  WideNode() {
    for (auto& axis : planes) {
      std::fill_n(axis[0], kWideWidth, Box<Real>::infinity());
      std::fill_n(axis[1], kWideWidth, -Box<Real>::infinity());
    }
  }
  void add(const Box<Real>& box, WideChild which) {
    for (int axis = 0; axis < 3; ++axis) {
      planes[axis][0][children] = box.lo[axis];
      planes[axis][1][children] = box.hi[axis];
    }
    child[children++] = which;
  }
  /// Call visit(which, leaf) for each child that is a leaf.
  template <class Visit>
  void for_each_leaf(const Visit& visit) const {
    for (std::uint32_t which = 0; which < children; ++which)
      if (child[which].is_leaf()) visit(which, child[which]);
  }
  Box<Real> box(std::uint32_t which) const {
    Box<Real> box;
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = planes[axis][0][which];
      box.hi[axis] = planes[axis][1][which];
    }
    return box;
  }
};

/// A hierarchy of wide nodes over objects in the order of its leaves. Unless it is empty node 0 is the root.
template <class Real>
struct WideTree {
  HugeVector<WideNode<Real>> nodes;
  Box<Real> bounds;
  std::uint32_t max_depth = 0;

  bool empty() const { return nodes.empty(); }
  std::size_t bytes() const { return nodes.size() * sizeof(WideNode<Real>); }

  /// Call visit(box, leaf) for each leaf.
  template <class Visit>
  void for_each_leaf(const Visit& visit) const {
    for (const WideNode<Real>& node : nodes)
      node.for_each_leaf([&](std::uint32_t which, WideChild leaf) { visit(node.box(which), leaf); });
  }
};

}  // namespace rayshoot
