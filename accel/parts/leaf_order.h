#pragma once

#include <bit>

#include "accel/parts/lattice.h"

namespace rayshoot {

/// The octant of the cells of `size`^3 layers, among the eight in one of twice that size, in which layers lie.
template <class Layers>
unsigned octant_of(const Layers& layers, int size) {
  return (layers[0] & size ? 1u : 0u) | (layers[1] & size ? 2u : 0u) | (layers[2] & size ? 4u : 0u);
}

/// A node of an octree on a ray's way, and its cell in the lattice as the ray sees it. `NodeRef` leads to the node.
template <class Real, class NodeRef>
struct CellOnRay {
  NodeRef node{};
  typename LatticeRay<Real>::Layers corner{};
  int size = 0;

  /// The cell of a child, by its octant as the ray sees it.
  CellOnRay child(NodeRef below, unsigned octant) const {
    const int half = size / 2;
    return {below,
            {corner[0] + (octant & 1 ? half : 0), corner[1] + (octant & 2 ? half : 0),
             corner[2] + (octant & 4 ? half : 0)},
            half};
  }
  bool contains(const CellOnRay& other) const {
    for (int axis = 0; axis < 3; ++axis)
      if (other.corner[axis] < corner[axis] || other.corner[axis] >= corner[axis] + size) return false;
    return true;
  }
  /// Whether it comes after another, which it does not contain, depth first in increasing order of octants.
  bool follows(const CellOnRay& other) const {
    unsigned differing = 0;
    for (int axis = 0; axis < 3; ++axis)
      differing |= static_cast<unsigned>(corner[axis] ^ other.corner[axis]);
    if (differing == 0) return false;
    const auto level = static_cast<int>(std::bit_floor(differing));
    return octant_of(corner, level) > octant_of(other.corner, level);
  }
};

/// What all traversals of an octree agree on: they visit each leaf whose closed interval of parameters on the ray is not
/// empty, depth first and in increasing order of octants as the ray sees them. `Tree` leads from node to node:
///   root(), interior(node), child(node, octant)  with the octant as the lattice has it
template <class Real, class Tree>
class LeafOrder {
 public:
  using Cell = CellOnRay<Real, decltype(std::declval<const Tree&>().root())>;

  LeafOrder(const Tree& tree, const LatticeRay<Real>& path, int layers)
      : tree_(tree), path_(path), layers_(layers) {}

  Cell root() const { return {tree_.root(), {0, 0, 0}, layers_}; }
  /// A child of a cell, by its octant as the ray sees it.
  Cell child(const Cell& cell, unsigned octant) const {
    return cell.child(tree_.child(cell.node, octant ^ path_.mirror()), octant);
  }

  /// The first leaf below a cell that the ray is in at `first`, when it comes into the cell or begins: beyond each
  /// dividing plane that it has certainly passed. `entered()` is called for every cell on the way down.
  template <class Entered>
  Cell first_leaf(Cell cell, Real first, const Entered& entered) const {
    while (tree_.interior(cell.node)) {
      cell = child(cell, octant_at(cell, first));
      entered();
    }
    return cell;
  }

  /// Whether a ray passes a cell at no more than that margin.
  bool near(const Cell& cell, Real margin, Real t_min, Real reach) const {
    const Interval<Real> inside = path_.near(cell.corner, cell.size, margin);
    return inside.enter <= inside.exit && inside.exit >= t_min && inside.enter <= reach;
  }

  /// Call visit(leaf) for the leaves below a cell for which, and for all cells above which, meets(cell) holds; true when
  /// `visit` returned true.
  template <class Meets, class Visit>
  bool visit_leaves(const Cell& cell, const Meets& meets, const Visit& visit) const {
    if (!meets(cell)) return false;
    if (!tree_.interior(cell.node)) return visit(cell);
    for (unsigned octant = 0; octant < 8; ++octant)
      if (visit_leaves(child(cell, octant), meets, visit)) return true;
    return false;
  }

  /// The axis on which the ray leaves a leaf, if it certainly does so through the inside of a face; else 3.
  int exit_axis(const Cell& leaf) const {
    Real enter[3], exit[3];
    for (int axis = 0; axis < 3; ++axis) {
      enter[axis] = path_.entry(axis, leaf.corner[axis] + leaf.size);
      exit[axis] = path_.exit(axis, leaf.corner[axis] + leaf.size);
    }
    for (int axis = 0; axis < 3; ++axis) {
      const int other = (axis + 1) % 3, third = (axis + 2) % 3;
      if (exit[axis] < enter[other] && exit[axis] < enter[third])
        return path_.exit(other, leaf.corner[other]) < enter[axis] &&
                       path_.exit(third, leaf.corner[third]) < enter[axis]
                   ? axis
                   : 3;
    }
    return 3;
  }

  /// Go from leaf to leaf.
  ///   across(leaf, axis, first)  moves to the first leaf behind the face, which the ray enters at `first`; false when
  ///                              it leaves the octree
  ///   visit(leaf)                is called with every leaf; true ends the walk
  /// Where the ray may leave by an edge or a vertex, the next leaf is searched from the root.
  template <class Reach, class Across, class Visit>
  void walk(Real t_min, const Reach& reach, const Across& across, const Visit& visit) const {
    const Interval<Real> whole = path_.inside({0, 0, 0}, layers_);
    const Real begin = std::max(whole.enter, t_min);
    if (!(begin <= std::min(whole.exit, reach()))) return;
    Cell leaf = first_leaf(root(), begin, [] {});
    while (!visit(leaf)) {
      const int axis = exit_axis(leaf);
      if (axis < 3) [[likely]] {
        const Real enter = path_.entry(axis, leaf.corner[axis] + leaf.size);
        if (reach() < enter || !across(leaf, axis, std::max(enter, t_min))) return;
      } else if (!next_leaf(leaf, t_min, reach())) {
        return;
      }
    }
  }

 private:
  unsigned octant_at(const Cell& cell, Real first) const {
    const int half = cell.size / 2;
    unsigned octant = 0;
    for (int axis = 0; axis < 3; ++axis)
      octant |= unsigned{path_.exit(axis, cell.corner[axis] + half) < first} << axis;
    return octant;
  }

  /// Move to the next leaf in order that the ray meets before `reach`; false when there is none.
  [[gnu::noinline, gnu::cold]] bool next_leaf(Cell& leaf, Real t_min, Real reach) const {
    const Cell from = leaf;
    return visit_leaves(
        root(),
        [&](const Cell& cell) {
          if (cell.size <= from.size || !cell.contains(from))
            if (!cell.follows(from)) return false;
          const Interval<Real> inside = path_.inside(cell.corner, cell.size);
          return inside.enter <= inside.exit && inside.exit >= t_min && inside.enter <= reach;
        },
        [&](const Cell& found) {
          leaf = found;
          return true;
        });
  }

  const Tree& tree_;
  const LatticeRay<Real>& path_;
  int layers_;
};

}  // namespace rayshoot
