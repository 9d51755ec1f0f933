#pragma once

#include <bit>

#include "accel/parts/pair_tree.h"
#include "accel/parts/sah_split.h"

namespace rayshoot {

/// Up to so many objects a subtree is built by `SweptSubtree`.
inline constexpr std::size_t kSweptObjects = 32;

/// Builds the subtree over a few objects, trying every split between neighbours in sorted order. Objects are sorted once along
/// each axis and stay sorted in all parts of the range (I. Wald & V. Havran, "On building fast kd-trees for ray tracing, and on
/// doing that in O(N log N)", 2006), so that a level of the tree costs no more than a look at every object.
template <class Real>
class SweptSubtree {
 public:
  /// Of objects that stand from `first` on in the tree's order; it reorders them.
  SweptSubtree(std::span<BoxedObject<Real>> objects, std::size_t first, PairNode<Real>* nodes)
      : objects_(objects), first_(static_cast<std::uint32_t>(first)), nodes_(nodes) {
    std::memcpy(static_cast<void*>(copies_), objects.data(), objects.size_bytes());
    for (std::size_t i = 0; i < objects.size(); ++i) boxes_[i] = objects[i].lanes();
    for (int axis = 0; axis < 3; ++axis) sort(axis);
  }

  /// `keeps_leaf(count, split)` decides whether so many objects stay together.
  template <class KeepsLeaf>
  ChildReference build(const BoxUnion<Real>& box, std::uint32_t node, const KeepsLeaf& keeps_leaf) {
    return build(0, static_cast<int>(objects_.size()), box, node, keeps_leaf);
  }

 private:
  template <class KeepsLeaf>
  ChildReference build(int first, int last, const BoxUnion<Real>& box, std::uint32_t node,
                       const KeepsLeaf& keeps_leaf) {
    if (last - first == 1) return leaf(first, last);
    SahSplit best;
    // Two objects can be split in one way only.
    for (int axis = 0; axis < (last - first == 2 ? 1 : 3); ++axis) sweep(axis, first, last, best);
    best.cost /= box.half_area();
    if (keeps_leaf(static_cast<std::size_t>(last - first), best)) return leaf(first, last);
    // No split helps where all boxes are the same: cut in the middle then.
    if (!(best.cost < last - first)) best = {0, static_cast<std::size_t>(first + (last - first) / 2)};

    const auto middle = static_cast<int>(best.place);
    const BoxUnion<Real> left = united(best.axis, first, middle), right = united(best.axis, middle, last);
    divide(best.axis, first, middle, last);
    nodes_[node].boxes.set(0, Box<Real>(left));
    nodes_[node].boxes.set(1, Box<Real>(right));
    nodes_[node].child[0] = build(first, middle, left, node + 1, keeps_leaf);
    nodes_[node].child[1] =
        build(middle, last, right, node + static_cast<std::uint32_t>(middle - first), keeps_leaf);
    return {node, 0};
  }

  ChildReference leaf(int first, int last) {
    for (int i = first; i < last; ++i)
      std::memcpy(static_cast<void*>(&objects_[i]), &copies_[order_[0][i]], sizeof objects_[i]);
    return {first_ + static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last - first)};
  }

  /// Each object's place along an axis is the number of those before it: by centre, equal ones as they stand.
  void sort(int axis) {
    constexpr int kAtOnce = 4;
    const int count = static_cast<int>(objects_.size());
    Real centres[kSweptObjects];
    for (int i = 0; i < count; ++i) centres[i] = copies_[i].twice_centre(axis);
    std::fill(centres + count, centres + kSweptObjects, Box<Real>::infinity());
    for (int from = 0; from < count; from += kAtOnce) {
      const Lanes<Real> centre = read_lanes<Real>(centres, static_cast<std::size_t>(from));
      auto minus_place = centre < centre;
      auto self = minus_place;
      for (int k = 0; k < kAtOnce; ++k) self[k] = from + k;
      for (int i = 0; i < count; ++i) {
        const Lanes<Real> other = Lanes<Real>{} + centres[i];
        minus_place += (other < centre) | ((other == centre) & (self > i));
      }
      for (int k = 0; k < std::min(kAtOnce, count - from); ++k)
        order_[axis][-minus_place[k]] = static_cast<std::uint8_t>(from + k);
    }
  }

  void sweep(int axis, int first, int last, SahSplit& best) const {
    const std::uint8_t* const order = order_[axis];
    double right_cost[kSweptObjects], count = 0;
    BoxUnion<Real> right = BoxUnion<Real>::empty();
    for (int i = last - 1; i > first; --i) {
      right.include(boxes_[order[i]]);
      right_cost[i] = right.half_area() * ++count;
    }
    BoxUnion<Real> left = BoxUnion<Real>::empty();
    count = 0;
    for (int i = first + 1; i < last; ++i) {
      left.include(boxes_[order[i - 1]]);
      const double cost = left.half_area() * ++count + right_cost[i];
      if (cost < best.cost) best = {axis, static_cast<std::size_t>(i), cost};
    }
  }

  BoxUnion<Real> united(int axis, int first, int last) const {
    BoxUnion<Real> box = BoxUnion<Real>::empty();
    for (int i = first; i < last; ++i) box.include(boxes_[order_[axis][i]]);
    return box;
  }

  /// Divide the other axes' orders as one axis' order is divided by a place.
  void divide(int split_axis, int first, int middle, int last) {
    std::uint32_t goes_left = 0;
    for (int i = first; i < middle; ++i) goes_left |= 1u << order_[split_axis][i];
    for (int axis = 0; axis < 3; ++axis) {
      if (axis == split_axis) continue;
      std::uint8_t* const order = order_[axis];
      std::uint8_t right[kSweptObjects];
      int left_end = first, right_end = 0;
      for (int i = first; i < last; ++i) {
        const std::uint8_t object = order[i];
        const int is_left = static_cast<int>(goes_left >> object & 1);
        order[left_end] = right[right_end] = object;
        left_end += is_left, right_end += 1 - is_left;
      }
      std::copy_n(right, right_end, order + middle);
    }
  }

  std::span<BoxedObject<Real>> objects_;
  const std::uint32_t first_;
  PairNode<Real>* const nodes_;
  BoxedObject<Real> copies_[kSweptObjects];
  LaneBox<Real> boxes_[kSweptObjects];
  std::uint8_t order_[3][kSweptObjects];
};

}  // namespace rayshoot
