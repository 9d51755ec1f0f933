// Recursive traversal of an octree by ordered plane crossings
// I. Gargantini, H. Atkinson, "Ray tracing an octree: numerical evaluation of the first intersection", 1993.
//
// Idea       A voxel is known by the interval of parameters during which the ray is inside. Its three dividing planes are
//            crossed at three parameters; sorted, they cut the interval into at most four, during each of which the ray is
//            in one child. Those children, in that order, are entered the same way.
// Parameters max_depth, max_objects, assignment, split, separating, mailbox
//                         of the octree, as octree_revelles has them
// Cost       three crossings and a sort for every interior voxel on the ray. Steps are the voxels that are entered, as many
//            as those of octree_revelles; the crossings that had to be sorted are counted.
// Weak       the recursion begins at the root for every ray.
//
// Exactness  As in octree_revelles: where the order of two crossings is in doubt, all eight children are asked.

#include "accel/core/define_technique.h"
#include "accel/parts/octree_technique.h"

namespace rayshoot {

namespace {

template <class Real>
class OctreeGargantini : public OctreeTechnique<OctreeGargantini, Real> {
  using Base = OctreeTechnique<OctreeGargantini, Real>;
  using Base::cells_;
  using typename Base::Cell;

 public:
  static TechniqueInfo info() {
    return {.id = "octree_gargantini",
            .title = "Octree, recursive traversal by ordered plane crossings",
            .family = "octree",
            .survey_section = "5.1",
            .paper = "Gargantini & Atkinson 1993",
            .parameters = OctreeCells<Real>::parameters(),
            .events = {"crossings_sorted"}};
  }

  template <class Counter, class Reach, class Visit>
  void traverse(const Ray<Real>& ray, Counter count, const Reach& reach, const Visit& visit) const {
    const LatticeRay<Real> path(cells_.lattice(), ray);
    const Cell root{cells_.lattice().whole(), cells_.root()};
    const Interval<Real> whole = path.inside(root);
    if (std::max(whole.enter, ray.t_min) <= std::min(whole.exit, reach()))
      Descent<Counter, Reach, Visit>{cells_, path, ray.t_min, count, reach, visit}.into(root, whole);
  }

 private:
  /// Where the ray crosses the plane that divides a voxel on an axis.
  struct Crossing {
    Real enter, exit;
    unsigned upper_half;
  };

  template <class Counter, class Reach, class Visit>
  struct Descent {
    const OctreeCells<Real>& cells;
    const LatticeRay<Real>& path;
    Real t_min;
    Counter count;
    const Reach& reach;
    const Visit& visit;

    /// Visit the leaves of a voxel in which the ray is during that interval; true when the visit must end.
    [[gnu::noinline]] bool into(const Cell& cell, const Interval<Real>& inside) const {
      count.step();
      if (!cell.node->interior()) return visit(cells.objects(*cell.node));

      // Cross the three dividing planes; those behind the entry only tell the first child.
      const Real first = std::max(inside.enter, t_min);
      Crossing crossings[3];
      Crossing ahead[3];
      int planes = 0;
      unsigned octant = 0;
      const Layers dividing = cells.dividing(cell.node, cell, path);
      for (int axis = 0; axis < 3; ++axis) {
        const Crossing crossing{path.entry(axis, dividing[axis]), path.exit(axis, dividing[axis]),
                                1u << axis};
        crossings[axis] = crossing;
        if (crossing.exit < first)
          octant |= crossing.upper_half;
        else
          ahead[planes++] = crossing;
      }

      // Sort the others. They divide the interval, and between one and the next the ray is in one child.
      count.event(0, static_cast<std::uint64_t>(planes));
      sort(ahead, planes);
      for (int k = 0; k + 1 < planes; ++k)
        if (!(ahead[k].exit < ahead[k + 1].enter)) [[unlikely]]
          return into_all(cell, dividing, inside, crossings);
      Real enter = inside.enter;
      for (int k = 0;; ++k) {
        const Interval<Real> part{enter, k < planes ? std::min(inside.exit, ahead[k].exit) : inside.exit};
        if (!met(part)) return false;
        if (part.enter <= reach() && into(child(cell, dividing, octant), part)) return true;
        if (k == planes) return false;
        octant |= ahead[k].upper_half;
        enter = std::max(inside.enter, ahead[k].enter);
      }
    }

    /// Where planes may be crossed together, by an edge or a vertex, ask every child.
    [[gnu::noinline, gnu::cold]] bool into_all(const Cell& cell, const Layers& dividing,
                                               const Interval<Real>& inside,
                                               const Crossing* crossings) const {
      for (unsigned octant = 0; octant < 8; ++octant) {
        const Interval<Real> part = within(inside, crossings, octant);
        if (met(part) && part.enter <= reach() && into(child(cell, dividing, octant), part)) return true;
      }
      return false;
    }

    static void sort(Crossing* ahead, int planes) {
      for (int k = 1; k < planes; ++k)
        for (int i = k; i > 0 && ahead[i].enter < ahead[i - 1].enter; --i) std::swap(ahead[i], ahead[i - 1]);
    }

    /// The part of a voxel's interval in which the ray is in a child.
    static Interval<Real> within(Interval<Real> part, const Crossing* crossings, unsigned octant) {
      for (int axis = 0; axis < 3; ++axis)
        if (octant >> axis & 1)
          part.enter = std::max(part.enter, crossings[axis].enter);
        else
          part.exit = std::min(part.exit, crossings[axis].exit);
      return part;
    }
    bool met(const Interval<Real>& part) const { return part.enter <= part.exit && part.exit >= t_min; }
    Cell child(const Cell& cell, const Layers& dividing, unsigned octant) const {
      return {cell.child(octant, dividing), cells.child(cell.node, octant ^ path.mirror())};
    }
  };
};

}  // namespace

RAYSHOOT_TECHNIQUE(octree_gargantini, OctreeGargantini)

}  // namespace rayshoot
