#pragma once

#include "accel/parts/octree_build.h"

namespace rayshoot {

/// So many nodes behind a root with children stand for nothing.
inline constexpr std::size_t kUnusedNodes = 7;

/// Lays an octree out depth first: the children of a node stand together, what is below one of them before what is below
/// the next, and so do the references. What lies close together in space then mostly lies close together in memory.
template <class Real>
class DepthFirstOctree {
 public:
  explicit DepthFirstOctree(const Octree<Real>& given) : given_(given) {
    laid_out_.lattice = given.lattice, laid_out_.depth = given.depth;
    laid_out_.nodes.reserve(given.nodes.size()), laid_out_.references.reserve(given.references.size());
    laid_out_.places.reserve(given.places.size());
    append(0);
    lay_out_below(0, 0);
  }

  Octree<Real> octree() && { return std::move(laid_out_); }

 private:
  void append(std::size_t number) {
    laid_out_.nodes.push_back(given_.nodes[number]);
    if (!given_.places.empty()) laid_out_.places.push_back(given_.places[number]);
  }

  /// `number` is that of a node as given, `place` where it was appended.
  void lay_out_below(std::size_t number, std::size_t place) {
    const auto& node = given_.nodes[number];
    if (!node.interior()) {
      laid_out_.nodes[place].first = static_cast<std::uint32_t>(laid_out_.references.size());
      for (const std::uint32_t object : given_.objects(node)) laid_out_.references.push_back(object);
      return;
    }
    if (place == 0) leave_out();
    const std::size_t first = laid_out_.nodes.size();
    laid_out_.nodes[place].first = static_cast<std::uint32_t>(first);
    for (unsigned octant = 0; octant < 8; ++octant) append(node.first + octant);
    for (unsigned octant = 0; octant < 8; ++octant) lay_out_below(node.first + octant, first + octant);
  }

  /// Begin with the children of the root where a cache line begins: eight siblings fill one.
  void leave_out() {
    for (std::size_t unused = 0; unused < kUnusedNodes; ++unused) {
      laid_out_.nodes.push_back({});
      if (!given_.places.empty()) laid_out_.places.push_back({});
    }
  }

  const Octree<Real>& given_;
  Octree<Real> laid_out_;
};

}  // namespace rayshoot
