#pragma once

#include "accel/core/technique.h"
#include "accel/parts/leaf_order.h"
#include "accel/parts/mailbox.h"
#include "accel/parts/octree_build.h"
#include "accel/parts/surface_margin.h"

namespace rayshoot {

struct OctreeCellsConfig {
  OctreeLimits limits;
  MailboxUse mailbox = MailboxUse::automatic;
};

/// Where a ray crosses the three pairs of faces of a cell and the three planes that divide it, for children as the ray
/// sees them: index 0 is the half of an axis that the ray comes to first.
template <class Real>
struct DividedCell {
  using Layers = typename LatticeRay<Real>::Layers;

  /// Earliest parameter at which the ray may come into a half, and latest at which it may leave it.
  std::array<Real, 3> enter[2], exit[2];

  /// Become the cell of `size`^3 layers from `corner` on.
  void begin(const LatticeRay<Real>& path, const Layers& corner, int size) {
    for (int axis = 0; axis < 3; ++axis) {
      enter[0][axis] = path.entry(axis, corner[axis]);
      exit[1][axis] = path.exit(axis, corner[axis] + size);
    }
    divide(path, corner, size);
  }
  /// Become a child, whose faces are its parent's faces and dividing planes.
  void begin_child(const LatticeRay<Real>& path, const Layers& corner, int size, const DividedCell& parent,
                   unsigned octant) {
    for (int axis = 0; axis < 3; ++axis) {
      const unsigned half = octant >> axis & 1;
      enter[0][axis] = parent.enter[half][axis];
      exit[1][axis] = parent.exit[half][axis];
    }
    divide(path, corner, size);
  }

  /// The closed interval of parameters inside a child.
  Interval<Real> inside(unsigned octant) const {
    const unsigned x = octant & 1, y = octant >> 1 & 1, z = octant >> 2;
    return {std::max({enter[x][0], enter[y][1], enter[z][2]}),
            std::min({exit[x][0], exit[y][1], exit[z][2]})};
  }
  /// Whether a ray that begins at `t_min` may touch a child.
  bool met(unsigned octant, Real t_min) const {
    const Interval<Real> within = inside(octant);
    return within.enter <= within.exit && within.exit >= t_min;
  }
  /// The next child after one, in increasing order, that the ray may touch; 8 if there is none.
  [[gnu::noinline, gnu::cold]] unsigned next_met(unsigned octant, Real t_min) const {
    while (++octant < 8 && !met(octant, t_min)) {
    }
    return octant;
  }
  /// The parameter at which the ray is in the cell for the first time, when it begins at `t_min`.
  Real first(Real t_min) const { return std::max({enter[0][0], enter[0][1], enter[0][2], t_min}); }

 private:
  void divide(const LatticeRay<Real>& path, const Layers& corner, int size) {
    for (int axis = 0; axis < 3; ++axis) {
      enter[1][axis] = path.entry(axis, corner[axis] + size / 2);
      exit[0][axis] = path.exit(axis, corner[axis] + size / 2);
    }
  }
};

/// The octree that all traversals of explicit nodes share; they visit the same leaves in the same order (leaf_order.h).
template <class Real>
class OctreeCells {
 public:
  using Node = typename Octree<Real>::Node;
  using Cell = CellOnRay<Real, const Node*>;

  static std::vector<Parameter> parameters() {
    std::vector<Parameter> parameters = octree_parameters();
    parameters.push_back(mailbox_parameter());
    return parameters;
  }
  static OctreeCellsConfig configure(const Arguments& arguments) {
    return {octree_limits(arguments), mailbox_use(arguments)};
  }

  OctreeCells() = default;
  OctreeCells(const Geometry<Real>& geometry, const OctreeCellsConfig& config)
      : octree_(build_octree(geometry, config.limits)) {
    if (config.limits.assignment == Assignment::surface) margin_ = SurfaceMargin<Real>(geometry.bounds());
    if (wants_mailbox(config.mailbox, octree_.references.size(), geometry.size()))
      mailboxes_ = geometry.size();
  }

  const Lattice<Real>& lattice() const { return octree_.lattice; }
  const std::vector<Node>& nodes() const { return octree_.nodes; }
  const Node* root() const { return octree_.nodes.data(); }
  static bool interior(const Node* node) { return node->interior(); }
  /// Child of an interior node, by its octant in the lattice.
  const Node* child(const Node* parent, unsigned octant) const { return root() + parent->first + octant; }
  std::span<const std::uint32_t> objects(const Node& leaf) const { return octree_.objects(leaf); }
  Mailbox mailbox() const { return Mailbox(mailboxes_); }

  /// By how much all cells are to be widened for this ray: see SurfaceMargin.
  Real margin(const Ray<Real>& ray) const { return margin_ ? margin_->of_ray(ray) : 0; }

  StructureStats structure() const {
    StructureStats stats{
        .nodes = octree_.nodes.size(),
        .references = octree_.references.size(),
        .max_depth = static_cast<std::uint64_t>(lattice().depth),
        .bytes = octree_.nodes.size() * sizeof(Node) + octree_.references.size() * sizeof(std::uint32_t)};
    for (const Node& node : octree_.nodes) {
      stats.leaves += !node.interior();
      stats.empty_leaves += node.count == 0;
    }
    return stats;
  }

 private:
  Octree<Real> octree_;
  /// Set where objects are assigned by their surfaces.
  std::optional<SurfaceMargin<Real>> margin_;
  /// Objects that need a mailbox; none where mailboxes are off.
  std::uint32_t mailboxes_ = 0;
};

}  // namespace rayshoot
