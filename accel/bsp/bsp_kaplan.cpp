// Binary space partitioning, sequential traversal (Arvo & Kirk §5.1, Figure 9)
// M. Kaplan, "Space-tracing: a constant time ray-tracer", 1985.
//
// Idea       Halve the box of the scene by planes along x, y and z in turn until few objects are in a cell: a binary tree
//            with explicit children. A ray locates the leaf that holds its origin by comparing the point with a plane on
//            every level, tests the leaf's objects, and locates the point just beyond the leaf, from the root.
// Parameters max_depth    divisions above a leaf at the most; 0: three for each of octree_glassner's, of the same depth in
//                         space
//            max_objects  a cell with that many objects or fewer is not divided; 8, as the octrees
//            mailbox      auto: where an object is listed twice
// Cost       for each leaf on the ray as many comparisons as it is deep, and its objects. Steps are the nodes passed.
// Weak       the way from the root is repeated for every leaf; bsp_jansen goes it once.
//
// Exactness  The point is nowhere computed: on which side of a plane it lies follows from comparing the parameter at which
//            the ray leaves the last leaf with that at which it crosses the plane. Where they may be equal, the ray leaves
//            by an edge or nearly so, and the rest of its way is found as bsp_jansen finds it, with one more walk from the
//            root: both visit the same leaves in the same order. Such rays are counted.

#include "accel/core/define_technique.h"
#include "accel/parts/bsp_technique.h"

namespace rayshoot {

namespace {

template <class Real>
class BspKaplan : public BspTechnique<BspKaplan, Real> {
  using BspTechnique<BspKaplan, Real>::tree_;

 public:
  static TechniqueInfo info() {
    return {.id = "bsp_kaplan",
            .title = "Binary space partitioning, sequential traversal",
            .family = "bsp",
            .survey_section = "5.1",
            .paper = "Kaplan 1985",
            .parameters = bsp_parameters(),
            .events = {"points_located", "rays_clipped"}};
  }

  template <class Counter, class Reach, class Visit>
  void visit_cells(const Ray<Real>& ray, Counter count, const Reach& reach, const Visit& visit) const {
    // Locate the origin, or the point where the ray enters the box of the scene.
    if (tree_.empty()) return;
    const AxisTreeRay<Real> path(ray);
    const Interval<Real> whole = path.inside(tree_.box);
    const Real begin = std::max(whole.enter, ray.t_min);
    if (!(begin <= std::min(whole.exit, reach()))) return;
    Place place = located(path, count, [&](int, Real, const Interval<Real>& crossing) {
      return crossing.exit < begin ? Side::farther : Side::nearer;
    });

    while (!visit(tree_.objects(*place.leaf))) {
      // Find where the ray leaves the leaf, and end there if it ends before or leaves the scene.
      const Exit exit = exit_of(place, path);
      if (exit.certain() && (reach() < exit.at.enter || exit.plane == farther_face(exit.axis, path))) return;

      // Locate the point behind it.
      Place next;
      if (exit.certain())
        next = located(path, count, [&](int axis, Real plane, const Interval<Real>& crossing) {
          return exit.side_of(axis, plane, crossing, path.backwards(axis));
        });
      if (!next.leaf) return visit_following(*place.leaf, path, ray.t_min, count, reach, visit);
      place = next;
    }
  }

 private:
  enum Event : std::size_t { points_located, rays_clipped };
  using Node = typename AxisTree<Real>::Node;

  enum class Side { nearer, farther, in_doubt };

  /// A leaf, or none, and on each axis the face by which the ray would leave it.
  struct Place {
    const Node* leaf = nullptr;
    Real farther[3]{};
  };

  /// The face by which a ray leaves a leaf.
  struct Exit {
    int axis = -1;
    Real plane = 0;
    Interval<Real> at{};

    /// Whether the ray leaves by the inside of that face.
    bool certain() const { return axis >= 0; }

    /// On which side of a dividing plane the point just behind the face lies.
    Side side_of(int of_axis, Real of_plane, const Interval<Real>& crossing, bool backwards) const {
      if (of_axis == axis)
        return (backwards ? of_plane >= plane : of_plane <= plane) ? Side::farther : Side::nearer;
      return crossing.exit < at.enter   ? Side::farther
             : at.exit < crossing.enter ? Side::nearer
                                        : Side::in_doubt;
    }
  };

  Real farther_face(int axis, const AxisTreeRay<Real>& path) const {
    return path.backwards(axis) ? tree_.box.lo[axis] : tree_.box.hi[axis];
  }

  /// Go down from the root to the leaf of a point, by the side of each plane on which it lies; to none where that is in
  /// doubt.
  template <class Counter, class SideOf>
  Place located(const AxisTreeRay<Real>& path, Counter count, const SideOf& side_of) const {
    count.event(points_located);
    Place place;
    for (int axis = 0; axis < 3; ++axis) place.farther[axis] = farther_face(axis, path);
    const Node* node = tree_.nodes.data();
    for (; !node->is_leaf(); count.step()) {
      const int axis = node->axis();
      const Side side = side_of(axis, node->plane(), path.near(axis, node->plane()));
      if (side == Side::in_doubt) return {};
      if (side == Side::nearer) place.farther[axis] = node->plane();
      node += (side == Side::farther) != path.backwards(axis) ? node->upper() : 1;
    }
    count.step();
    place.leaf = node;
    return place;
  }

  Exit exit_of(const Place& place, const AxisTreeRay<Real>& path) const {
    Interval<Real> at[3];
    for (int axis = 0; axis < 3; ++axis) at[axis] = path.near(axis, place.farther[axis]);
    for (int axis = 0; axis < 3; ++axis)
      if (at[axis].exit < at[(axis + 1) % 3].enter && at[axis].exit < at[(axis + 2) % 3].enter)
        return {axis, place.farther[axis], at[axis]};
    return {};
  }

  /// Visit the leaves that follow one on the ray, by clipping.
  template <class Counter, class Reach, class Visit>
  [[gnu::noinline, gnu::cold]] void visit_following(const Node& leaf, const AxisTreeRay<Real>& path,
                                                    Real t_min, Counter count, const Reach& reach,
                                                    const Visit& visit) const {
    count.event(rays_clipped);
    bool passed = false;
    walk_clipped<false>(tree_, path, t_min, count, reach, [&](const Node& visited) {
      if (passed) return visit(tree_.objects(visited));
      passed = &visited == &leaf;
      return false;
    });
  }
};

}  // namespace

RAYSHOOT_TECHNIQUE(bsp_kaplan, BspKaplan)

}  // namespace rayshoot
