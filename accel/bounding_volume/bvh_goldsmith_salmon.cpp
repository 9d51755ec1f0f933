// Automatically generated bounding volume hierarchy (Arvo & Kirk §4.3)
// J. Goldsmith, J. Salmon, "Automatic creation of object hierarchies for ray tracing", 1987.
//
// Idea       Insert the objects one by one into a growing tree, each where it increases the cost that
//            equation (3) expects by the least. The search for that place starts at the root and follows the
//            child whose surface area would grow the least; of children that tie all are searched. The tree
//            depends on the order of insertion, so several random orders may be tried and the cheapest tree
//            kept.
// Parameters order     given (the modeller's), sorted (along the longest axis) or shuffled; shuffled, since
//                      the paper found sorted order detrimental and random orders best
//            shuffles  how many random orders to try; 1, since every one costs a whole build
//            seed      of the shuffles
//            visit     nearest_first sorts the children that a ray hits; listed visits them in a fixed order, where a near
//                      hit is found early by chance alone (§4)
//            object_volumes
//                      on; off: every ray that hits a node tests its objects, as Haines' figures suggest his program did
// Cost       equation (3), exactly, for uniformly distributed rays without occlusion; the build is O(n log
//            n).
// Weak       objects of very different size inserted in the modeller's order; any scene that sorted order
//            suits badly.

#include <numeric>
#include <random>

#include "accel/core/define_technique.h"
#include "accel/parts/growing_tree.h"

namespace rayshoot {

namespace {

enum class InsertionOrder { given, sorted, shuffled };

struct GrowthConfig {
  InsertionOrder order = InsertionOrder::shuffled;
  int shuffles = 1;
  std::uint64_t seed = 1;
  /// Whether a ray visits the children of a node near to far, or in the order in which they are listed.
  bool nearest_first = true;
  /// Whether the volume of an object is tested before the object.
  bool object_volumes = true;
};

template <class Real>
std::vector<std::uint32_t> insertion_order(const Geometry<Real>& geometry, const GrowthConfig& config,
                                           int attempt) {
  std::vector<std::uint32_t> order(geometry.size());
  std::iota(order.begin(), order.end(), 0u);
  if (config.order == InsertionOrder::shuffled) {
    std::mt19937_64 random(config.seed + static_cast<std::uint64_t>(attempt));
    std::shuffle(order.begin(), order.end(), random);
  } else if (config.order == InsertionOrder::sorted) {
    const int axis = largest_axis(geometry.bounds().extent());
    const auto twice_centre = [&](std::uint32_t object) {
      const Box<Real> box = geometry.bounds(object);
      return box.lo[axis] + box.hi[axis];
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](auto a, auto b) { return twice_centre(a) < twice_centre(b); });
  }
  return order;
}

template <class Real>
class BvhGoldsmithSalmon {
 public:
  using Scalar = Real;
  using Config = GrowthConfig;

  /// A child with its volume: the object at a position, or the interior node whose children lie in [first,
  /// last).
  struct Child {
    Box<Real> box;
    std::uint32_t first, last;

    bool is_object() const { return last == kNoNode; }
  };
  struct Postponed {
    Real enter;
    std::uint32_t child;
  };
  struct Scratch {
    std::vector<Postponed> stack;
  };

  static TechniqueInfo info() {
    return {.id = "bvh_goldsmith_salmon",
            .title = "Automatically generated bounding volume hierarchy",
            .family = "bounding_volume",
            .survey_section = "4",
            .paper = "Goldsmith & Salmon 1987",
            .parameters = {
                choice_parameter("order", "shuffled", {"given", "sorted", "shuffled"},
                                 "order in which objects are inserted"),
                integer_parameter("shuffles", 1, 1, 1000, "random orders to try, of which the best is kept"),
                integer_parameter("seed", 1, 0, 1e15, "seed of the random orders"),
                choice_parameter("visit", "nearest_first", {"nearest_first", "listed"},
                                 "order in which a ray visits the children of a node"),
                boolean_parameter("object_volumes", true,
                                  "an object is tested only by rays that hit its own volume")}};
  }
  static Config configure(const Arguments& arguments) {
    const std::string& order = arguments.text("order");
    if (order != "shuffled" && arguments.integer("shuffles") != 1)
      throw InputError("bvh_goldsmith_salmon: shuffles is for order=shuffled; with order=" + order +
                       " leave it at 1");
    return {.order = order == "given"    ? InsertionOrder::given
                     : order == "sorted" ? InsertionOrder::sorted
                                         : InsertionOrder::shuffled,
            .shuffles = static_cast<int>(arguments.integer("shuffles")),
            .seed = static_cast<std::uint64_t>(arguments.integer("seed")),
            .nearest_first = arguments.text("visit") == "nearest_first",
            .object_volumes = arguments.boolean("object_volumes")};
  }

  static BvhGoldsmithSalmon build(const BuildInput<Real>& in, const Config& config) {
    BvhGoldsmithSalmon bvh;
    bvh.bounds_ = in.geometry.bounds();
    bvh.nearest_first_ = config.nearest_first, bvh.object_volumes_ = config.object_volumes;
    if (in.geometry.size() == 0) return bvh;

    // Grow a tree for every order and keep the one that equation (3) likes best.
    std::optional<GrowingTree<Real>> best;
    for (int attempt = 0; attempt < config.shuffles; ++attempt) {
      GrowingTree<Real> tree(in.geometry);
      for (const std::uint32_t object : insertion_order(in.geometry, config, attempt)) tree.insert(object);
      bvh.costs_.push_back(tree.cost() / bvh.bounds_.surface_area());
      if (!best || bvh.costs_.back() < bvh.costs_[bvh.best_]) {
        bvh.best_ = bvh.costs_.size() - 1;
        best = std::move(tree);
      }
    }
    bvh.lay_out(*best);
    return bvh;
  }

  Scratch scratch() const { return {}; }
  std::span<const std::uint32_t> order() const { return order_; }

  /// Test all children of a node that is hit, then go through those hit, from near to far or as they are listed.
  template <class Counter, class L>
  void visit(const Ray<Real>& ray, Scratch& scratch, Counter count, L& leaf) const {
    if (order_.empty()) return;
    const Crossings<Real> crossings(ray);
    const auto entered = [&](const Box<Real>& box) -> std::optional<Real> {
      count.volume_tests();
      const Interval<Real> inside = crossings.inside(box);
      const Real enter = std::max(inside.enter, ray.t_min);
      if (enter <= std::min(inside.exit, leaf.reach())) return enter;
      return std::nullopt;
    };
    const std::optional<Real> enters_root = entered(bounds_);
    if (!enters_root) return;

    std::vector<Postponed>& stack = scratch.stack;
    stack.clear();
    Child current{bounds_, 0, root_children_};
    Real enters_current = *enters_root;
    while (true) {
      if (current.is_object()) {
        count.cell(false);
        if (leaf(current.first)) return;
      } else {
        // Postpone every child that is hit, the first to be visited on top of the stack.
        count.step();
        const std::size_t bottom = stack.size();
        for (std::uint32_t child = current.first; child < current.last; ++child) {
          const bool untested = children_[child].is_object() && !object_volumes_;
          const std::optional<Real> enter = untested ? enters_current : entered(children_[child].box);
          if (!enter) continue;
          stack.push_back({*enter, child});
          if (!nearest_first_) continue;
          for (std::size_t i = stack.size() - 1; i > bottom && stack[i - 1].enter < stack[i].enter; --i)
            std::swap(stack[i - 1], stack[i]);
        }
        if (!nearest_first_) std::reverse(stack.begin() + static_cast<std::ptrdiff_t>(bottom), stack.end());
      }
      // Take the next child that no hit has made pointless meanwhile.
      while (!stack.empty() && stack.back().enter > leaf.reach()) stack.pop_back();
      if (stack.empty()) return;
      current = children_[stack.back().child];
      enters_current = stack.back().enter;
      stack.pop_back();
    }
  }

  /// Figures: the volume tests that equation (3) expects of a ray that hits the root, for the best of the orders tried, on
  /// average and for the worst.
  StructureStats structure() const {
    StructureStats stats{.nodes = children_.size() + (order_.empty() ? 0 : 1),
                         .leaves = order_.size(),
                         .references = order_.size(),
                         .max_depth = max_depth_,
                         .bytes = children_.size() * sizeof(Child) + order_.size() * sizeof(order_[0])};
    if (costs_.empty()) return stats;
    stats.figures["best_order_volume_tests"] = costs_[best_];
    stats.figures["mean_order_volume_tests"] =
        std::reduce(costs_.begin(), costs_.end()) / static_cast<double>(costs_.size());
    stats.figures["worst_order_volume_tests"] = *std::max_element(costs_.begin(), costs_.end());
    return stats;
  }

  /// Equation (3): an interior node that is hit costs a volume test for each child, an object whose volume is hit costs an
  /// object test; without volumes of objects, their tests are those of their node's children.
  Prediction<Real> predicted() const {
    Prediction<Real> sum{0, 1, bounds_};
    const auto add_children = [&](double probability, std::uint32_t first, std::uint32_t last) {
      for (std::uint32_t child = first; child < last; ++child) {
        const bool untested = children_[child].is_object() && !object_volumes_;
        (untested ? sum.object_tests : sum.volume_tests) += probability;
      }
    };
    add_children(1, 0, root_children_);
    for (const Child& child : children_) {
      const double probability = child.box.surface_area() / bounds_.surface_area();
      if (!child.is_object())
        add_children(probability, child.first, child.last);
      else if (object_volumes_)
        sum.object_tests += probability;
    }
    return sum;
  }

  template <class Visit>
  void for_each_volume(const Visit& visit) const {
    visit(HierarchyVolume{.volume_tests = 1});
    if (!order_.empty()) visit_below({bounds_, 0, root_children_}, 1, visit);
  }

 private:
  template <class Visit>
  void visit_below(const Child& child, std::uint32_t depth, const Visit& visit) const {
    if (child.is_object())
      return visit(HierarchyVolume{depth, 0, object_volumes_ ? 1u : 0u, child.first, child.first + 1});
    HierarchyVolume volume{.depth = depth};
    for (std::uint32_t i = child.first; i < child.last; ++i)
      ++(children_[i].is_object() && !object_volumes_ ? volume.object_tests : volume.volume_tests);
    visit(volume);
    for (std::uint32_t i = child.first; i < child.last; ++i) visit_below(children_[i], depth + 1, visit);
  }

  /// Lay the tree out depth first: the children of a node side by side, objects in the order of the walk.
  void lay_out(const GrowingTree<Real>& tree) {
    struct Pending {
      std::uint32_t node, child;
      std::uint64_t depth;
    };
    const auto place_children = [&](std::uint32_t node, std::uint64_t depth, std::vector<Pending>& pending) {
      max_depth_ = std::max(max_depth_, depth + 1);
      for (std::uint32_t c = tree[node].first_child; c != kNoNode; c = tree[c].next_sibling) {
        pending.push_back({c, static_cast<std::uint32_t>(children_.size()), depth + 1});
        children_.push_back({tree[c].box, 0, 0});
      }
    };
    std::vector<Pending> pending;
    root_children_ = tree[tree.root()].children;
    place_children(tree.root(), 0, pending);
    while (!pending.empty()) {
      const Pending next = pending.back();
      pending.pop_back();
      if (tree.is_object(next.node)) {
        children_[next.child].first = static_cast<std::uint32_t>(order_.size());
        children_[next.child].last = kNoNode;
        order_.push_back(next.node);
        continue;
      }
      const auto first = static_cast<std::uint32_t>(children_.size());
      place_children(next.node, next.depth, pending);
      children_[next.child].first = first;
      children_[next.child].last = static_cast<std::uint32_t>(children_.size());
    }
  }

  std::vector<Child> children_;
  std::vector<std::uint32_t> order_;
  std::uint32_t root_children_ = 0;
  std::uint64_t max_depth_ = 0;
  Box<Real> bounds_;
  bool nearest_first_ = true, object_volumes_ = true;
  /// Equation (3) of every order tried, and which of them was kept.
  std::vector<double> costs_;
  std::size_t best_ = 0;
};

}  // namespace

RAYSHOOT_TECHNIQUE(bvh_goldsmith_salmon, BvhGoldsmithSalmon)

}  // namespace rayshoot
