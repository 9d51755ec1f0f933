// Adaptive grid (Arvo & Kirk §5.1 and §12: grids at the nodes of a bounding volume hierarchy)
// K. Klimaszewski, T. Sederberg, "Faster ray tracing using adaptive grids", 1997.
//
// Idea       A hierarchy of bounding volumes finds the clusters of the scene: from below, two neighbours are merged while
//            the volume about both has little more surface than theirs together. Each cluster gets a grid over its own
//            box, as fine as its objects ask for, with grids in crowded cells. A ray finds the clusters through the
//            hierarchy, near to far, and walks through their grids.
// Parameters merge           two clusters are merged where the surface about both is at most this times the sum of
//                            theirs; 1.5, as in most of Havran's figures: 1 keeps nearly all objects apart
//            max_area        an object with more than this share of its cluster's surface would be in too many cells: it
//                            is an orphan, tested by itself; 0.1, as there
//            orphans         apart: each a leaf of the hierarchy; grid: all in a grid of their own
//            density, nested_density, max_objects, max_depth, resolution
//                            of the grids, as recursive_grid has them
//            mailbox         auto: where some object is listed twice
// Cost       equation (3) for the hierarchy down to clusters and orphans, and in a cluster that of its grid.
// Weak       one dense mesh is one cluster, and then this is a recursive grid; clusters that overlap are walked one after
//            the other.
//
// Where the paper's hierarchy grows object by object (Goldsmith & Salmon 1987), the surface area heuristic splits here.

#include "accel/core/define_technique.h"
#include "accel/parts/grid_nesting.h"
#include "accel/parts/pair_walk.h"
#include "accel/parts/sah_build.h"
#include "accel/parts/visit_cells.h"

namespace rayshoot {

namespace {

struct AdaptiveGridConfig {
  double merge = 0, max_area = 0;
  bool orphan_grid = false;
  NestingRules nesting;
  MailboxUse mailbox = MailboxUse::automatic;
};

/// The clusters of a hierarchy over boxed objects.
template <class Real>
class ClusterFinder {
 public:
  ClusterFinder(std::span<const BoxedObject<Real>> objects, const PairTree<Real>& tree, double merge)
      : objects_(objects), tree_(tree), merge_(merge) {}

  std::vector<std::span<const BoxedObject<Real>>> clusters() && {
    const Part root = gather(tree_.root, tree_.bounds);
    if (root.whole) keep(root);
    return std::move(clusters_);
  }

 private:
  /// The objects of a node, from `first` on, and whether they are still one cluster.
  struct Part {
    std::size_t first, count;
    bool whole;
  };

  Part gather(const ChildReference& node, const Box<Real>& box) {
    if (node.leaf()) return {node.first, node.count, true};
    const PairNode<Real>& pair = tree_.nodes[node.first];
    const Box<Real> left_box = pair.boxes.box(0), right_box = pair.boxes.box(1);
    const Part left = gather(pair.child[0], left_box), right = gather(pair.child[1], right_box);
    const bool merged = left.whole && right.whole &&
                        box.surface_area() <= merge_ * (left_box.surface_area() + right_box.surface_area());
    if (!merged && left.whole) keep(left);
    if (!merged && right.whole) keep(right);
    return {left.first, left.count + right.count, merged};
  }

  void keep(const Part& part) { clusters_.push_back(objects_.subspan(part.first, part.count)); }

  std::span<const BoxedObject<Real>> objects_;
  const PairTree<Real>& tree_;
  double merge_;
  std::vector<std::span<const BoxedObject<Real>>> clusters_;
};

template <class Real>
class AdaptiveGrid {
 public:
  using Scalar = Real;
  using Config = AdaptiveGridConfig;
  using Scratch = Mailbox;

  static TechniqueInfo info() {
    std::vector<Parameter> parameters = {
        real_parameter("merge", 1.5, 0, 100,
                       "surface about two clusters in that of both, up to which they merge"),
        real_parameter("max_area", 0.1, 0, 1,
                       "share of its cluster's surface up to which an object is in its grid"),
        choice_parameter("orphans", "apart", {"apart", "grid"}, "what becomes of the larger objects")};
    for (const Parameter& parameter : nesting_parameters({})) parameters.push_back(parameter);
    parameters.push_back(mailbox_parameter());
    return {.id = "adaptive_grid",
            .title = "Adaptive grid: grids at the nodes of a bounding volume hierarchy",
            .family = "grid",
            .survey_section = "5.1",
            .paper = "Klimaszewski & Sederberg 1997",
            .parameters = parameters,
            .events = kNestedGridEvents};
  }
  static Config configure(const Arguments& arguments) {
    return {.merge = arguments.real("merge"),
            .max_area = arguments.real("max_area"),
            .orphan_grid = arguments.text("orphans") == "grid",
            .nesting = nesting_rules(arguments),
            .mailbox = mailbox_use(arguments)};
  }

  static AdaptiveGrid build(const BuildInput<Real>& in, const Config& config) {
    AdaptiveGrid technique;
    technique.grids_ = NestedGrids<Real>(in.geometry.size());
    GridNesting<Real> nesting(in.geometry, config.nesting, technique.grids_);
    std::vector<BoxedObject<Real>> members;
    std::vector<std::uint32_t> orphans;
    const auto add_grid = [&](const Box<Real>& box, std::vector<std::uint32_t>& objects) {
      std::sort(objects.begin(), objects.end());
      members.push_back({box, nesting.outermost(box, objects)});
    };

    // Give each cluster a grid, without the objects that are large in it.
    HugeVector<BoxedObject<Real>> objects = boxed_objects(in.geometry);
    const PairTree<Real> tree = sah_tree<Real>(objects, {.max_objects = 1});
    if (!objects.empty())
      for (const auto cluster : ClusterFinder<Real>(objects, tree, config.merge).clusters()) {
        Box<Real> whole, box;
        for (const BoxedObject<Real>& object : cluster) whole.include(object.box);
        std::vector<std::uint32_t> small;
        for (const BoxedObject<Real>& object : cluster)
          if (object.box.surface_area() > config.max_area * whole.surface_area())
            orphans.push_back(object.object);
          else
            small.push_back(object.object), box.include(object.box);
        if (!small.empty()) add_grid(box, small);
      }

    // Put the orphans into a grid, or beside the grids into the hierarchy.
    Box<Real> box;
    for (const std::uint32_t orphan : orphans) box.include(in.geometry.bounds(orphan));
    if (config.orphan_grid && !orphans.empty())
      add_grid(box, orphans);
    else
      for (const std::uint32_t orphan : orphans) members.push_back({in.geometry.bounds(orphan), orphan});
    technique.tree_ = sah_tree<Real>(members, {.max_objects = 1});
    for (const BoxedObject<Real>& member : members) technique.members_.push_back(member.object);

    technique.measure();
    technique.structure_.figures["orphans"] = static_cast<double>(orphans.size());
    if (wants_mailbox(config.mailbox, technique.structure_.references, in.geometry.size()))
      technique.mailboxes_ = in.geometry.size();
    return technique;
  }

  Scratch scratch() const { return Mailbox(mailboxes_); }

  template <class Counter, class L>
  void visit(const Ray<Real>& ray, Scratch& mailbox, Counter count, L& leaf) const {
    visit_objects_of_cells(*this, ray, mailbox, count, leaf);
  }

  /// Hand the orphans that the ray meets and the objects of its cells to `visit` (visit_cells.h).
  template <class Counter, class Reach, class Visit>
  void visit_cells(const Ray<Real>& ray, Counter count, const Reach& reach, const Visit& visit) const {
    Mailbox none;
    NestedWalk<Real, Counter, Reach, Visit> walk(grids_, none, ray, count, reach, visit);
    walk_pairs(tree_, ray, count, reach, [&](std::uint32_t first, std::uint32_t members) {
      return walk.visit_items({members_.data() + first, members});
    });
  }

  const AdaptiveGrid& cells(Scratch&) const { return *this; }
  template <class Visit>
  void for_each_cell(const Visit& visit) const {
    grids_.for_each_cell(visit);
    tree_.for_each_leaf([&](const Box<Real>& box, std::uint32_t first, std::uint32_t members) {
      const std::span<const std::uint32_t> items(members_.data() + first, members);
      const std::span<const std::uint32_t> objects = items.first(grids_.objects_among(items));
      if (!objects.empty()) visit(box, objects.data(), objects);
    });
  }

  StructureStats structure() const { return structure_; }

 private:
  void measure() {
    structure_ = grids_.structure();
    for (const std::uint32_t member : members_)
      if (!grids_.is_grid(member)) ++structure_.leaves, ++structure_.references;
    structure_.nodes += tree_.size();
    structure_.bytes += tree_.bytes() + members_.size() * sizeof(members_[0]);
    structure_.figures["hierarchy_nodes"] = static_cast<double>(tree_.size());
  }

  /// Over grids and orphans, which are items of `grids_` in the order of the tree's leaves.
  PairTree<Real> tree_;
  std::vector<std::uint32_t> members_;
  NestedGrids<Real> grids_;
  StructureStats structure_;
  std::uint32_t mailboxes_ = 0;
};

}  // namespace

RAYSHOOT_TECHNIQUE(adaptive_grid, AdaptiveGrid)

}  // namespace rayshoot
