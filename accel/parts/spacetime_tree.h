#pragma once

#include "accel/parts/pair_tree.h"
#include "accel/parts/sah_split.h"
#include "scenes/core/geometry.h"

namespace rayshoot {

struct SpacetimeConfig {
  std::uint32_t max_objects = 4;
  int max_time_divisions = 4;
  /// A range of time is divided where that leaves no more than this share of the expected tests.
  double worthwhile = 0.75;
};

/// A binary hierarchy over objects and times (Glassner 1988): its volumes are boxes of space during a range of time. Some
/// nodes are forks, which divide the time; below them the objects are listed once for each half.
template <class Real>
struct SpacetimeTree : PairTree<Real> {
  /// Rays of times up to `time` go on with the first child, later ones with the second.
  struct Fork {
    Real time;
    ChildReference child[2];
  };
  static constexpr std::uint32_t kFork = 0xFFFFFFFFu;

  /// A child that is no fork: the one that the time leads to.
  ChildReference at_time(ChildReference child, Real time) const {
    while (child.count == kFork) child = forks[child.first].child[time > forks[child.first].time];
    return child;
  }

  std::vector<Fork> forks;
  /// The objects of the leaves.
  std::vector<std::uint32_t> references;
  std::uint64_t leaves = 0, depth = 0;
};

/// Builds the tree of a geometry from the root down.
template <class Real>
class SpacetimeBuilder {
 public:
  SpacetimeBuilder(const Geometry<Real>& geometry, const SpacetimeConfig& config)
      : geometry_(geometry), config_(config) {}

  SpacetimeTree<Real> build() && {
    tree_.bounds = geometry_.bounds();
    std::vector<std::uint32_t> objects(geometry_.size());
    std::iota(objects.begin(), objects.end(), 0u);
    if (!objects.empty()) {
      Objects all = boxed(objects, {0, 1});
      tree_.root = build(all, {0, 1}, {});
    }
    return std::move(tree_);
  }

 private:
  using Objects = std::vector<BoxedObject<Real>>;
  struct Times {
    Real first, last;
    Real middle() const { return (first + last) / 2; }
  };
  struct Depth {
    int space = 0, time = 0;
  };

  Objects boxed(std::span<const std::uint32_t> objects, const Times& times) const {
    Objects boxed;
    boxed.reserve(objects.size());
    for (const std::uint32_t object : objects)
      boxed.push_back({geometry_.bounds(object, times.first, times.last), object});
    return boxed;
  }

  ChildReference build(std::span<BoxedObject<Real>> objects, const Times& times, const Depth& depth) {
    tree_.depth = std::max<std::uint64_t>(tree_.depth, static_cast<std::uint64_t>(depth.space + depth.time));
    if (objects.size() <= config_.max_objects) return leaf(objects);
    // Divide time where objects move far for their size.
    if (depth.time < config_.max_time_divisions && pays_to_fork(objects, times))
      return fork(objects, times, depth);
    // Divide the objects elsewhere.
    const std::size_t middle = divide(objects, depth.space);
    const std::span<BoxedObject<Real>> halves[] = {objects.subspan(0, middle), objects.subspan(middle)};
    const auto number = static_cast<std::uint32_t>(tree_.nodes.size());
    tree_.nodes.emplace_back();
    for (int side = 0; side < 2; ++side) {
      Box<Real> box;
      for (const BoxedObject<Real>& object : halves[side]) box.include(object.box);
      const ChildReference child = build(halves[side], times, {depth.space + 1, depth.time});
      tree_.nodes[number].boxes.set(side, box);
      tree_.nodes[number].child[side] = child;
    }
    return {number, 0};
  }

  ChildReference leaf(std::span<const BoxedObject<Real>> objects) {
    const ChildReference child{static_cast<std::uint32_t>(tree_.references.size()),
                               static_cast<std::uint32_t>(objects.size())};
    for (const BoxedObject<Real>& object : objects) tree_.references.push_back(object.object);
    ++tree_.leaves;
    return child;
  }

  /// Equation (2) for each object alone: the expected tests are in proportion to the areas of the boxes.
  bool pays_to_fork(std::span<const BoxedObject<Real>> objects, const Times& times) const {
    double whole = 0, halves = 0;
    for (const BoxedObject<Real>& object : objects) {
      whole += object.box.surface_area();
      halves += geometry_.bounds(object.object, times.first, times.middle()).surface_area() / 2 +
                geometry_.bounds(object.object, times.middle(), times.last).surface_area() / 2;
    }
    return halves < config_.worthwhile * whole;
  }

  ChildReference fork(std::span<const BoxedObject<Real>> objects, const Times& times, const Depth& depth) {
    std::vector<std::uint32_t> names;
    for (const BoxedObject<Real>& object : objects) names.push_back(object.object);
    const auto number = static_cast<std::uint32_t>(tree_.forks.size());
    tree_.forks.push_back({times.middle(), {}});
    const Times halves[] = {{times.first, times.middle()}, {times.middle(), times.last}};
    for (int side = 0; side < 2; ++side) {
      Objects moved = boxed(names, halves[side]);
      const ChildReference child = build(moved, halves[side], {depth.space, depth.time + 1});
      tree_.forks[number].child[side] = child;
    }
    return {number, SpacetimeTree<Real>::kFork};
  }

  /// Reorder the objects into two parts, each with some, where equation (3) expects the least cost; in the middle of the
  /// longest axis where it cannot tell or the tree is deep.
  static std::size_t divide(std::span<BoxedObject<Real>> objects, int depth) {
    Extent<Real> extent;
    for (const BoxedObject<Real>& object : objects) extent.include(object);
    Bins<Real> bins(extent);
    for (const BoxedObject<Real>& object : objects) bins.add(object);
    const SahSplit best = bins.best(extent);
    if (!best.found() || depth >= kBalancedDepth) {
      sort_by_centre(objects, extent.longest_axis());
      return objects.size() / 2;
    }
    const auto middle = std::partition(objects.begin(), objects.end(), [&](const BoxedObject<Real>& object) {
      return bins.goes_left(object, best);
    });
    return static_cast<std::size_t>(middle - objects.begin());
  }

  const Geometry<Real>& geometry_;
  SpacetimeConfig config_;
  SpacetimeTree<Real> tree_;
};

}  // namespace rayshoot
