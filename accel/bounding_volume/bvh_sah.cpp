// Bounding volume hierarchy by the surface area heuristic (the modern reference of Arvo & Kirk §4.3)
// I. Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007; the heuristic is equation
// (3), after Goldsmith & Salmon 1987.
//
// Idea       Split the objects in two, again and again, where equation (3) expects the least cost. Ranges of
//            many objects are split between bins of their centres, those of at most 32 objects between any two
//            neighbours in sorted order. A ray descends into the nearer child first and leaves out what lies
//            beyond the nearest hit so far.
// Parameters build           binned uses 32 bins, 16 for at most 512 objects; sweep tries every split of every range,
//                            which takes ten times as long and hardly costs less; fast cuts clusters of at most
//                            max_objects at the middle of their longest axis, after J. Pantaleoni & D. Luebke,
//                            "HLBVH", 2010, and builds over these; quality moves subtrees of a binned tree to where
//                            they cost less, which takes three times as long and saves up to a tenth of the steps
//            max_objects     objects a leaf may hold at the most; 4, since a few tests cost no more than a
//                            step
//            traversal_cost  cost of testing a pair of volumes in units of a ray-object test; 1, since a
//                            step waits for memory about as long as a triangle test computes
// Cost       equation (3), exactly, for uniformly distributed rays without occlusion.
// Weak       long thin objects whose boxes are mostly void; very many objects per box (hair).

#include <numeric>

#include "accel/core/define_technique.h"
#include "accel/parts/pair_walk.h"
#include "accel/parts/sah_build.h"

namespace rayshoot {

namespace {

template <class Real>
class BvhSah {
 public:
  using Scalar = Real;
  using Config = SahConfig;
  struct Scratch {};

  static TechniqueInfo info() {
    return {.id = "bvh_sah",
            .title = "Bounding volume hierarchy by the surface area heuristic",
            .family = "bounding_volume",
            .survey_section = "4",
            .paper = "Wald 2007; Goldsmith & Salmon 1987",
            .parameters = {sah_method_parameter(),
                           integer_parameter("max_objects", 4, 1, 64, "objects a leaf may hold at the most"),
                           real_parameter("traversal_cost", 1, 0, 100,
                                          "cost of testing a pair of volumes, in ray-object tests")}};
  }
  static Config configure(const Arguments& arguments) {
    return {.method = sah_method(arguments),
            .max_objects = static_cast<std::size_t>(arguments.integer("max_objects")),
            .traversal_cost = arguments.real("traversal_cost")};
  }

  static BvhSah build(const BuildInput<Real>& in, const Config& config) {
    BvhSah bvh;
    HugeVector<BoxedObject<Real>> objects = boxed_objects(in.geometry);
    bvh.tree_ = sah_tree<Real>(objects, config);
    bvh.order_ = names_of<Real>(objects);
    return bvh;
  }

  Scratch scratch() const { return {}; }
  std::span<const std::uint32_t> order() const { return order_; }

  template <class Counter, class L>
  void visit(const Ray<Real>& ray, Scratch&, Counter count, L& leaf) const {
    const auto reach = [&] { return leaf.reach(); };
    walk_pairs(tree_, ray, count, reach, [&](std::uint32_t first, std::uint32_t objects) {
      count.cell(false);
      for (std::uint32_t i = 0; i < objects; ++i)
        if (leaf(first + i)) return true;
      return false;
    });
  }

  /// Its leaves are the cells of a composition: each holds a range of positions.
  void prepare_cells() {
    positions_.resize(order_.size());
    std::iota(positions_.begin(), positions_.end(), 0u);
  }
  const BvhSah& cells(Scratch&) const { return *this; }
  template <class Counter, class Reach, class Visit>
  void visit_cells(const Ray<Real>& ray, Counter count, const Reach& reach, const Visit& visit) const {
    walk_pairs(tree_, ray, count, reach, [&](std::uint32_t first, std::uint32_t objects) {
      return visit(std::span(positions_).subspan(first, objects));
    });
  }
  template <class Visit>
  void for_each_cell(const Visit& visit) const {
    tree_.for_each_leaf([&](const Box<Real>& box, std::uint32_t first, std::uint32_t objects) {
      visit(box, &positions_[first], std::span(positions_).subspan(first, objects));
    });
  }

  StructureStats structure() const {
    StructureStats stats{.nodes = tree_.size(),
                         .references = order_.size(),
                         .bytes = tree_.bytes() + order_.size() * sizeof(order_[0])};
    if (!order_.empty()) measure(tree_.root, 0, stats);
    return stats;
  }

  /// Equation (3) with both external costs of one test: a node's children are tested as often as the node is
  /// hit, which is S(node) / S(root) of the rays that hit the root (equation (2)).
  Prediction<Real> predicted() const {
    Prediction<Real> sum{0, 1, tree_.bounds};
    if (!order_.empty()) predict(tree_.root, tree_.bounds, sum);
    return sum;
  }

  template <class Visit>
  void for_each_volume(const Visit& visit) const {
    visit(HierarchyVolume{.volume_tests = 1});
    if (!order_.empty()) visit_below(tree_.root, 1, visit);
  }

 private:
  template <class Visit>
  void visit_below(const ChildReference& node, std::uint32_t depth, const Visit& visit) const {
    if (node.leaf()) return visit(HierarchyVolume{depth, 0, node.count, node.first, node.first + node.count});
    visit(HierarchyVolume{.depth = depth, .volume_tests = 2});
    for (const ChildReference& child : tree_.nodes[node.first].child) visit_below(child, depth + 1, visit);
  }

  void measure(const ChildReference& node, std::uint64_t depth, StructureStats& stats) const {
    stats.max_depth = std::max(stats.max_depth, depth);
    if (node.leaf()) {
      ++stats.leaves;
      return;
    }
    for (const ChildReference& child : tree_.nodes[node.first].child) measure(child, depth + 1, stats);
  }

  void predict(const ChildReference& node, const Box<Real>& box, Prediction<Real>& sum) const {
    const double probability = box.surface_area() / tree_.bounds.surface_area();
    if (node.leaf()) {
      sum.object_tests += probability * node.count;
      return;
    }
    sum.volume_tests += probability * 2;
    for (int side = 0; side < 2; ++side)
      predict(tree_.nodes[node.first].child[side], tree_.nodes[node.first].boxes.box(side), sum);
  }

  PairTree<Real> tree_;
  std::vector<std::uint32_t> order_;
  /// All positions in turn, in a composition alone.
  std::vector<std::uint32_t> positions_;
};

}  // namespace

RAYSHOOT_TECHNIQUE(bvh_sah, BvhSah)

}  // namespace rayshoot
