#pragma once

#include "accel/parts/bsp_build.h"
#include "accel/parts/visit_cells.h"

namespace rayshoot {

/// What bsp_kaplan and bsp_jansen have in common: all but the way through the tree. `Traversal<Real>`, which derives from
/// this, defines info() and visit_cells(ray, count, reach, visit) (visit_cells.h).
template <template <class> class Traversal, class Real>
class BspTechnique {
 public:
  using Scalar = Real;
  using Config = BspConfig;
  using Scratch = Mailbox;

  static Config configure(const Arguments& arguments) { return bsp_config(arguments); }

  static Traversal<Real> build(const BuildInput<Real>& in, const Config& config) {
    Traversal<Real> technique;
    BspTechnique& shared = technique;
    shared.tree_ = build_bsp(in.geometry, config);
    if (wants_mailbox(config.mailbox, shared.tree_.references.size(), in.geometry.size()))
      shared.mailboxes_ = in.geometry.size();
    return technique;
  }

  Scratch scratch() const { return Mailbox(mailboxes_); }
  StructureStats structure() const { return tree_.structure(); }

  template <class Counter, class L>
  void visit(const Ray<Real>& ray, Scratch& mailbox, Counter count, L& leaf) const {
    visit_objects_of_cells(static_cast<const Traversal<Real>&>(*this), ray, mailbox, count, leaf);
  }

  const Traversal<Real>& cells(Scratch&) const { return static_cast<const Traversal<Real>&>(*this); }
  template <class Visit>
  void for_each_cell(const Visit& visit) const {
    tree_.for_each_cell(visit);
  }

 protected:
  AxisTree<Real> tree_;

 private:
  std::uint32_t mailboxes_ = 0;
};

}  // namespace rayshoot
