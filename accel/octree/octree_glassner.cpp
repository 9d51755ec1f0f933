// The octree of Glassner (1984; Arvo & Kirk §5.1, Figures 10 and 11)
//
// Idea       Divide a box around the scene into eight until each voxel meets few surfaces. A node has a name
//            instead of a pointer: the root is 1, child d of node n is 10 n + d with d from 1 to 8, and a
//            hash table leads from names to nodes; a name that is not there is an empty voxel. A ray locates
//            the voxel of a point by naming its way down from the root, tests the voxel's objects, steps half
//            the shortest edge of the octree ("minlen") beyond the face by which it leaves, and locates that
//            point.
// Parameters max_depth    divisions below the root, at most 18, the digits that fit a 64-bit name. 0, the
//                         default, is half the binary logarithm of the number of objects, at which the voxels
//                         on a surface are as large as the objects, and two levels more, for scenes are not
//                         even.
//            max_objects  a voxel with that many objects or fewer is not divided; 8: fewer tests a voxel do
//                         not pay for naming every voxel from the root.
//            assignment   surface, the paper's: a voxel lists the objects whose surface penetrates it, so the
//                         inside of a ball is empty; box: those whose bounds touch it.
//            split        centre, the paper's; cost, as octree_revelles
//            separating   on: division ends early where it would separate nothing; off: it does not
//            mailbox      auto: where an object is listed twice; the paper has none (§5.3).
// Cost       For each voxel on the ray a hash look-up on every level above it, and its objects. Steps are
//            look-ups.
// Weak       The way from the root is repeated for every voxel; large voids between small details take many
//            voxels, and surfaces seen edge-on are listed in many. Division ends early where it would
//            separate nothing and where references would exceed 64 an object (and 16 million).
//
// Exactness  A point o + t d is nowhere computed. Voxels end on the planes of a lattice whose layers are minlen
//            thick; the point beyond the exit face is known by its three layers, found by comparing the exit
//            parameter with the parameters of planes. Where the exit may be on several planes at once, by an edge, a
//            vertex or rounding, the ray may also touch voxels that it does not enter: these are visited as well, in the
//            order of all octrees here (leaf_order.h).

#include <numeric>

#include "accel/core/define_technique.h"
#include "accel/parts/leaf_order.h"
#include "accel/parts/octree_build.h"
#include "accel/parts/surface_margin.h"
#include "accel/parts/visit_cells.h"

namespace rayshoot {

/// The paper's table of nodes: interior nodes and leaves with objects, found by name.
class NodeTable {
 public:
  using Name = std::uint64_t;
  struct Node {
    Name name = 0;
    /// A leaf's objects: `count` references from `first` on; of an interior node its number in the octree.
    std::uint32_t first = 0, count = 0;
    bool interior() const { return count == kInterior; }
  };

  static constexpr Name kRoot = 1;
  static constexpr std::uint32_t kInterior = Octree<float>::Node::kInterior;
  /// Octants are numbered from 0, digits from 1.
  static Name child(Name parent, unsigned octant) { return 10 * parent + octant + 1; }

  NodeTable() : NodeTable(std::vector<Node>{}) {}
  explicit NodeTable(const std::vector<Node>& nodes)
      : buckets_(odd_size(nodes.size()) + 1), nodes_(nodes.size()) {
    // Count into the bucket behind, add up, and place: a bucket begins where the one before ends.
    for (const Node& node : nodes) ++buckets_[bucket(node.name) + 1];
    std::partial_sum(buckets_.begin(), buckets_.end(), buckets_.begin());
    std::vector<std::uint32_t> next = buckets_;
    for (const Node& node : nodes) nodes_[next[bucket(node.name)]++] = node;
  }

  /// The node of that name, or null: then nothing is there. The name modulo the size of the table serves as a hash,
  /// as Glassner observed: names of siblings, which are consecutive, are found side by side.
  const Node* find(Name name) const {
    const std::size_t b = bucket(name);
    for (std::uint32_t i = buckets_[b]; i < buckets_[b + 1]; ++i)
      if (nodes_[i].name == name) return &nodes_[i];
    return nullptr;
  }

  const std::vector<Node>& nodes() const { return nodes_; }
  std::size_t bytes() const { return nodes_.size() * sizeof(Node) + buckets_.size() * sizeof(buckets_[0]); }

 private:
  /// About one bucket a node; a size with a factor of ten's would leave buckets without names.
  static std::size_t odd_size(std::size_t nodes) {
    std::size_t size = nodes | 1;
    return size % 5 == 0 ? size + 2 : size;
  }
  std::size_t bucket(Name name) const { return name % (buckets_.size() - 1); }

  std::vector<std::uint32_t> buckets_;
  std::vector<Node> nodes_;
};

/// Name the nodes of an octree, all but the empty leaves.
template <class Real>
NodeTable named(const Octree<Real>& octree) {
  std::vector<NodeTable::Name> names(octree.nodes.size(), NodeTable::kRoot);
  std::vector<NodeTable::Node> kept;
  for (std::size_t i = 0; i < octree.nodes.size(); ++i) {
    const auto& node = octree.nodes[i];
    if (node.interior())
      for (unsigned octant = 0; octant < 8; ++octant)
        names[node.first + octant] = NodeTable::child(names[i], octant);
    if (node.count > 0)
      kept.push_back({names[i], node.interior() ? static_cast<std::uint32_t>(i) : node.first, node.count});
  }
  return NodeTable(kept);
}

template <class Real>
class OctreeGlassner {
 public:
  using Scalar = Real;
  using Scratch = Mailbox;
  struct Config {
    OctreeLimits limits;
    MailboxUse mailbox = MailboxUse::automatic;
  };
  /// A node on the way of a ray: its name, and its entry in the table unless it is an empty voxel.
  struct Named {
    NodeTable::Name name = 0;
    const NodeTable::Node* node = nullptr;
  };
  using Voxel = CellOnRay<Named>;

  static TechniqueInfo info() {
    TechniqueInfo info{.id = "octree_glassner",
                       .title = "Octree, nodes named and hashed",
                       .family = "octree",
                       .survey_section = "5.1",
                       .paper = "Glassner 1984",
                       .parameters = octree_parameters()};
    info.parameters.push_back(mailbox_parameter());
    return info;
  }
  static Config configure(const Arguments& arguments) {
    return {octree_limits(arguments), mailbox_use(arguments)};
  }

  static OctreeGlassner build(const BuildInput<Real>& in, const Config& config) {
    OctreeGlassner technique;
    Octree<Real> octree = build_octree(in.geometry, config.limits);
    technique.nodes_ = named(octree);
    octree.nodes = {};
    technique.octree_ = std::move(octree);
    if (config.limits.assignment == Assignment::surface)
      technique.margin_ = SurfaceMargin<Real>(in.geometry.bounds());
    if (wants_mailbox(config.mailbox, technique.octree_.references.size(), in.geometry.size()))
      technique.mailboxes_ = in.geometry.size();
    return technique;
  }

  Scratch scratch() const { return Mailbox(mailboxes_); }

  template <class Counter, class L>
  void visit(const Ray<Real>& ray, Scratch& mailbox, Counter count, L& leaf) const {
    visit_objects_of_cells(*this, ray, mailbox, count, leaf);
  }

  /// Hand the objects of the ray's voxels, empty ones included, to `visit` (visit_cells.h).
  template <class Counter, class Reach, class Visit>
  void visit_cells(const Ray<Real>& ray, Counter count, const Reach& reach, const Visit& visit) const {
    visit_voxels(ray, count, reach, [&](const Voxel& voxel) { return visit(objects(voxel)); });
  }

  /// The same with all that is known of a voxel.
  template <class Counter, class Reach, class Visit>
  void visit_voxels(const Ray<Real>& ray, Counter count, const Reach& reach, const Visit& visit) const {
    const LatticeRay<Real> path(octree_.lattice, ray);
    const ByName<Counter> names{nodes_, octree_, count};
    const LeafOrder<Real, ByName<Counter>> order(names, path, octree_.lattice);
    if (const Real margin = margin_ ? margin_->of_ray(ray) : 0; margin != 0) [[unlikely]] {
      // Rays too far away for the margin of the surfaces visit every voxel that they pass at no more than theirs.
      order.visit_leaves(
          order.root(), [&](const Voxel& voxel) { return order.near(voxel, margin, ray.t_min, reach()); },
          visit);
      return;
    }

    // Q is the origin, or the point where the ray enters the box of the environment; then it is stepped into the
    // neighbour, minlen/2 beyond the exit face, and located from the root (Figure 11).
    const auto across = [&](Voxel& voxel, int axis, Real first) {
      const int face = voxel.end(axis);
      if (face == octree_.lattice.layers()) return false;
      Layers q;
      for (int other = 0; other < 3; ++other)
        q[other] =
            other == axis ? face : path.passed_layer(other, first, voxel.corner[other], voxel.end(other) - 1);
      voxel = located(names, order, q);
      return true;
    };
    order.walk(
        ray.t_min, reach, [] {}, across, visit);
  }

  std::span<const std::uint32_t> objects(const Voxel& voxel) const {
    const NodeTable::Node* leaf = voxel.node.node;
    return leaf ? std::span(octree_.references).subspan(leaf->first, leaf->count)
                : std::span<const std::uint32_t>{};
  }

  const OctreeGlassner& cells(Scratch&) const { return *this; }
  bool widens_cells() const { return margin_.has_value(); }
  template <class Visit>
  void for_each_cell(const Visit& visit) const {
    for_each_cell_below({octree_.lattice.whole(), {NodeTable::kRoot, nodes_.find(NodeTable::kRoot)}}, visit);
  }

  StructureStats structure() const {
    StructureStats stats{.nodes = 1, .leaves = 1, .empty_leaves = 1, .references = octree_.references.size()};
    for (const NodeTable::Node& node : nodes_.nodes()) {
      if (node.interior())
        stats.nodes += 8, stats.leaves += 7, stats.empty_leaves += 7;
      else if (node.name != 0)
        --stats.empty_leaves;
    }
    stats.max_depth = static_cast<std::uint64_t>(octree_.depth);
    stats.bytes = nodes_.bytes() + octree_.bytes();
    return stats;
  }

 private:
  /// The nodes as a tree: every look-up is a step.
  template <class Counter>
  struct ByName {
    const NodeTable& nodes;
    const Octree<Real>& octree;
    Counter count;

    Named find(NodeTable::Name name) const {
      count.step();
      return {name, nodes.find(name)};
    }
    Named root() const { return find(NodeTable::kRoot); }
    bool interior(const Named& named) const { return named.node && named.node->interior(); }
    Named child(const Named& named, unsigned octant) const {
      return find(NodeTable::child(named.name, octant));
    }
    Layers dividing(const Named& named, const LatticeCell& cell, const LatticeRay<Real>& path) const {
      return octree.dividing(named.node->first, cell, path);
    }
  };

  /// Name the way down from the root to the voxel of layers q, as the ray sees them.
  template <class Names>
  static Voxel located(const Names& names, const LeafOrder<Real, Names>& order, const Layers& q) {
    Voxel voxel = order.root();
    while (names.interior(voxel.node)) {
      const Layers planes = order.dividing(voxel);
      voxel = order.child(voxel, planes, octant_of(q, planes));
    }
    return voxel;
  }

  template <class Visit>
  void for_each_cell_below(const Voxel& voxel, const Visit& visit) const {
    const NodeTable::Node* node = voxel.node.node;
    if (!node) return;
    if (!node->interior()) return visit(octree_.lattice.cell(voxel), objects(voxel).data(), objects(voxel));
    const Layers planes = octree_.dividing(node->first, voxel);
    for (unsigned octant = 0; octant < 8; ++octant) {
      const NodeTable::Name name = NodeTable::child(voxel.node.name, octant);
      for_each_cell_below({voxel.child(octant, planes), {name, nodes_.find(name)}}, visit);
    }
  }

  NodeTable nodes_;
  /// The octree but for its nodes, which are named instead.
  Octree<Real> octree_;
  /// Set where objects are assigned by their surfaces.
  std::optional<SurfaceMargin<Real>> margin_;
  /// Objects that need a mailbox; none where mailboxes are off.
  std::uint32_t mailboxes_ = 0;
};

RAYSHOOT_TECHNIQUE(octree_glassner, OctreeGlassner)

}  // namespace rayshoot
