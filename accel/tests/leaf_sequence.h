#pragma once

#include "accel/parts/octree_cells.h"
#include "accel/tests/built_engine.h"
#include "accel/tests/conformance.h"

/// Which leaves of an octree a ray meets, in which order, for tests of its traversals.
namespace rayshoot::octrees {

using Objects = std::vector<std::uint32_t>;

inline const OctreeLimits kLimits{.max_depth = 5, .max_objects = 2, .assignment = Assignment::box};
inline const Given kGiven{{"max_depth", "5"}, {"max_objects", "2"}, {"assignment", "box"}};

/// Rays along the planes, edges and diagonals of the cells of an octree, besides those of the conformance tests.
inline std::vector<Ray<double>> rays_through(const Geometry<double>& geometry,
                                             const Lattice<double>& lattice) {
  std::vector<Ray<double>> rays = nasty::rays(geometry, 1, 150);
  const Vec3d diagonal = lattice.step * lattice.layers();
  for (int k = 0; k <= lattice.layers(); k += 2)
    for (unsigned signs = 0; signs < 8; ++signs) {
      const Vec3d to{signs & 1 ? -1.0 : 1.0, signs & 2 ? -1.0 : 1.0, signs & 4 ? -1.0 : 1.0};
      const Vec3d corner{lattice.plane(0, k), lattice.plane(1, lattice.layers() / 2),
                         lattice.plane(2, lattice.layers() - k)};
      const Vec3d along{to.x * diagonal.x, to.y * diagonal.y, to.z * diagonal.z};
      rays.push_back({.origin = corner - along * 2, .direction = along});
      rays.push_back({.origin = corner, .direction = along});
      for (int axis = 0; axis < 3; ++axis) {
        Vec3d parallel{};
        parallel[axis] = to[axis];
        rays.push_back({.origin = corner - parallel * 100, .direction = parallel});
      }
    }
  return rays;
}

/// Calls visit(node) for the nodes whose closed intervals on the ray are not empty, depth first and in increasing order of
/// octants as the ray sees them, found by asking every child of every such node.
template <class Visit>
void for_each_met(const Octree<double>& octree, const Ray<double>& ray, const Visit& visit) {
  using Cell = CellOnRay<double, const Octree<double>::Node*>;
  const LatticeRay<double> path(octree.lattice, ray);
  std::vector<Cell> cells{{octree.nodes.data(), {0, 0, 0}, octree.lattice.layers()}};
  while (!cells.empty()) {
    const Cell cell = cells.back();
    cells.pop_back();
    const Interval<double> inside = path.inside(cell.corner, cell.size);
    if (!(inside.enter <= inside.exit && inside.exit >= ray.t_min && inside.enter <= ray.t_max)) continue;
    visit(*cell.node);
    if (cell.node->interior())
      for (unsigned octant = 8; octant-- > 0;)
        cells.push_back(
            cell.child(octree.nodes.data() + cell.node->first + (octant ^ path.mirror()), octant));
  }
}

/// The objects of each leaf that the ray meets, in that order.
inline std::vector<Objects> leaves_on(const Octree<double>& octree, const Ray<double>& ray) {
  std::vector<Objects> leaves;
  for_each_met(octree, ray, [&](const Octree<double>::Node& node) {
    if (!node.interior()) leaves.emplace_back(octree.objects(node).begin(), octree.objects(node).end());
  });
  return leaves;
}

/// The same as a technique visits them.
template <class Technique>
std::vector<Objects> visited_by(const Technique& technique, const Ray<double>& ray) {
  std::vector<Objects> leaves;
  technique.visit_cells(
      ray, NoCount{}, [&] { return ray.t_max; },
      [&](std::span<const std::uint32_t> objects) {
        leaves.emplace_back(objects.begin(), objects.end());
        return false;
      });
  return leaves;
}

/// A technique visits exactly those leaves, in that order, on all those rays.
template <class Technique>
void check_leaves_in_order() {
  const Geometry<double> geometry(soup_scene(200));
  const Octree<double> octree = build_octree(geometry, kLimits);
  const auto technique = Technique::build({geometry}, {.limits = kLimits, .mailbox = MailboxUse::automatic});
  std::size_t leaves = 0;
  for (const Ray<double>& ray : rays_through(geometry, octree.lattice)) {
    if (!(ray.t_min <= ray.t_max)) continue;
    const std::vector<Objects> expected = leaves_on(octree, ray);
    ASSERT_EQ(visited_by(technique, ray), expected) << conformance::describe(ray);
    leaves += expected.size();
  }
  EXPECT_GT(leaves, 5000u);
}

}  // namespace rayshoot::octrees
