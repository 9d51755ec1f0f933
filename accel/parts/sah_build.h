#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_reduce.h>

#include "accel/parts/pair_tree.h"
#include "accel/parts/sah_split.h"
#include "scenes/core/geometry.h"

namespace rayshoot {

/// Smaller ranges are built by one thread.
inline constexpr std::size_t kSequentialObjects = 4096;
/// Larger ranges are split between bins.
inline constexpr std::size_t kSweptObjects = 256;
/// Parameters of the build; bvh_sah's manual page explains them.
struct SahConfig {
  bool sweep = true;
  std::size_t max_objects = 4;
  double traversal_cost = 1;
};

/// Builds the nodes over a range of objects that it reorders. A range of m objects owns the m - 1 node
/// numbers from its own on, so threads need not agree on numbers; `compact` closes the gaps.
template <class Real>
class SahBuilder {
 public:
  SahBuilder(std::span<BoxedObject<Real>> objects, const SahConfig& config)
      : objects_(objects), config_(config), nodes_(objects.size()) {}

  ChildReference build() {
    const ChildReference root = build(0, objects_.size(), extent_of(objects_), 0, 0);
    return root.leaf() ? root : compact();
  }
  std::vector<PairNode<Real>> take_nodes() && { return std::move(compacted_); }

 private:
  ChildReference build(std::size_t first, std::size_t last, const Extent<Real>& extent, std::uint32_t node,
                       int depth) {
    const std::span<BoxedObject<Real>> range = objects_.subspan(first, last - first);
    const ChildReference as_leaf{static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(range.size())};
    if (range.size() == 1) return as_leaf;

    // Cut the range in two, or keep it whole where equation (3) expects no gain.
    const std::size_t middle = first + split(range, extent, depth);
    if (middle == first) return as_leaf;

    // Build both halves, at once where they are large.
    const Extent<Real> left_extent = extent_of(objects_.subspan(first, middle - first));
    const Extent<Real> right_extent = extent_of(objects_.subspan(middle, last - middle));
    PairNode<Real>& here = nodes_[node];
    here.boxes.set(0, left_extent.box);
    here.boxes.set(1, right_extent.box);
    const auto right_node = static_cast<std::uint32_t>(node + (middle - first));
    const auto build_left = [&] { here.child[0] = build(first, middle, left_extent, node + 1, depth + 1); };
    const auto build_right = [&] {
      here.child[1] = build(middle, last, right_extent, right_node, depth + 1);
    };
    if (range.size() > kSequentialObjects)
      tbb::parallel_invoke(build_left, build_right);
    else
      build_left(), build_right();
    return {node, 0};
  }

  /// Reorder the range so that its first part goes left; returns the size of that part, 0 to keep a leaf.
  std::size_t split(std::span<BoxedObject<Real>> range, const Extent<Real>& extent, int depth) {
    if (depth >= kBalancedDepth) return halve(range, extent);
    const bool sweep = config_.sweep && range.size() <= kSweptObjects;
    return sweep ? split_swept(range, extent) : split_binned(range, extent);
  }

  /// Equation (3): a leaf tests every object; a split tests two volumes and then the objects of those it
  /// hits.
  bool keep_leaf(std::size_t count, const SahSplit<Real>& split) const {
    const bool worthwhile = split.found() && config_.traversal_cost + split.cost < static_cast<double>(count);
    return !worthwhile && count <= config_.max_objects;
  }

  std::size_t split_swept(std::span<BoxedObject<Real>> range, const Extent<Real>& extent) {
    static thread_local std::vector<double> right_cost;
    const SahSplit<Real> best = sweep_split(range, extent.box, right_cost);
    if (keep_leaf(range.size(), best)) return 0;
    if (!best.found()) return halve(range, extent);
    if (best.axis != 2) sort_by_centre(range, best.axis);
    return best.place;
  }

  std::size_t split_binned(std::span<BoxedObject<Real>> range, const Extent<Real>& extent) {
    const Bins<Real> bins = accumulate(range, Bins<Real>(extent.twice_centres));
    const SahSplit<Real> best = bins.best(extent.box);
    if (keep_leaf(range.size(), best)) return 0;
    if (!best.found()) return halve(range, extent);
    const auto middle = std::partition(range.begin(), range.end(), [&](const BoxedObject<Real>& object) {
      return bins.bin(object, best.axis) < static_cast<int>(best.place);
    });
    return static_cast<std::size_t>(middle - range.begin());
  }

  /// Split in the middle of the longest axis, where no heuristic can tell.
  std::size_t halve(std::span<BoxedObject<Real>> range, const Extent<Real>& extent) const {
    if (range.size() <= config_.max_objects) return 0;
    sort_by_centre(range, largest_axis(extent.twice_centres.extent()));
    return range.size() / 2;
  }

  static Extent<Real> extent_of(std::span<const BoxedObject<Real>> range) {
    return accumulate(range, Extent<Real>{});
  }

  /// Add all objects of a range to an empty sum, in parallel where there are many.
  template <class Sum>
  static Sum accumulate(std::span<const BoxedObject<Real>> range, const Sum& empty) {
    using Part = tbb::blocked_range<std::size_t>;
    const auto add_part = [&](const Part& part, Sum sum) {
      for (std::size_t i = part.begin(); i < part.end(); ++i) add(sum, range[i]);
      return sum;
    };
    const auto join = [](Sum a, const Sum& b) {
      add(a, b);
      return a;
    };
    const Part all(0, range.size(), 16 * kSequentialObjects);
    return range.size() <= 32 * kSequentialObjects ? add_part(all, empty)
                                                   : tbb::parallel_reduce(all, empty, add_part, join);
  }
  static void add(Extent<Real>& sum, const auto& part) { sum.include(part); }
  static void add(Bins<Real>& sum, const auto& part) { sum.add(part); }

  /// Renumber the nodes depth first, without gaps.
  ChildReference compact() {
    compacted_.reserve(nodes_.size() / 2 + 1);
    return {copy_subtree(0), 0};
  }
  std::uint32_t copy_subtree(std::uint32_t node) {
    const auto copy = static_cast<std::uint32_t>(compacted_.size());
    compacted_.push_back(nodes_[node]);
    for (int side = 0; side < 2; ++side) {
      const ChildReference child = nodes_[node].child[side];
      if (!child.leaf()) {
        const std::uint32_t number = copy_subtree(child.first);
        compacted_[copy].child[side].first = number;
      }
    }
    return copy;
  }

  std::span<BoxedObject<Real>> objects_;
  SahConfig config_;
  std::vector<PairNode<Real>> nodes_;
  std::vector<PairNode<Real>> compacted_;
};

/// The objects of a geometry with their bounds.
template <class Real>
std::vector<BoxedObject<Real>> boxed_objects(const Geometry<Real>& geometry) {
  std::vector<BoxedObject<Real>> objects(geometry.size());
  tbb::parallel_for(std::uint32_t{0}, geometry.size(), [&](std::uint32_t object) {
    objects[object] = {geometry.bounds(object), object};
  });
  return objects;
}

/// The tree over boxed objects, which are reordered as its leaves name them.
template <class Real>
PairTree<Real> sah_tree(std::span<BoxedObject<Real>> objects, const SahConfig& config) {
  PairTree<Real> tree;
  if (objects.empty()) return tree;
  for (const BoxedObject<Real>& object : objects) tree.bounds.include(object.box);
  SahBuilder<Real> builder(objects, config);
  tree.root = builder.build();
  tree.nodes = std::move(builder).take_nodes();
  return tree;
}

}  // namespace rayshoot
