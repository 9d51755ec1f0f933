// Bounding volume hierarchy by the surface area heuristic (the modern reference of Arvo & Kirk §4.3)
// I. Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007; the heuristic is equation
// (3), after Goldsmith & Salmon 1987.
//
// Idea       Split the objects in two, again and again, where equation (3) expects the least cost. Ranges of
//            many objects are split between bins of their centres, small ranges between any two neighbours in
//            sorted order. A ray descends into the nearer child first and leaves out what lies beyond the
//            nearest hit so far.
// Parameters split           sweep sorts small ranges and tries every split, binned uses 32 bins throughout
//            max_objects     objects a leaf may hold at the most; 4, since a few tests cost no more than a
//                            step
//            traversal_cost  cost of testing a pair of volumes in units of a ray-object test; 1, since a
//                            step waits for memory about as long as a triangle test computes
// Cost       equation (3), exactly, for uniformly distributed rays without occlusion.
// Weak       long thin objects whose boxes are mostly void; very many objects per box (hair).

#include "accel/core/define_technique.h"
#include "accel/parts/branch.h"
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
            .parameters = {choice_parameter("split", "sweep", {"sweep", "binned"},
                                            "how ranges of at most 256 objects are split"),
                           integer_parameter("max_objects", 4, 1, 64, "objects a leaf may hold at the most"),
                           real_parameter("traversal_cost", 1, 0, 100,
                                          "cost of testing a pair of volumes, in ray-object tests")}};
  }
  static Config configure(const Arguments& arguments) {
    return {.sweep = arguments.text("split") == "sweep",
            .max_objects = static_cast<std::size_t>(arguments.integer("max_objects")),
            .traversal_cost = arguments.real("traversal_cost")};
  }

  static BvhSah build(const BuildInput<Real>& in, const Config& config) {
    BvhSah bvh;
    bvh.bounds_ = in.geometry.bounds();
    if (in.geometry.size() == 0) return bvh;
    std::vector<BoxedObject<Real>> objects(in.geometry.size());
    tbb::parallel_for(std::uint32_t{0}, in.geometry.size(), [&](std::uint32_t object) {
      objects[object] = {in.geometry.bounds(object), object};
    });
    SahBuilder<Real> builder(objects, config);
    bvh.root_ = builder.build();
    bvh.nodes_ = std::move(builder).take_nodes();
    bvh.order_.reserve(objects.size());
    for (const BoxedObject<Real>& object : objects) bvh.order_.push_back(object.object);
    return bvh;
  }

  Scratch scratch() const { return {}; }
  std::span<const std::uint32_t> order() const { return order_; }

  /// Descend into the nearer child first and come back to the farther one while it can still matter.
  template <class Counter, class L>
  void visit(const Ray<Real>& ray, Scratch&, Counter count, L& leaf) const {
    // Leave out rays that miss everything.
    if (order_.empty()) return;
    count.volume_tests();
    const Interval<Real> whole = Crossings<Real>(ray).inside(bounds_);
    if (!(std::max(whole.enter, ray.t_min) <= std::min(whole.exit, ray.t_max))) return;

    struct Postponed {
      ChildReference child;
      Real enter;
    };
    Postponed stack[kMaxSahDepth];
    int postponed = 0;
    const PairCrossings<Real> crossings(ray);
    ChildReference current = root_;
    while (true) {
      if (current.leaf()) {
        // Test the objects of a leaf.
        count.cell(false);
        for (std::uint32_t i = 0; i < current.count; ++i)
          if (leaf(current.first + i)) return;
      } else {
        // Test both children's volumes and enter the nearer of those that are hit; meanwhile fetch both
        // children.
        const PairNode<Real>& node = nodes_[current.first];
        __builtin_prefetch(nodes_.data() + node.child[0].first);
        __builtin_prefetch(nodes_.data() + node.child[1].first);
        count.step(), count.volume_tests(2);
        const Real reach = leaf.reach();
        const Lanes<Real> inside =
            crossings.inside(node.boxes, Lanes<Real>{ray.t_min, ray.t_min, -reach, -reach});
        const bool hits_first = inside[0] <= -inside[2], hits_second = inside[1] <= -inside[3];
        if (hits_first && hits_second) {
          if (inside[1] < inside[0]) {
            keep_branch();
            stack[postponed++] = {node.child[0], inside[0]};
            current = node.child[1];
          } else {
            keep_branch();
            stack[postponed++] = {node.child[1], inside[1]};
            current = node.child[0];
          }
          continue;
        }
        if (hits_first) {
          keep_branch();
          current = node.child[0];
          continue;
        }
        if (hits_second) {
          keep_branch();
          current = node.child[1];
          continue;
        }
      }
      // Return to the nearest postponed node that no hit has made pointless; one at equal distance may still
      // hold a lower object.
      do {
        if (postponed == 0) return;
        --postponed;
      } while (stack[postponed].enter > leaf.reach());
      current = stack[postponed].child;
    }
  }

  StructureStats structure() const {
    StructureStats stats{.nodes = 2 * nodes_.size() + (order_.empty() ? 0 : 1),
                         .references = order_.size(),
                         .bytes = nodes_.size() * sizeof(nodes_[0]) + order_.size() * sizeof(order_[0])};
    if (!order_.empty()) measure(root_, 0, stats);
    return stats;
  }

  /// Equation (3) with both external costs of one test: a node's children are tested as often as the node is
  /// hit, which is S(node) / S(root) of the rays that hit the root (equation (2)).
  Prediction<Real> predicted() const {
    Prediction<Real> sum{0, 1, bounds_};
    if (!order_.empty()) predict(root_, bounds_, sum);
    return sum;
  }

 private:
  void measure(const ChildReference& node, std::uint64_t depth, StructureStats& stats) const {
    stats.max_depth = std::max(stats.max_depth, depth);
    if (node.leaf()) {
      ++stats.leaves;
      return;
    }
    for (const ChildReference& child : nodes_[node.first].child) measure(child, depth + 1, stats);
  }

  void predict(const ChildReference& node, const Box<Real>& box, Prediction<Real>& sum) const {
    const double probability = box.surface_area() / bounds_.surface_area();
    if (node.leaf()) {
      sum.object_tests += probability * node.count;
      return;
    }
    sum.volume_tests += probability * 2;
    for (int side = 0; side < 2; ++side)
      predict(nodes_[node.first].child[side], nodes_[node.first].boxes.box(side), sum);
  }

  std::vector<PairNode<Real>> nodes_;
  std::vector<std::uint32_t> order_;
  ChildReference root_{};
  Box<Real> bounds_;
};

}  // namespace

RAYSHOOT_TECHNIQUE(bvh_sah, BvhSah)

}  // namespace rayshoot
