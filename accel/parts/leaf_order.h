#pragma once

#include "accel/parts/lattice.h"

namespace rayshoot {

/// A node of an octree on a ray's way, and its cell in the lattice as the ray sees it. `NodeRef` leads to the node.
template <class NodeRef>
struct CellOnRay : LatticeCell {
  NodeRef node{};
};

/// What all traversals of an octree agree on: they visit each leaf whose closed interval of parameters on the ray is not
/// empty, depth first and in increasing order of octants as the ray sees them. `Tree` leads from node to node:
///   root(), interior(node)
///   child(node, octant)        with the octant as the lattice has it
///   dividing(node, cell, path) the planes that divide an interior node, as the ray sees them
template <class Real, class Tree>
class LeafOrder {
 public:
  using Cell = CellOnRay<decltype(std::declval<const Tree&>().root())>;

  LeafOrder(const Tree& tree, const LatticeRay<Real>& path, const Lattice<Real>& lattice)
      : tree_(tree), path_(path), whole_(lattice.whole()) {}

  Cell root() const { return {whole_, tree_.root()}; }
  /// The planes that divide a cell, as the ray sees them.
  Layers dividing(const Cell& cell) const { return tree_.dividing(cell.node, cell, path_); }
  /// A child of a cell that those planes divide, by its octant as the ray sees it.
  Cell child(const Cell& cell, const Layers& planes, unsigned octant) const {
    return {cell.child(octant, planes), tree_.child(cell.node, octant ^ path_.mirror())};
  }

  /// The first leaf below a cell that the ray is in at `first`, when it comes into the cell or begins: beyond each
  /// dividing plane that it has certainly passed. `entered()` is called for every cell on the way down.
  template <class Entered>
  Cell first_leaf(Cell cell, Real first, const Entered& entered) const {
    while (tree_.interior(cell.node)) {
      const Layers planes = dividing(cell);
      cell = child(cell, planes, octant_at(planes, first));
      entered();
    }
    return cell;
  }

  /// Whether a ray passes a cell at no more than that margin.
  bool near(const Cell& cell, Real margin, Real t_min, Real reach) const {
    const Interval<Real> inside = path_.near(cell, margin);
    return inside.enter <= inside.exit && inside.exit >= t_min && inside.enter <= reach;
  }

  /// Call visit(leaf) for the leaves below a cell for which, and for all cells above which, meets(cell) holds; true when
  /// `visit` returned true.
  template <class Meets, class Visit>
  bool visit_leaves(const Cell& cell, const Meets& meets, const Visit& visit) const {
    if (!meets(cell)) return false;
    if (!tree_.interior(cell.node)) return visit(cell);
    const Layers planes = dividing(cell);
    for (unsigned octant = 0; octant < 8; ++octant)
      if (visit_leaves(child(cell, planes, octant), meets, visit)) return true;
    return false;
  }

  /// The axis on which the ray leaves a leaf, if it certainly does so through the inside of a face; else 3.
  int exit_axis(const Cell& leaf) const {
    Real enter[3], exit[3];
    for (int axis = 0; axis < 3; ++axis) {
      enter[axis] = path_.entry(axis, leaf.end(axis));
      exit[axis] = path_.exit(axis, leaf.end(axis));
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
  ///   entered()                  is called for every cell on the way to the first leaf
  ///   across(leaf, axis, first)  moves to the first leaf behind the face, which the ray enters at `first`; false when
  ///                              it leaves the octree
  ///   visit(leaf)                is called with every leaf; true ends the walk
  /// Where the ray may leave by an edge or a vertex, the next leaf is searched from the root.
  template <class Reach, class Entered, class Across, class Visit>
  void walk(Real t_min, const Reach& reach, const Entered& entered, const Across& across,
            const Visit& visit) const {
    const Interval<Real> whole = path_.inside(whole_);
    const Real begin = std::max(whole.enter, t_min);
    if (!(begin <= std::min(whole.exit, reach()))) return;
    Cell leaf = first_leaf(root(), begin, entered);
    while (!visit(leaf)) {
      const int axis = exit_axis(leaf);
      if (axis < 3) [[likely]] {
        const Real enter = path_.entry(axis, leaf.end(axis));
        if (reach() < enter || !across(leaf, axis, std::max(enter, t_min))) return;
      } else if (!next_leaf(leaf, t_min, reach())) {
        return;
      }
    }
  }

 private:
  unsigned octant_at(const Layers& planes, Real first) const {
    unsigned octant = 0;
    for (int axis = 0; axis < 3; ++axis) octant |= unsigned{path_.exit(axis, planes[axis]) < first} << axis;
    return octant;
  }

  /// Move to the next leaf in order that the ray meets before `reach`; false when there is none.
  [[gnu::noinline, gnu::cold]] bool next_leaf(Cell& leaf, Real t_min, Real reach) const {
    const Layers from = leaf.corner;
    return next_below(root(), &from, t_min, reach, leaf);
  }

  /// The same for the leaves below a cell; `from` is where the leaf to come from begins, if it is among these.
  bool next_below(const Cell& cell, const Layers* from, Real t_min, Real reach, Cell& found) const {
    const Interval<Real> inside = path_.inside(cell);
    if (!(inside.enter <= inside.exit && inside.exit >= t_min && inside.enter <= reach)) return false;
    if (!tree_.interior(cell.node)) {
      found = cell;
      return from == nullptr;
    }
    const Layers planes = dividing(cell);
    const unsigned begin = from ? octant_of(*from, planes) : 0;
    for (unsigned octant = begin; octant < 8; ++octant)
      if (next_below(child(cell, planes, octant), octant == begin ? from : nullptr, t_min, reach, found))
        return true;
    return false;
  }

  const Tree& tree_;
  const LatticeRay<Real>& path_;
  LatticeCell whole_;
};

}  // namespace rayshoot
