#pragma once

#include <tbb/parallel_for.h>

#include <numeric>

#include "accel/core/technique.h"
#include "accel/parts/object_hierarchy.h"
#include "accel/parts/volume_kinds.h"

namespace rayshoot {

/// A hierarchy of objects with a volume of any kind about every node. A node that a ray meets gives its own objects
/// and then the nodes below it that the ray meets, near to far. A technique derives from it and defines build and visit.
template <class Real>
class VolumeTree {
 public:
  using Scalar = Real;
  struct Postponed {
    Real enter;
    std::uint32_t node;
  };
  struct Scratch {
    std::vector<Postponed> stack;
  };

  VolumeTree() = default;

  /// `choose(volumes)` picks one of the volumes of all kinds about a node.
  template <class Choose>
  VolumeTree(const Geometry<Real>& geometry, ObjectHierarchy&& hierarchy, const Choose& choose) {
    lay_out(hierarchy);
    order_ = std::move(hierarchy.order);

    // Collect the surfaces in the tree's order: those below a node are consecutive.
    std::vector<SurfaceBall> balls;
    std::vector<std::size_t> first_ball{0};
    for (const std::uint32_t object : order_) {
      append_surface(geometry, object, balls);
      first_ball.push_back(balls.size());
    }
    tbb::parallel_for(std::size_t{0}, nodes_.size(), [&](std::size_t node) {
      const auto [first, last] = below_[node];
      Box<Real> bounds;
      for (std::uint32_t i = first; i < last; ++i) bounds.include(geometry.bounds(order_[i]));
      nodes_[node].volume = choose(bounding_volumes(
          std::span<const SurfaceBall>(balls.data() + first_ball[first], balls.data() + first_ball[last]),
          bounds));
    });
    below_ = {};
  }

  Scratch scratch() const { return {}; }
  std::span<const std::uint32_t> order() const { return order_; }

  /// `tested(kind)` is told of every volume test.
  template <class Counter, class Tested, class L>
  void visit_met(const Ray<Real>& ray, Scratch& scratch, Counter count, const Tested& tested, L& leaf) const {
    if (nodes_.empty()) return;
    const VolumeRay<Real> prepared(ray);
    std::vector<Postponed>& stack = scratch.stack;
    stack.clear();
    const auto postpone_if_met = [&](std::uint32_t node) {
      const Volume<Real>& volume = nodes_[node].volume;
      count.volume_tests(), tested(volume.kind);
      const Interval<Real> inside = volume.inside(prepared);
      const Real enter = std::max(inside.enter, ray.t_min);
      if (enter <= std::min(inside.exit, leaf.reach())) stack.push_back({enter, node});
    };
    postpone_if_met(0);
    while (true) {
      // Take the nearest node that no hit has made pointless meanwhile; one at equal distance may hold a lower object.
      while (!stack.empty() && stack.back().enter > leaf.reach()) stack.pop_back();
      if (stack.empty()) return;
      const Node& node = nodes_[stack.back().node];
      stack.pop_back();

      // Test its own objects.
      if (node.first_object < node.last_object) count.cell(false);
      for (std::uint32_t i = node.first_object; i < node.last_object; ++i)
        if (leaf(i)) return;

      // Postpone every node below that is met, the nearest on top of the stack.
      if (node.first_child == node.last_child) continue;
      count.step();
      const std::size_t bottom = stack.size();
      for (std::uint32_t child = node.first_child; child < node.last_child; ++child) {
        const std::size_t size = stack.size();
        postpone_if_met(child);
        if (stack.size() > size)
          for (std::size_t i = size; i > bottom && stack[i - 1].enter < stack[i].enter; --i)
            std::swap(stack[i - 1], stack[i]);
      }
    }
  }

  /// Figures: nodes by origin, and volumes by kind.
  StructureStats structure() const {
    StructureStats stats{.nodes = nodes_.size(),
                         .references = order_.size(),
                         .max_depth = max_depth_,
                         .bytes = nodes_.size() * sizeof(Node) + order_.size() * sizeof(order_[0])};
    for (const char* kind : kVolumeKindNames) stats.figures[kind + std::string("_volumes")] = 0;
    for (const Node& node : nodes_) {
      stats.leaves += node.first_object < node.last_object;
      ++stats.figures[kVolumeKindNames[static_cast<std::size_t>(node.volume.kind)] + std::string("_volumes")];
    }
    stats.figures["modelled_nodes"] = modelled_nodes_;
    return stats;
  }

  template <class Visit>
  void for_each_volume(const Visit& visit) const {
    visit(HierarchyVolume{.volume_tests = 1});
    if (!nodes_.empty()) visit_below(nodes_[0], 1, visit);
  }

 private:
  struct Node {
    Volume<Real> volume;
    std::uint32_t first_object, last_object;
    std::uint32_t first_child, last_child;
  };

  template <class Visit>
  void visit_below(const Node& node, std::uint32_t depth, const Visit& visit) const {
    visit(HierarchyVolume{depth, node.last_child - node.first_child, node.last_object - node.first_object,
                          node.first_object, node.last_object});
    for (std::uint32_t child = node.first_child; child < node.last_child; ++child)
      visit_below(nodes_[child], depth + 1, visit);
  }

  /// Put the children of a node side by side.
  void lay_out(const ObjectHierarchy& hierarchy) {
    struct Source {
      std::uint32_t node;
      std::uint64_t depth;
    };
    std::vector<Source> sources;
    const auto place = [&](std::uint32_t node, std::uint64_t depth) {
      const ObjectHierarchy::Node& source = hierarchy.nodes[node];
      sources.push_back({node, depth});
      nodes_.push_back({{}, source.first, source.own_last, 0, 0});
      below_.push_back({source.first, source.last});
      modelled_nodes_ += source.modelled;
      max_depth_ = std::max(max_depth_, depth);
    };
    nodes_.reserve(hierarchy.nodes.size());
    if (!hierarchy.nodes.empty()) place(0, 0);
    for (std::size_t next = 0; next < sources.size(); ++next) {
      const auto [node, depth] = sources[next];
      nodes_[next].first_child = static_cast<std::uint32_t>(nodes_.size());
      for (std::uint32_t child = node + 1; child < hierarchy.nodes[node].end;
           child = hierarchy.nodes[child].end)
        place(child, depth + 1);
      nodes_[next].last_child = static_cast<std::uint32_t>(nodes_.size());
    }
  }

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
  /// While building: the positions of all objects below each node.
  std::vector<std::array<std::uint32_t, 2>> below_;
  std::uint64_t max_depth_ = 0;
  std::uint32_t modelled_nodes_ = 0;
};

}  // namespace rayshoot
