// Bounding volumes guided by an octree: tight and disjoint
// A. S. Glassner, "Spacetime ray tracing for animation", IEEE Computer Graphics & Applications 8(2), 1988.
//
// Idea       Bounding volumes are tight but overlap; cells of an octree are disjoint but not tight. So an octree is built from
//            the top, and from the bottom up each of its nodes gets a volume about what of the objects is inside its cell.
//            The volumes are as tight as those of a hierarchy, and no two leaves share space.
// Parameters max_depth, max_objects, split, separating
//                     of the octree, as octree_revelles has them
//            mailbox  an object in several leaves is tested once a ray
// Cost       two volumes a step, three steps for the eight parts of a cell. Volumes are boxes, three of Kay and Kajiya's
//            plane sets; what of an object is inside a cell is taken to be what of its bounds is.
// Weak       objects larger than cells are in many leaves.

#include "accel/core/define_technique.h"
#include "accel/parts/octree_build.h"
#include "accel/parts/pair_walk.h"
#include "accel/parts/visit_cells.h"

namespace rayshoot {

namespace {

struct GlassnerHybridConfig {
  OctreeLimits limits;
  MailboxUse mailbox = MailboxUse::automatic;
};

/// Turns an octree into a binary hierarchy of the volumes in its cells.
template <class Real>
class VolumesInCells {
 public:
  VolumesInCells(const Geometry<Real>& geometry, const Octree<Real>& octree)
      : geometry_(geometry), octree_(octree) {
    if (geometry.size() == 0) return;
    const Part whole = volume_of(0, octree.lattice.whole());
    tree_.root = whole.child;
    tree_.bounds = whole.box;
  }

  PairTree<Real> take() && { return std::move(tree_); }

 private:
  /// A volume and what it is about; nothing where the box is empty.
  struct Part {
    Box<Real> box;
    ChildReference child{0, 0};
  };

  Part volume_of(std::size_t number, const LatticeCell& cell) {
    const auto& node = octree_.nodes[number];
    if (!node.interior())
      return {inside(octree_.lattice.cell(cell), octree_.objects(node)), {node.first, node.count}};
    // Bound the eight parts, then pairs of them along x, pairs of those along y, and both halves along z.
    std::array<Part, 8> parts;
    const Layers planes = octree_.dividing(number, cell);
    for (unsigned octant = 0; octant < 8; ++octant)
      parts[octant] = volume_of(node.first + octant, cell.child(octant, planes));
    for (unsigned count = 4; count > 0; count /= 2)
      for (unsigned i = 0; i < count; ++i) parts[i] = both(parts[2 * i], parts[2 * i + 1]);
    return parts[0];
  }

  /// About what of the objects is inside a cell.
  Box<Real> inside(const Box<Real>& cell, std::span<const std::uint32_t> objects) const {
    Box<Real> box;
    for (const std::uint32_t object : objects) {
      const Box<Real>& bounds = geometry_.bounds(object);
      box.include(Box<Real>{max(bounds.lo, cell.lo), min(bounds.hi, cell.hi)});
    }
    return box;
  }

  Part both(const Part& one, const Part& other) {
    if (one.box.empty()) return other;
    if (other.box.empty()) return one;
    const auto number = static_cast<std::uint32_t>(tree_.nodes.size());
    PairNode<Real>& node = tree_.nodes.emplace_back();
    node.boxes.set(0, one.box), node.boxes.set(1, other.box);
    node.child[0] = one.child, node.child[1] = other.child;
    Part joined{one.box, {number, 0}};
    joined.box.include(other.box);
    return joined;
  }

  const Geometry<Real>& geometry_;
  const Octree<Real>& octree_;
  PairTree<Real> tree_;
};

template <class Real>
class GlassnerHybrid {
 public:
  using Scalar = Real;
  using Config = GlassnerHybridConfig;
  using Scratch = Mailbox;

  static TechniqueInfo info() {
    std::vector<Parameter> parameters = octree_parameters();
    std::erase_if(parameters, [](const Parameter& parameter) { return parameter.name == "assignment"; });
    parameters.push_back(mailbox_parameter());
    return {.id = "glassner_hybrid",
            .title = "Bounding volumes guided by an octree",
            .family = "composed",
            .survey_section = "12",
            .paper = "Glassner 1988",
            .parameters = parameters};
  }
  static Config configure(const Arguments& arguments) {
    return {octree_limits(arguments, Assignment::box), mailbox_use(arguments)};
  }

  static GlassnerHybrid build(const BuildInput<Real>& in, const Config& config) {
    GlassnerHybrid technique;
    Octree<Real> octree = build_octree(in.geometry, config.limits);
    technique.depth_ = octree.depth;
    technique.tree_ = VolumesInCells<Real>(in.geometry, octree).take();
    technique.references_ = std::move(octree.references);
    if (wants_mailbox(config.mailbox, technique.references_.size(), in.geometry.size()))
      technique.mailboxes_ = in.geometry.size();
    return technique;
  }

  Scratch scratch() const { return Mailbox(mailboxes_); }

  template <class Counter, class L>
  void visit(const Ray<Real>& ray, Scratch& mailbox, Counter count, L& leaf) const {
    visit_objects_of_cells(*this, ray, mailbox, count, leaf);
  }

  template <class Counter, class Reach, class Visit>
  void visit_cells(const Ray<Real>& ray, Counter count, const Reach& reach, const Visit& visit) const {
    walk_pairs(tree_, ray, count, reach, [&](std::uint32_t first, std::uint32_t objects) {
      return visit(std::span(references_).subspan(first, objects));
    });
  }

  const GlassnerHybrid& cells(Scratch&) const { return *this; }
  template <class Visit>
  void for_each_cell(const Visit& visit) const {
    tree_.for_each_leaf([&](const Box<Real>& box, std::uint32_t first, std::uint32_t objects) {
      const std::span<const std::uint32_t> listed = std::span(references_).subspan(first, objects);
      visit(box, listed.data(), listed);
    });
  }

  StructureStats structure() const {
    return {.nodes = tree_.size(),
            .leaves = tree_.empty() ? 0 : tree_.nodes.size() + 1,
            .references = references_.size(),
            .max_depth = static_cast<std::uint64_t>(depth_),
            .bytes = tree_.bytes() + references_.size() * sizeof(references_[0])};
  }

 private:
  PairTree<Real> tree_;
  std::vector<std::uint32_t> references_;
  /// Of the octree.
  int depth_ = 0;
  std::uint32_t mailboxes_ = 0;
};

}  // namespace

RAYSHOOT_TECHNIQUE(glassner_hybrid, GlassnerHybrid)

}  // namespace rayshoot
