#pragma once

#include "accel/parts/octree_cells.h"
#include "accel/tests/built_engine.h"
#include "accel/tests/conformance.h"

/// Which leaves of an octree a ray meets, in which order, for tests of its traversals.
namespace rayshoot::octrees {

using Objects = std::vector<std::uint32_t>;

inline const OctreeLimits kLimits{.max_depth = 5, .max_objects = 2, .assignment = Assignment::box};
inline const Given kGiven{{"max_depth", "5"}, {"max_objects", "2"}, {"assignment", "box"}};

/// Rays along the planes, edges and diagonals of cells of a lattice, besides those of the conformance tests.
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

/// The same of an octree: where its planes were chosen, rays along the edges at which these meet, and from there away.
inline std::vector<Ray<double>> rays_through(const Geometry<double>& geometry, const Octree<double>& octree) {
  if (octree.places.empty()) return rays_through(geometry, octree.lattice);
  std::vector<Ray<double>> rays = nasty::rays(geometry, 1, 150);
  for (std::size_t node = 0; node < octree.nodes.size(); ++node) {
    if (!octree.nodes[node].interior()) continue;
    Vec3d at;
    for (int axis = 0; axis < 3; ++axis)
      at[axis] = octree.lattice.plane(axis, octree.places[node].planes[axis]);
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {-1.0, 1.0}) {
        Vec3d parallel{}, slanted{sign, 1, -1};
        parallel[axis] = sign;
        std::swap(slanted[0], slanted[axis]);
        rays.push_back({.origin = at - parallel * 100, .direction = parallel});
        rays.push_back({.origin = at, .direction = slanted});
      }
  }
  return rays;
}

/// Calls visit(node) for the nodes whose closed intervals on the ray are not empty, depth first and in increasing order of
/// octants as the ray sees them, found by asking every child of every such node.
template <class Visit>
void for_each_met(const Octree<double>& octree, const Ray<double>& ray, const Visit& visit) {
  using Cell = CellOnRay<const Octree<double>::Node*>;
  const LatticeRay<double> path(octree.lattice, ray);
  std::vector<Cell> cells{{octree.lattice.whole(), octree.nodes.data()}};
  while (!cells.empty()) {
    const Cell cell = cells.back();
    cells.pop_back();
    const Interval<double> inside = path.inside(cell);
    if (!(inside.enter <= inside.exit && inside.exit >= ray.t_min && inside.enter <= ray.t_max)) continue;
    visit(*cell.node);
    if (!cell.node->interior()) continue;
    const auto number = static_cast<std::size_t>(cell.node - octree.nodes.data());
    const Layers planes = octree.dividing(number, cell, path);
    for (unsigned octant = 8; octant-- > 0;)
      cells.push_back(
          {cell.child(octant, planes), octree.nodes.data() + cell.node->first + (octant ^ path.mirror())});
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
void check_leaves_in_order(const OctreeLimits& limits) {
  const Geometry<double> geometry(soup_scene(200));
  const Octree<double> octree = build_octree(geometry, limits);
  const auto technique = Technique::build({geometry}, {.limits = limits, .mailbox = MailboxUse::automatic});
  std::size_t leaves = 0;
  for (const Ray<double>& ray : rays_through(geometry, octree)) {
    if (!(ray.t_min <= ray.t_max)) continue;
    const std::vector<Objects> expected = leaves_on(octree, ray);
    ASSERT_EQ(visited_by(technique, ray), expected) << conformance::describe(ray);
    leaves += expected.size();
  }
  EXPECT_GT(leaves, 5000u);
}

/// Wherever cells are divided.
template <class Technique>
void check_leaves_in_order() {
  check_leaves_in_order<Technique>(kLimits);
  OctreeLimits by_cost = kLimits;
  by_cost.split = OctreeSplit::cost;
  check_leaves_in_order<Technique>(by_cost);
}

}  // namespace rayshoot::octrees
