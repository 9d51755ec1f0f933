// Binary space partitioning, recursive traversal (Arvo & Kirk §5.1, Figure 12)
// F. Jansen, "Data structures for ray tracing", 1986.
//
// Idea       The tree of bsp_kaplan: cells halved along x, y and z in turn. A ray goes down from the root once: where it
//            crosses the dividing plane inside a cell, its interval is cut there, and it visits the nearer child with the
//            part before and then the farther child with the part behind.
// Parameters max_depth, max_objects, mailbox
//                         as bsp_kaplan has them
// Cost       a step for every cell on the ray, leaves or not: none is visited twice.
// Weak       planes in the middle cut what they meet and leave empty space with its surface; kd_tree chooses them.

#include "accel/core/define_technique.h"
#include "accel/parts/bsp_technique.h"

namespace rayshoot {

namespace {

template <class Real>
class BspJansen : public BspTechnique<BspJansen, Real> {
  using BspTechnique<BspJansen, Real>::tree_;

 public:
  static TechniqueInfo info() {
    return {.id = "bsp_jansen",
            .title = "Binary space partitioning, recursive traversal",
            .family = "bsp",
            .survey_section = "5.1",
            .paper = "Jansen 1986",
            .parameters = bsp_parameters()};
  }

  template <class Counter, class Reach, class Visit>
  void visit_cells(const Ray<Real>& ray, Counter count, const Reach& reach, const Visit& visit) const {
    walk_clipped<false>(tree_, AxisTreeRay<Real>(ray), ray.t_min, count, reach,
                        [&](const auto& leaf) { return visit(tree_.objects(leaf)); });
  }
};

}  // namespace

RAYSHOOT_TECHNIQUE(bsp_jansen, BspJansen)

}  // namespace rayshoot
