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
  /// Earliest parameter at which the ray may come into a half, and latest at which it may leave it.
  std::array<Real, 3> enter[2], exit[2];

  /// Become a cell that those planes divide.
  void begin(const LatticeRay<Real>& path, const LatticeCell& cell, const Layers& planes) {
    for (int axis = 0; axis < 3; ++axis) {
      enter[0][axis] = path.entry(axis, cell.corner[axis]);
      exit[1][axis] = path.exit(axis, cell.end(axis));
    }
    divide(path, planes);
  }
  /// Become a child, whose faces are its parent's faces and dividing planes.
  void begin_child(const LatticeRay<Real>& path, const Layers& planes, const DividedCell& parent,
                   unsigned octant) {
    for (int axis = 0; axis < 3; ++axis) {
      const unsigned half = octant >> axis & 1;
      enter[0][axis] = parent.enter[half][axis];
      exit[1][axis] = parent.exit[half][axis];
    }
    divide(path, planes);
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
  void divide(const LatticeRay<Real>& path, const Layers& planes) {
    for (int axis = 0; axis < 3; ++axis) {
      enter[1][axis] = path.entry(axis, planes[axis]);
      exit[0][axis] = path.exit(axis, planes[axis]);
    }
  }
};

/// The octree that all traversals of explicit nodes share; they visit the same leaves in the same order (leaf_order.h).
template <class Real>
class OctreeCells {
 public:
  using Node = typename Octree<Real>::Node;
  using Cell = CellOnRay<const Node*>;

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
  /// The planes that divide an interior node, and its cell, as a ray sees them.
  Layers dividing(const Node* node, const LatticeCell& cell, const LatticeRay<Real>& path) const {
    return octree_.dividing(number(node), cell, path);
  }
  /// Which of its parent's eight children, which stand together, a node other than the root is.
  unsigned octant(const Node* node) const { return static_cast<unsigned>(number(node) - 1) % 8; }
  /// Whether a cell is divided as its siblings are, each in the middle.
  bool divided_alike() const { return octree_.places.empty(); }
  /// The cell, as the ray sees it, of a node that lies behind the farther face on an axis of another, whose cell is given,
  /// and `levels` nearer to the root.
  LatticeCell behind(int axis, const LatticeCell& cell, const Node* node, int levels,
                     const LatticeRay<Real>& path) const {
    if (!divided_alike()) return path.mirrored(octree_.places[number(node)].cell);
    LatticeCell behind;
    for (int k = 0; k < 3; ++k) {
      behind.size[k] = cell.size[k] << levels;
      behind.corner[k] = k == axis ? cell.end(k) : cell.corner[k] & -behind.size[k];
    }
    return behind;
  }
  Mailbox mailbox() const { return Mailbox(mailboxes_); }
  template <class Visit>
  void for_each_cell(const Visit& visit) const {
    octree_.for_each_cell(visit);
  }

  bool widens_cells() const { return margin_.has_value(); }
  /// By how much all cells are to be widened for this ray: see SurfaceMargin.
  Real margin(const Ray<Real>& ray) const { return margin_ ? margin_->of_ray(ray) : 0; }

  StructureStats structure() const {
    StructureStats stats{.nodes = octree_.nodes.size(),
                         .references = octree_.references.size(),
                         .max_depth = static_cast<std::uint64_t>(octree_.depth),
                         .bytes = octree_.bytes()};
    for (const Node& node : octree_.nodes) {
      stats.leaves += !node.interior();
      stats.empty_leaves += node.count == 0;
    }
    return stats;
  }

 private:
  std::size_t number(const Node* node) const { return static_cast<std::size_t>(node - root()); }

  Octree<Real> octree_;
  /// Set where objects are assigned by their surfaces.
  std::optional<SurfaceMargin<Real>> margin_;
  /// Objects that need a mailbox; none where mailboxes are off.
  std::uint32_t mailboxes_ = 0;
};

}  // namespace rayshoot
