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
//            vertex or rounding, the ray may also touch voxels that it does not enter: these are visited as well.

#include <numeric>

#include "accel/core/define_technique.h"
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
    /// A leaf's objects: `count` references from `first` on.
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
    if (node.count > 0) kept.push_back({names[i], node.first, node.count});
  }
  return NodeTable(kept);
}

template <class Real>
class OctreeGlassner {
 public:
  using Scalar = Real;
  using Scratch = Mailbox;
  using Layers = typename LatticeRay<Real>::Layers;
  struct Config {
    OctreeLimits limits;
    MailboxUse mailbox = MailboxUse::automatic;
  };
  /// A leaf on the way of a ray: its place in the lattice as the ray sees it, and its objects.
  struct Voxel {
    NodeTable::Name name = 0;
    Layers corner{};
    int size = 0;
    std::span<const std::uint32_t> objects;

    bool contains(const Layers& layers) const {
      for (int axis = 0; axis < 3; ++axis)
        if (layers[axis] < corner[axis] || layers[axis] >= corner[axis] + size) return false;
      return true;
    }
  };

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
    technique.lattice_ = octree.lattice;
    technique.references_ = std::move(octree.references);
    if (config.limits.assignment == Assignment::surface)
      technique.margin_ = SurfaceMargin<Real>(in.geometry.bounds());
    if (wants_mailbox(config.mailbox, technique.references_.size(), in.geometry.size()))
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
    visit_voxels(ray, count, reach, [&](const Voxel& voxel) { return visit(voxel.objects); });
  }

  /// The same with all that is known of a voxel.
  template <class Counter, class Reach, class Visit>
  void visit_voxels(const Ray<Real>& ray, Counter count, const Reach& reach, const Visit& visit) const {
    Walk<Counter, Reach, Visit> walk(*this, ray, count, reach, visit);
    const Real margin = margin_ ? margin_->of_ray(ray) : 0;
    if (margin == 0)
      walk.in_steps(ray.t_min);
    else
      walk.through_all_within(margin, ray.t_min);
  }

  StructureStats structure() const {
    StructureStats stats{.nodes = 1, .leaves = 1, .empty_leaves = 1, .references = references_.size()};
    for (const NodeTable::Node& node : nodes_.nodes()) {
      if (node.interior())
        stats.nodes += 8, stats.leaves += 7, stats.empty_leaves += 7;
      else if (node.name != 0)
        --stats.empty_leaves;
    }
    stats.max_depth = static_cast<std::uint64_t>(lattice_.depth);
    stats.bytes = nodes_.bytes() + references_.size() * sizeof(std::uint32_t);
    return stats;
  }

 private:
  template <class Counter, class Reach, class Visit>
  class Walk;

  NodeTable nodes_;
  Lattice<Real> lattice_;
  std::vector<std::uint32_t> references_;
  /// Set where objects are assigned by their surfaces.
  std::optional<SurfaceMargin<Real>> margin_;
  /// Objects that need a mailbox; none where mailboxes are off.
  std::uint32_t mailboxes_ = 0;
};

/// One ray's way through the octree.
template <class Real>
template <class Counter, class Reach, class Visit>
class OctreeGlassner<Real>::Walk {
 public:
  Walk(const OctreeGlassner& octree, const Ray<Real>& ray, Counter count, const Reach& reach,
       const Visit& visit)
      : octree_(octree),
        path_(octree.lattice_, ray),
        layers_(octree.lattice_.layers()),
        count_(count),
        reach_(reach),
        visit_(visit) {}

  /// Figure 11.
  void in_steps(Real t_min) {
    // Q is the origin, or the point where the ray enters the box of the environment.
    const Interval<Real> box = path_.inside({0, 0, 0}, layers_);
    Real t = std::max(box.enter, t_min);
    if (!(t <= box.exit && t <= reach_())) return;
    Layers q;
    for (int axis = 0; axis < 3; ++axis) q[axis] = path_.layer(axis, t, 0, layers_);
    if (t > 0 && planes_at(q, t) > 0 && touched_voxels(t, {}, q)) return;

    while (std::max({q[0], q[1], q[2]}) < layers_) {
      // Locate the voxel which contains Q and test its objects.
      const Voxel voxel = locate(q);
      if (visit_(voxel)) return;

      // Find where the ray leaves the voxel; there it ends if it ends before.
      t = exit(voxel);
      if (reach_() < t) return;

      // Step into the neighbour; where that may be by an edge or a vertex, visit the voxels touched there.
      if (step(voxel, t, q) && touched_voxels(t, voxel, q)) return;
    }
  }

  /// Visit every voxel that the ray passes at no more than that margin, from `t_min` on.
  [[gnu::noinline, gnu::cold]] void through_all_within(Real margin, Real t_min) {
    descend(
        NodeTable::kRoot, {0, 0, 0}, layers_,
        [&](const Layers& corner, int size) {
          const Interval<Real> inside = path_.near(corner, size, margin);
          return inside.enter <= inside.exit && inside.exit >= t_min && inside.enter <= reach_();
        },
        visit_);
  }

 private:
  /// Name the way down from the root to the voxel of layers q.
  Voxel locate(const Layers& q) const {
    NodeTable::Name name = NodeTable::kRoot;
    for (int size = layers_;;) {
      const NodeTable::Node* node = find(name);
      if (!node || !node->interior())
        return voxel(name, node, {q[0] & -size, q[1] & -size, q[2] & -size}, size);
      size /= 2;
      const unsigned octant = (q[0] & size ? 1u : 0u) | (q[1] & size ? 2u : 0u) | (q[2] & size ? 4u : 0u);
      name = NodeTable::child(name, octant ^ path_.mirror());
    }
  }

  Real exit(const Voxel& voxel) const {
    return std::min({path_.entry(0, voxel.corner[0] + voxel.size),
                     path_.entry(1, voxel.corner[1] + voxel.size),
                     path_.entry(2, voxel.corner[2] + voxel.size)});
  }

  /// Move Q from the voxel that the ray leaves at t into the one that it enters: minlen/2 beyond each face that
  /// may contain the exit point, which is into the next layer, and along with the ray on the other axes. Whether the
  /// ray may pass more than one plane there and touch further voxels.
  bool step(const Voxel& voxel, Real t, Layers& q) const {
    const Real until = t * kApart<Real>;
    bool skips = false;
    for (int axis = 0; axis < 3; ++axis) {
      const int face = voxel.corner[axis] + voxel.size;
      const bool passed = path_.entry(axis, face) <= until;
      q[axis] =
          passed ? path_.layer(axis, until, face, layers_) : path_.layer(axis, until, q[axis], face - 1);
      skips |= q[axis] > face;
    }
    return skips || planes_at(q, t) > 1;
  }

  const NodeTable::Node* find(NodeTable::Name name) const {
    count_.step();
    return octree_.nodes_.find(name);
  }

  Voxel voxel(NodeTable::Name name, const NodeTable::Node* leaf, const Layers& corner, int size) const {
    if (!leaf) return {name, corner, size, {}};
    return {name, corner, size, std::span(octree_.references_).subspan(leaf->first, leaf->count)};
  }

  /// Number of axes on which the ray may pass into the layer of q at t.
  int planes_at(const Layers& q, Real t) const {
    int planes = 0;
    for (int axis = 0; axis < 3; ++axis)
      planes += q[axis] > 0 && path_.entry(axis, q[axis]) * kApart<Real> >= t;
    return planes;
  }

  /// Visit the voxels in which the ray may be at t, but neither the one it comes from nor that of layers q, into
  /// which it goes on; true when the visit must end.
  [[gnu::noinline, gnu::cold]] bool touched_voxels(Real t, const Voxel& from, const Layers& q) {
    return descend(
        NodeTable::kRoot, {0, 0, 0}, layers_,
        [&](const Layers& corner, int size) {
          const Interval<Real> inside = path_.inside(corner, size);
          return inside.enter <= std::min(inside.exit, t * kApart<Real>) && t <= inside.exit * kApart<Real>;
        },
        [&](const Voxel& voxel) { return voxel.name != from.name && !voxel.contains(q) && visit_(voxel); });
  }

  /// Hand to `visit` the leaves below a node for which, and for all above which, `meets(corner, size)` holds,
  /// near ones first; true when `visit` returned true.
  template <class Meets, class VisitLeaf>
  bool descend(NodeTable::Name name, const Layers& corner, int size, const Meets& meets,
               const VisitLeaf& visit) const {
    if (!meets(corner, size)) return false;
    const NodeTable::Node* node = find(name);
    if (!node || !node->interior()) return visit(voxel(name, node, corner, size));
    const int half = size / 2;
    for (unsigned octant = 0; octant < 8; ++octant) {
      const Layers child{corner[0] + (octant & 1 ? half : 0), corner[1] + (octant & 2 ? half : 0),
                         corner[2] + (octant & 4 ? half : 0)};
      if (descend(NodeTable::child(name, octant ^ path_.mirror()), child, half, meets, visit)) return true;
    }
    return false;
  }

  const OctreeGlassner& octree_;
  LatticeRay<Real> path_;
  int layers_;
  Counter count_;
  const Reach& reach_;
  const Visit& visit_;
};

RAYSHOOT_TECHNIQUE(octree_glassner, OctreeGlassner)

}  // namespace rayshoot
