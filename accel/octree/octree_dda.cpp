// Octree traversal by a 3-D DDA among siblings and vertical steps (Arvo & Kirk §5.1)
// A. Fujimoto, T. Tanaka, K. Iwata, "ARTS: accelerated ray-tracing system", 1986.
//
// Idea       Among the eight children of a voxel a ray moves as in a grid of 2x2x2, with the three-dimensional digital
//            differential analyser. Where a step leads out of their parent, it goes up, level by level, until it can be
//            made among siblings; where it leads into a divided voxel, it goes down to the child that the ray enters.
// Parameters max_depth, max_objects, assignment, split, separating, mailbox
//                         of the octree, as octree_revelles has them
// Cost       a horizontal step for each voxel, and as many vertical ones as levels lie between; all are steps, and are
//            counted apart.
// Weak       as Fujimoto et al. observe themselves, vertical steps: a grid of the same smallest voxels has none.
//
// Exactness  Steps go through the inside of a face alone; where the ray may leave by an edge or a vertex, the voxels
//            touched are searched from the root (leaf_order.h). Crossings are computed from the planes, where the paper
//            adds increments.

#include "accel/core/define_technique.h"
#include "accel/parts/octree_technique.h"

namespace rayshoot {

namespace {

template <class Real>
class OctreeDda : public OctreeTechnique<OctreeDda, Real> {
  using Base = OctreeTechnique<OctreeDda, Real>;
  using Base::cells_;
  using typename Base::Node;

 public:
  static TechniqueInfo info() {
    return {.id = "octree_dda",
            .title = "Octree, 3-D DDA among siblings and vertical traversal",
            .family = "octree",
            .survey_section = "5.1",
            .paper = "Fujimoto, Tanaka & Iwata 1986",
            .parameters = OctreeCells<Real>::parameters(),
            .events = {"horizontal_steps", "steps_up", "steps_down"}};
  }

  template <class Counter, class Reach, class Visit>
  void traverse(const Ray<Real>& ray, Counter count, const Reach& reach, const Visit& visit) const {
    const LatticeRay<Real> path(cells_.lattice(), ray);
    const Ancestry tree(cells_);
    const LeafOrder<Real, Ancestry> order(tree, path, cells_.lattice());
    const auto down = [&] { count.step(), count.event(steps_down); };
    const auto across = [&](Voxel& voxel, int axis, Real first) {
      // Vertical traversal: leave every voxel of which this is the farther half.
      const unsigned on_axis = 1u << axis, farther = on_axis & ~path.mirror();
      Placed from = voxel.node;
      int levels = 0;
      for (; from.level > 0 && (cells_.octant(from.node) & on_axis) == farther; ++levels) {
        count.step(), count.event(steps_up);
        from = tree.ancestor(from.level - 1);
      }
      if (from.level == 0) return false;

      // Horizontal traversal: step to the sibling on that axis.
      count.step(), count.event(horizontal_steps);
      const Placed sibling = tree.child(tree.ancestor(from.level - 1), cells_.octant(from.node) ^ on_axis);
      voxel = {cells_.behind(axis, voxel, sibling.node, levels, path), sibling};

      // Vertical traversal: enter divided voxels down to a leaf.
      voxel = order.first_leaf(voxel, first, down);
      return true;
    };
    order.walk(ray.t_min, reach, down, across,
               [&](const Voxel& voxel) { return visit(cells_.objects(*voxel.node.node)); });
  }

 private:
  enum Event : std::size_t { horizontal_steps, steps_up, steps_down };

  struct Placed {
    const Node* node;
    int level;
  };
  using Voxel = CellOnRay<Placed>;

  /// The nodes as a tree that remembers the way down to the node that was asked for last.
  class Ancestry {
   public:
    explicit Ancestry(const OctreeCells<Real>& cells) : cells_(cells) {}

    Placed root() const { return {cells_.root(), 0}; }
    bool interior(const Placed& placed) const { return placed.node->interior(); }
    Layers dividing(const Placed& placed, const LatticeCell& cell, const LatticeRay<Real>& path) const {
      return cells_.dividing(placed.node, cell, path);
    }
    Placed child(const Placed& parent, unsigned octant) const {
      ancestors_[parent.level] = parent.node;
      return {cells_.child(parent.node, octant), parent.level + 1};
    }
    Placed ancestor(int level) const { return {ancestors_[level], level}; }

   private:
    const OctreeCells<Real>& cells_;
    mutable std::array<const Node*, kMaxOctreeDepth> ancestors_;
  };
};

}  // namespace

RAYSHOOT_TECHNIQUE(octree_dda, OctreeDda)

}  // namespace rayshoot
