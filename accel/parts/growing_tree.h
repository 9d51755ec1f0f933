#pragma once

#include <limits>
#include <vector>

#include "scenes/core/geometry.h"

namespace rayshoot {

inline constexpr std::uint32_t kNoNode = 0xFFFFFFFFu;

/// The hierarchy of Goldsmith and Salmon (1987) while it grows. Nodes 0 to n-1 are the objects, n is the root, the others are interior nodes.
template <class Real>
class GrowingTree {
 public:
  struct Node {
    Box<Real> box;
    std::uint32_t parent = kNoNode, first_child = kNoNode, next_sibling = kNoNode;
    std::uint32_t children = 0;
  };

  explicit GrowingTree(const Geometry<Real>& geometry)
      : objects_(geometry.size()), nodes_(geometry.size() + 1) {
    nodes_.reserve(2 * static_cast<std::size_t>(objects_) + 1);
    for (std::uint32_t object = 0; object < objects_; ++object) nodes_[object].box = geometry.bounds(object);
  }

  std::uint32_t root() const { return objects_; }
  bool is_object(std::uint32_t node) const { return node < objects_; }
  const Node& operator[](std::uint32_t node) const { return nodes_[node]; }

  void insert(std::uint32_t object) {
    // Find the place that increases the cost of the tree the least.
    best_ = {};
    searched_ = 0;
    search(root(), object, 0);

    // Become a child there, or share a new node with the object that stands there.
    std::uint32_t place = best_.node;
    if (is_object(place)) place = interpose(place);
    adopt(place, object);
    for (std::uint32_t node = place; node != kNoNode; node = nodes_[node].parent)
      nodes_[node].box.include(nodes_[object].box);
  }

  /// Equation (3) times the root's area: every node costs a test of each of its children whenever it is hit.
  double cost() const {
    double sum = 0;
    for (const Node& node : nodes_) sum += area(node.box) * node.children;
    return sum;
  }

 private:
  /// Nodes searched for one object, where very many children tie.
  static constexpr int kSearchLimit = 256;

  struct Place {
    std::uint32_t node = kNoNode;
    double increase = std::numeric_limits<double>::infinity();
  };

  static double area(const Box<Real>& box) { return box.surface_area(); }
  double area_with(std::uint32_t node, std::uint32_t object) const {
    Box<Real> box = nodes_[node].box;
    box.include(nodes_[object].box);
    return area(box);
  }

  /// `inherited` is by how much the growth of the ancestors increases their cost.
  void search(std::uint32_t node, std::uint32_t object, double inherited) {
    // Consider becoming one more child of this node: it grows, and has one more child to test.
    const double grown = area_with(node, object);
    const double increase = inherited + (grown - area(nodes_[node].box)) * nodes_[node].children;
    consider(node, increase + grown);

    // Go on with the child whose area grows the least; of those that tie, with all.
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t child = nodes_[node].first_child; child != kNoNode; child = nodes_[child].next_sibling)
      least = std::min(least, area_with(child, object) - area(nodes_[child].box));
    for (std::uint32_t child = nodes_[node].first_child; child != kNoNode;
         child = nodes_[child].next_sibling) {
      const double grown_child = area_with(child, object);
      if (grown_child - area(nodes_[child].box) > least || ++searched_ > kSearchLimit) continue;
      if (is_object(child))
        consider(child, increase + 2 * grown_child);
      else
        search(child, object, increase);
    }
  }

  void consider(std::uint32_t node, double increase) {
    if (increase < best_.increase) best_ = {node, increase};
  }

  void adopt(std::uint32_t parent, std::uint32_t child) {
    nodes_[child].parent = parent;
    nodes_[child].next_sibling = nodes_[parent].first_child;
    nodes_[parent].first_child = child;
    ++nodes_[parent].children;
  }

  /// Put a new interior node in the place of an object, with the object as its only child.
  std::uint32_t interpose(std::uint32_t object) {
    const auto fresh = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back(nodes_[object]);
    std::uint32_t* link = &nodes_[nodes_[object].parent].first_child;
    while (*link != object) link = &nodes_[*link].next_sibling;
    *link = fresh;
    nodes_[fresh].first_child = kNoNode;
    adopt(fresh, object);
    nodes_[object].next_sibling = kNoNode;
    return fresh;
  }

  std::uint32_t objects_;
  std::vector<Node> nodes_;
  Place best_;
  int searched_ = 0;
};

}  // namespace rayshoot
