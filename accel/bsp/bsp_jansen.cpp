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
#include "accel/parts/bsp_build.h"
#include "accel/parts/visit_cells.h"

namespace rayshoot {

namespace {

template <class Real>
class BspJansen {
 public:
  using Scalar = Real;
  using Config = BspConfig;
  using Scratch = Mailbox;

  static TechniqueInfo info() {
    return {.id = "bsp_jansen",
            .title = "Binary space partitioning, recursive traversal",
            .family = "bsp",
            .survey_section = "5.1",
            .paper = "Jansen 1986",
            .parameters = bsp_parameters()};
  }
  static Config configure(const Arguments& arguments) { return bsp_config(arguments); }

  static BspJansen build(const BuildInput<Real>& in, const Config& config) {
    BspJansen technique;
    technique.tree_ = build_bsp(in.geometry, config);
    if (wants_mailbox(config.mailbox, technique.tree_.references.size(), in.geometry.size()))
      technique.mailboxes_ = in.geometry.size();
    return technique;
  }

  Scratch scratch() const { return Mailbox(mailboxes_); }
  StructureStats structure() const { return tree_.structure(); }

  template <class Counter, class L>
  void visit(const Ray<Real>& ray, Scratch& mailbox, Counter count, L& leaf) const {
    visit_objects_of_cells(*this, ray, mailbox, count, leaf);
  }

  template <class Counter, class Reach, class Visit>
  void visit_cells(const Ray<Real>& ray, Counter count, const Reach& reach, const Visit& visit) const {
    walk_clipped<false>(tree_, AxisTreeRay<Real>(ray), ray.t_min, count, reach,
                        [&](const auto& leaf) { return visit(tree_.objects(leaf)); });
  }

 private:
  AxisTree<Real> tree_;
  std::uint32_t mailboxes_ = 0;
};

}  // namespace

RAYSHOOT_TECHNIQUE(bsp_jansen, BspJansen)

}  // namespace rayshoot
