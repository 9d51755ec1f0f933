// Bounding volume hierarchy by the surface area heuristic (the modern reference of Arvo & Kirk §4.3)
// I. Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007; the heuristic is equation
// (3), after Goldsmith & Salmon 1987.
//
// Idea       Split the objects in two, again and again, where equation (3) expects the least cost. Ranges of
// many
//            objects are split between bins of their centres, small ranges between any two neighbours in
//            sorted order. A ray descends into the nearer child first and leaves out what lies beyond the
//            nearest hit so far.
// Parameters split            sweep sorts small ranges and tries every split, binned uses 32 bins throughout
//            max_objects      objects a leaf may hold at the most; 4, since a few tests cost no more than a
//            step traversal_cost   cost of testing a pair of volumes in units of a ray-object test; 0.5 for
//            triangles, a
//                             test of which costs as much as two pairs of boxes
// Cost       equation (3), exactly, for uniformly distributed rays without occlusion.
// Weak       long thin objects whose boxes are mostly void; very many objects per box (hair).

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_reduce.h>

#include "accel/core/define_technique.h"
#include "accel/parts/branch.h"
#include "accel/parts/lanes.h"
#include "accel/parts/sah_split.h"

namespace rayshoot {

namespace {

constexpr std::size_t kSequentialObjects = 4096;  // smaller ranges are built by one thread
constexpr std::size_t kSweptObjects = 256;        // larger ranges are split between bins
constexpr int kBalancedDepth = 48;                // deeper nodes are halved, which bounds the depth
constexpr int kStackSize = kBalancedDepth + 32;

/// A child of an interior node: a leaf with objects [first, first + count), or the interior node `first`.
struct ChildReference {
  std::uint32_t first;
  std::uint32_t count;

  bool leaf() const { return count > 0; }
};

/// An interior node holds the boxes of both its children, so that one fetch decides where to go.
template <class Real>
struct alignas(64) PairNode {
  BoxPair<Real> boxes;
  ChildReference child[2];
};

struct SahConfig {
  bool sweep = true;
  std::size_t max_objects = 4;
  double traversal_cost = 1;
};

/// Builds the nodes over a range of objects that it reorders. A range of m objects owns the m - 1 node
/// numbers from its own on, so threads need not agree on numbers; `compact` closes the gaps.
template <class Real>
class SahBuilder {
 public:
  SahBuilder(std::span<BoxedObject<Real>> objects, const SahConfig& config)
      : objects_(objects), config_(config), nodes_(objects.size()) {}

  ChildReference build() {
    const ChildReference root = build(0, objects_.size(), extent_of(objects_), 0, 0);
    return root.leaf() ? root : compact();
  }
  std::vector<PairNode<Real>> take_nodes() && { return std::move(compacted_); }

 private:
  ChildReference build(std::size_t first, std::size_t last, const Extent<Real>& extent, std::uint32_t node,
                       int depth) {
    const std::span<BoxedObject<Real>> range = objects_.subspan(first, last - first);
    const ChildReference as_leaf{static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(range.size())};
    if (range.size() == 1) return as_leaf;

    // Cut the range in two, or keep it whole where equation (3) expects no gain.
    const std::size_t middle = first + split(range, extent, depth);
    if (middle == first) return as_leaf;

    // Build both halves, at once where they are large.
    const Extent<Real> left_extent = extent_of(objects_.subspan(first, middle - first));
    const Extent<Real> right_extent = extent_of(objects_.subspan(middle, last - middle));
    PairNode<Real>& here = nodes_[node];
    here.boxes.set(0, left_extent.box);
    here.boxes.set(1, right_extent.box);
    const auto right_node = static_cast<std::uint32_t>(node + (middle - first));
    const auto build_left = [&] { here.child[0] = build(first, middle, left_extent, node + 1, depth + 1); };
    const auto build_right = [&] {
      here.child[1] = build(middle, last, right_extent, right_node, depth + 1);
    };
    if (range.size() > kSequentialObjects)
      tbb::parallel_invoke(build_left, build_right);
    else
      build_left(), build_right();
    return {node, 0};
  }

  /// Reorder the range so that its first part goes left; returns the size of that part, 0 to keep a leaf.
  std::size_t split(std::span<BoxedObject<Real>> range, const Extent<Real>& extent, int depth) {
    if (depth >= kBalancedDepth) return halve(range, extent);
    const bool sweep = config_.sweep && range.size() <= kSweptObjects;
    return sweep ? split_swept(range, extent) : split_binned(range, extent);
  }

  /// Equation (3): a leaf tests every object; a split tests two volumes and then the objects of those it
  /// hits.
  bool keep_leaf(std::size_t count, const SahSplit<Real>& split) const {
    const bool worthwhile = split.found() && config_.traversal_cost + split.cost < static_cast<double>(count);
    return !worthwhile && count <= config_.max_objects;
  }

  std::size_t split_swept(std::span<BoxedObject<Real>> range, const Extent<Real>& extent) {
    static thread_local std::vector<double> right_cost;
    const SahSplit<Real> best = sweep_split(range, extent.box, right_cost);
    if (keep_leaf(range.size(), best)) return 0;
    if (!best.found()) return halve(range, extent);
    if (best.axis != 2) sort_by_centre(range, best.axis);
    return best.place;
  }

  std::size_t split_binned(std::span<BoxedObject<Real>> range, const Extent<Real>& extent) {
    const Bins<Real> bins = accumulate(range, Bins<Real>(extent.twice_centres));
    const SahSplit<Real> best = bins.best(extent.box);
    if (keep_leaf(range.size(), best)) return 0;
    if (!best.found()) return halve(range, extent);
    const auto middle = std::partition(range.begin(), range.end(), [&](const BoxedObject<Real>& object) {
      return bins.bin(object, best.axis) < static_cast<int>(best.place);
    });
    return static_cast<std::size_t>(middle - range.begin());
  }

  /// Split in the middle of the longest axis, where no heuristic can tell.
  std::size_t halve(std::span<BoxedObject<Real>> range, const Extent<Real>& extent) const {
    if (range.size() <= config_.max_objects) return 0;
    const Vec3<Real> size = extent.twice_centres.extent();
    sort_by_centre(range, size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2);
    return range.size() / 2;
  }

  static Extent<Real> extent_of(std::span<const BoxedObject<Real>> range) {
    return accumulate(range, Extent<Real>{});
  }

  /// Add all objects of a range to an empty sum, in parallel where there are many.
  template <class Sum>
  static Sum accumulate(std::span<const BoxedObject<Real>> range, const Sum& empty) {
    using Part = tbb::blocked_range<std::size_t>;
    const auto add_part = [&](const Part& part, Sum sum) {
      for (std::size_t i = part.begin(); i < part.end(); ++i) add(sum, range[i]);
      return sum;
    };
    const auto join = [](Sum a, const Sum& b) {
      add(a, b);
      return a;
    };
    const Part all(0, range.size(), 16 * kSequentialObjects);
    return range.size() <= 32 * kSequentialObjects ? add_part(all, empty)
                                                   : tbb::parallel_reduce(all, empty, add_part, join);
  }
  static void add(Extent<Real>& sum, const auto& part) { sum.include(part); }
  static void add(Bins<Real>& sum, const auto& part) { sum.add(part); }

  /// Renumber the nodes depth first, without gaps.
  ChildReference compact() {
    compacted_.reserve(nodes_.size() / 2 + 1);
    return {copy_subtree(0), 0};
  }
  std::uint32_t copy_subtree(std::uint32_t node) {
    const auto copy = static_cast<std::uint32_t>(compacted_.size());
    compacted_.push_back(nodes_[node]);
    for (int side = 0; side < 2; ++side) {
      const ChildReference child = nodes_[node].child[side];
      if (!child.leaf()) {
        const std::uint32_t number = copy_subtree(child.first);
        compacted_[copy].child[side].first = number;
      }
    }
    return copy;
  }

  std::span<BoxedObject<Real>> objects_;
  SahConfig config_;
  std::vector<PairNode<Real>> nodes_;
  std::vector<PairNode<Real>> compacted_;
};

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
    Postponed stack[kStackSize];
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
    const double probability =
        static_cast<double>(box.surface_area()) / static_cast<double>(bounds_.surface_area());
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
