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
// Memory     beside the tree, a copy of an object for every leaf that lists it, side by side, as all octrees of explicit nodes.
//            The three axes are worked out in lanes.
// Weak       interior voxels are visited again for every ray, so deep trees over small scenes cost more than a grid.
//
// Exactness  Every plane has an earliest and a latest parameter. Where those of two dividing planes overlap, the ray may
//            pass an edge or a vertex: then all children are compared, and those touched are visited too.

#include "accel/core/define_technique.h"
#include "accel/parts/lattice_lanes.h"
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

    const LatticeLanes<Real> lanes(cells_.lattice(), path);
    Voxel stack[kMaxOctreeDepth];
    int top = 0;
    stack[0].begin_root(root, lanes);
    stack[0].divide(cells_, path, lanes, std::max(whole.enter, ray.t_min));
    while (true) {
      // Take the child that the ray is in, and find the one after it.
      Voxel& voxel = stack[top];
      const unsigned octant = voxel.octant;
      const Real enter = voxel.enter;
      voxel.go_on(ray.t_min);
      if (enter <= reach()) {
        count.step();
        const auto* node = cells_.child(voxel.node, octant ^ path.mirror());
        if (node->interior()) {
          // Go down, and do not come back where no child is left.
          top += voxel.octant < 8;
          stack[top].begin_child(voxel, octant, node);
          stack[top].divide(cells_, path, lanes, std::max(enter, ray.t_min));
          continue;
        }
        if (visit(cells_.objects(*node))) return;
      }
      // Come back to where a child is left.
      if (voxel.octant >= 8 && --top < 0) return;
    }
  }

 private:
  /// An interior voxel on the ray, and the child to be visited next, 8 when there is none. Halves are numbered as the ray
  /// comes to them.
  struct Voxel {
    using Vector = Lanes<Real>;

    const typename OctreeCells<Real>::Node* node;
    /// Its faces and the planes that divide it, as numbers of planes.
    Vector begins, divided, ends;
    /// Earliest parameters at which the ray may come into a half, and latest at which it may leave it.
    Vector enters[2], leaves[2];
    unsigned octant;
    /// Whether the order of the dividing planes is in doubt, so that all children are compared.
    bool in_doubt;
    /// Earliest parameter in the next child.
    Real enter;

    void begin_root(const Cell& root, const LatticeLanes<Real>& lanes) {
      node = root.node;
      begins = in_lanes<Real>(root.corner), ends = begins + in_lanes<Real>(root.size);
      enters[0] = lanes.entry(lanes.away(begins)), leaves[1] = lanes.exit(lanes.away(ends));
    }
    /// Become a child, whose faces are its parent's faces and dividing planes; the parent may be itself.
    void begin_child(const Voxel& parent, unsigned child, const typename OctreeCells<Real>::Node* here) {
      const auto upper = upper_halves<Real>(child);
      node = here;
      begins = upper ? parent.divided : parent.begins, ends = upper ? parent.ends : parent.divided;
      enters[0] = upper ? parent.enters[1] : parent.enters[0];
      leaves[1] = upper ? parent.leaves[1] : parent.leaves[0];
    }
    /// Cross the dividing planes, and find the child that the ray is in at `first`, beyond each plane that it has
    /// certainly passed (first_node of the paper).
    void divide(const OctreeCells<Real>& cells, const LatticeRay<Real>& path, const LatticeLanes<Real>& lanes,
                Real first) {
      divided = cells.divided_alike() ? (begins + ends) / 2 : in_lanes<Real>(cells.chosen_planes(node, path));
      const Vector away = lanes.away(divided);
      enters[1] = lanes.entry(away), leaves[0] = lanes.exit(away);
      in_doubt = false;
      octant = axes_of(leaves[0] < first);
      enter = inside(octant).enter;
    }

    /// The closed interval of parameters inside a child.
    Interval<Real> inside(unsigned child) const {
      const auto upper = upper_halves<Real>(child);
      return {largest(upper ? enters[1] : enters[0]), smallest(upper ? leaves[1] : leaves[0])};
    }
    /// Whether a ray that begins at `t_min` may touch a child, which becomes the next one.
    bool meets(unsigned child, Real t_min) {
      const Interval<Real> within = inside(child);
      octant = child, enter = within.enter;
      return within.enter <= within.exit && within.exit >= t_min;
    }

    /// new_node of the paper: the ray leaves a child by the first of the dividing planes before it, and the voxel when
    /// there is none.
    void go_on(Real t_min) {
      if (in_doubt) return try_others(t_min);
      const Vector never = Vector{} + Box<Real>::infinity();
      const auto upper = upper_halves<Real>(octant);
      const Vector leave = upper ? never : leaves[0], pass = upper ? never : enters[1];
      const unsigned first = axes_of((leave < __builtin_shufflevector(pass, pass, 1, 2, 0, 3)) &
                                     (leave < __builtin_shufflevector(pass, pass, 2, 0, 1, 3)));
      if (first != 0) {
        if (!meets(octant | (first & -first), t_min)) octant = 8;
      } else if (octant == 7) {
        octant = 8;
      } else {
        in_doubt = true;
        try_others(t_min);
      }
    }
    /// Go on to the next child, in increasing order, that the ray may touch.
    [[gnu::noinline, gnu::cold]] void try_others(Real t_min) {
      while (++octant < 8 && !meets(octant, t_min)) {
      }
    }
  };
};

}  // namespace

RAYSHOOT_TECHNIQUE(octree_revelles, OctreeRevelles)

}  // namespace rayshoot
