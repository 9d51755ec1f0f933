#pragma once

#include "accel/parts/octree_cells.h"
#include "accel/parts/visit_cells.h"

namespace rayshoot {

/// What the techniques with explicit nodes have in common: all but the way through them. `Traversal<Real>`, which derives
/// from this, defines info() and
///   traverse(ray, count, reach, visit)  as `visit_cells`, for rays that need no margin (visit_cells.h)
template <template <class> class Traversal, class Real>
class OctreeTechnique {
 public:
  using Scalar = Real;
  using Config = OctreeCellsConfig;
  using Scratch = Mailbox;

  static Config configure(const Arguments& arguments) { return OctreeCells<Real>::configure(arguments); }

  static Traversal<Real> build(const BuildInput<Real>& in, const Config& config) {
    Traversal<Real> technique;
    static_cast<OctreeTechnique&>(technique).cells_ = OctreeCells<Real>(in.geometry, config);
    return technique;
  }

  Scratch scratch() const { return cells_.mailbox(); }
  StructureStats structure() const { return cells_.structure(); }

  template <class Counter, class L>
  void visit(const Ray<Real>& ray, Scratch& mailbox, Counter count, L& leaf) const {
    visit_objects_of_cells(static_cast<const Traversal<Real>&>(*this), ray, mailbox, count, leaf);
  }

  template <class Counter, class Reach, class Visit>
  void visit_cells(const Ray<Real>& ray, Counter count, const Reach& reach, const Visit& visit) const {
    if (const Real margin = cells_.margin(ray); margin != 0) [[unlikely]]
      return visit_within(margin, ray, count, reach, visit);
    static_cast<const Traversal<Real>&>(*this).traverse(ray, count, reach, visit);
  }

  bool widens_cells() const { return cells_.widens_cells(); }
  const Traversal<Real>& cells(Scratch&) const { return static_cast<const Traversal<Real>&>(*this); }
  template <class Visit>
  void for_each_cell(const Visit& visit) const {
    cells_.for_each_cell(visit);
  }

 protected:
  using Node = typename OctreeCells<Real>::Node;
  using Cell = typename OctreeCells<Real>::Cell;

  OctreeCells<Real> cells_;

 private:
  /// Visit every leaf that the ray passes at no more than that margin, for rays too far away for the surfaces' margin.
  template <class Counter, class Reach, class Visit>
  [[gnu::noinline, gnu::cold]] void visit_within(Real margin, const Ray<Real>& ray, Counter count,
                                                 const Reach& reach, const Visit& visit) const {
    const LatticeRay<Real> path(cells_.lattice(), ray);
    const LeafOrder<Real, OctreeCells<Real>> order(cells_, path, cells_.lattice());
    order.visit_leaves(
        order.root(),
        [&](const Cell& cell) {
          const bool near = order.near(cell, margin, ray.t_min, reach());
          if (near) count.step();
          return near;
        },
        [&](const Cell& cell) { return visit(cells_.objects(*cell.node)); });
  }
};

}  // namespace rayshoot
