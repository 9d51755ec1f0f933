#pragma once

#include <numeric>
#include <ranges>

#include "accel/core/technique.h"
#include "accel/parts/leaf_order.h"
#include "accel/parts/mailbox.h"
#include "accel/parts/object_order.h"
#include "accel/parts/octree_layout.h"
#include "accel/parts/surface_margin.h"

namespace rayshoot {

struct OctreeCellsConfig {
  OctreeLimits limits;
  MailboxUse mailbox = MailboxUse::automatic;
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
      : octree_(DepthFirstOctree<Real>(build_octree(geometry, config.limits)).octree()),
        references_(octree_.references.size()),
        order_(side_by_side(octree_.references, geometry.size())) {
    std::iota(octree_.references.begin(), octree_.references.end(), 0u);
    if (config.limits.assignment == Assignment::surface) margin_ = SurfaceMargin<Real>(geometry.bounds());
    if (wants_mailbox(config.mailbox, references_, geometry.size())) mailboxes_ = geometry.size();
  }

  const Lattice<Real>& lattice() const { return octree_.lattice; }
  const HugeVector<Node>& nodes() const { return octree_.nodes; }
  const Node* root() const { return octree_.nodes.data(); }
  static bool interior(const Node* node) { return node->interior(); }
  /// Child of an interior node, by its octant in the lattice.
  const Node* child(const Node* parent, unsigned octant) const { return root() + parent->first + octant; }
  std::span<const std::uint32_t> objects(const Node& leaf) const { return octree_.objects(leaf); }
  /// The planes that divide an interior node, and its cell, as a ray sees them.
  Layers dividing(const Node* node, const LatticeCell& cell, const LatticeRay<Real>& path) const {
    return octree_.dividing(number(node), cell, path);
  }
  /// The same for a node that is not divided in its middle.
  Layers chosen_planes(const Node* node, const LatticeRay<Real>& path) const {
    return path.mirrored(octree_.places[number(node)].planes);
  }
  /// Which of its parent's eight children, which stand together, a node other than the root is.
  unsigned octant(const Node* node) const { return static_cast<unsigned>(number(node)) % 8; }
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
  std::span<const std::uint32_t> order() const { return order_; }
  /// The positions that `objects` lists, which follow from where it stands alone.
  auto positions(std::span<const std::uint32_t> objects) const {
    const auto first = static_cast<std::uint32_t>(objects.data() - octree_.references.data());
    return std::views::iota(first, first + static_cast<std::uint32_t>(objects.size()));
  }
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
                         .bytes = octree_.bytes() + order_.size() * sizeof(order_[0])};
    for (const Node& node : octree_.nodes) {
      stats.leaves += !node.interior();
      stats.empty_leaves += node.count == 0;
    }
    if (root()->interior())
      stats.nodes -= kUnusedNodes, stats.leaves -= kUnusedNodes, stats.empty_leaves -= kUnusedNodes;
    return stats;
  }

 private:
  std::size_t number(const Node* node) const { return static_cast<std::size_t>(node - root()); }

  Octree<Real> octree_;
  std::size_t references_ = 0;
  /// The objects of one leaf after the other: leaves list positions.
  HugeVector<std::uint32_t> order_;
  /// Set where objects are assigned by their surfaces.
  std::optional<SurfaceMargin<Real>> margin_;
  /// Objects that need a mailbox; none where mailboxes are off.
  std::uint32_t mailboxes_ = 0;
};

}  // namespace rayshoot
