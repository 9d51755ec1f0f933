// Parametric traversal of an octree (Revelles, Ureña & Lastra 2000)
// J. Revelles, C. Ureña, M. Lastra, "An efficient parametric algorithm for octree traversal", 2000.
//
// Idea       Go down from the root. The parameters at which the ray crosses the planes of a voxel follow from those of
//            its parent: the faces are known, and only three dividing planes are new. Comparing them tells the first
//            child that the ray enters, and then the next one from the one it is in, without any point in space.
// Parameters max_depth    divisions below the root; 0 suits it to the number of objects as octree_glassner does
//            max_objects  a voxel with that many objects or fewer is not divided; 8, as octree_glassner
//            assignment   surface lists an object where its surface penetrates, box where its bounds touch
//            split        centre divides a voxel in its middle; cost where the surfaces of the parts, each times its objects,
//                         sum up to the least, as MacDonald and Booth's planes, on each axis by itself
//            separating   on: a voxel that two divisions in a row would not separate is a leaf at once; off only limits end
//                         division, as in Havran's octrees
//            mailbox      auto: where an object is listed twice
// Cost       six products for every interior voxel on the ray, and a comparison for every child; no look-ups from the
//            root. Steps are the voxels that are entered.
// Weak       interior voxels are visited again for every ray, so deep trees over small scenes cost more than a grid.
//
// Exactness  Every plane has an earliest and a latest parameter. Where those of two dividing planes overlap, the ray may
//            pass an edge or a vertex: then all children are compared, and those touched are visited too.

#include "accel/core/define_technique.h"
#include "accel/parts/octree_technique.h"

namespace rayshoot {

namespace {

template <class Real>
class OctreeRevelles : public OctreeTechnique<OctreeRevelles, Real> {
  using Base = OctreeTechnique<OctreeRevelles, Real>;
  using Base::cells_;
  using typename Base::Cell;

 public:
  static TechniqueInfo info() {
    return {.id = "octree_revelles",
            .title = "Octree, parametric traversal from the root",
            .family = "octree",
            .survey_section = "5.1",
            .paper = "Revelles, Ureña & Lastra 2000",
            .parameters = OctreeCells<Real>::parameters()};
  }

  /// proc_subtree of the paper, with a stack of its own.
  template <class Counter, class Reach, class Visit>
  void traverse(const Ray<Real>& ray, Counter count, const Reach& reach, const Visit& visit) const {
    // Leave out rays that miss the root; a root that is a leaf is all there is.
    const LatticeRay<Real> path(cells_.lattice(), ray);
    const Cell root{cells_.lattice().whole(), cells_.root()};
    const Interval<Real> whole = path.inside(root);
    if (!(std::max(whole.enter, ray.t_min) <= std::min(whole.exit, reach()))) return;
    count.step();
    if (!root.node->interior()) {
      visit(cells_.objects(*root.node));
      return;
    }

    Voxel stack[kMaxOctreeDepth];
    int top = 0;
    stack[0].begin(root, cells_, path);
    stack[0].planes.begin(path, root, stack[0].dividing);
    stack[0].octant = first_child(stack[0].planes, ray.t_min);
    while (top >= 0) {
      // Take the child that the ray is in, and find the one after it.
      Voxel& voxel = stack[top];
      const unsigned octant = voxel.octant;
      if (octant >= 8) {
        --top;
        continue;
      }
      voxel.octant = next_child(voxel, octant, ray.t_min);
      const Interval<Real> inside = voxel.planes.inside(octant);
      if (!(inside.enter <= reach())) continue;
      count.step();

      // Visit it if it is a leaf, and go down otherwise.
      const auto* node = cells_.child(voxel.cell.node, octant ^ path.mirror());
      if (!node->interior()) {
        if (visit(cells_.objects(*node))) return;
        continue;
      }
      Voxel& below = stack[++top];
      below.begin({voxel.cell.child(octant, voxel.dividing), node}, cells_, path);
      below.planes.begin_child(path, below.dividing, voxel.planes, octant);
      below.octant = first_child(below.planes, ray.t_min);
    }
  }

 private:
  /// An interior voxel on the ray, and the child to be visited next, 8 when there is none.
  struct Voxel {
    Cell cell;
    /// The layers at which it is divided, and where the ray crosses these planes and its faces.
    Layers dividing;
    DividedCell<Real> planes;
    unsigned octant;
    /// Whether the order of the dividing planes is in doubt, so that all children are compared.
    bool in_doubt;

    void begin(const Cell& here, const OctreeCells<Real>& cells, const LatticeRay<Real>& path) {
      cell = here, dividing = cells.dividing(here.node, here, path), in_doubt = false;
    }
  };

  /// first_node of the paper: the child that the ray is in first, beyond each plane that it has certainly passed.
  static unsigned first_child(const DividedCell<Real>& planes, Real t_min) {
    const Real first = planes.first(t_min);
    return (planes.exit[0][0] < first ? 1u : 0u) | (planes.exit[0][1] < first ? 2u : 0u) |
           (planes.exit[0][2] < first ? 4u : 0u);
  }

  /// new_node of the paper: the ray leaves a child by the first of the dividing planes before it, and the voxel when
  /// there is none.
  static unsigned next_child(Voxel& voxel, unsigned octant, Real t_min) {
    if (voxel.in_doubt) return voxel.planes.next_met(octant, t_min);
    constexpr Real never = Box<Real>::infinity();
    const auto& leave = voxel.planes.exit[0];
    const Real x = octant & 1 ? never : leave[0], y = octant & 2 ? never : leave[1],
               z = octant & 4 ? never : leave[2];
    const auto& pass = voxel.planes.enter[1];
    const Real x_earliest = octant & 1 ? never : pass[0], y_earliest = octant & 2 ? never : pass[1],
               z_earliest = octant & 4 ? never : pass[2];
    unsigned next = 8;
    if (x < y_earliest && x < z_earliest)
      next = octant | 1;
    else if (y < x_earliest && y < z_earliest)
      next = octant | 2;
    else if (z < x_earliest && z < y_earliest)
      next = octant | 4;
    else if (octant != 7) {
      voxel.in_doubt = true;
      return voxel.planes.next_met(octant, t_min);
    }
    return next < 8 && voxel.planes.met(next, t_min) ? next : 8;
  }
};

}  // namespace

RAYSHOOT_TECHNIQUE(octree_revelles, OctreeRevelles)

}  // namespace rayshoot
