#include "accel/parts/sah_build.h"

#include <tbb/parallel_invoke.h>
#include <tbb/parallel_reduce.h>

#include "accel/parts/reinsertion.h"
#include "accel/parts/sah_clusters.h"
#include "accel/parts/sah_partition.h"
#include "accel/parts/sah_sweep.h"

namespace rayshoot {

namespace {

/// Smaller ranges are built by one thread.
constexpr std::size_t kSequentialObjects = 4096;
/// Larger ranges are divided by all threads.
constexpr std::size_t kParallelObjects = std::size_t{1} << 16;
/// Larger ranges are divided between 32 bins, smaller ones between 16.
constexpr std::size_t kManyBinsObjects = 512;

/// Builds the nodes over a range of objects that it reorders. A range of m objects owns the m - 1 node numbers from its
/// own on, so threads need not agree on numbers.
template <class Real>
class SahBuilder {
 public:
  SahBuilder(std::span<BoxedObject<Real>> objects, const SahConfig& config, PairNode<Real>* nodes)
      : objects_(objects), config_(config), nodes_(nodes) {}

  ChildReference build(const Extent<Real>& extent) const { return build(0, objects_.size(), extent, 0, 0); }

 private:
  ChildReference build(std::size_t first, std::size_t last, const Extent<Real>& extent, std::uint32_t node,
                       int depth) const {
    const std::span<BoxedObject<Real>> range = objects_.subspan(first, last - first);
    const ChildReference as_leaf{static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(range.size())};
    if (range.size() == 1) return as_leaf;
    if (range.size() <= kSweptObjects && depth < kBalancedDepth) return swept(range, first, extent, node);

    // Cut the range in two, or keep it whole where equation (3) expects no gain.
    const SahHalves<Real> halves = split(range, extent, depth);
    if (halves.left_count == 0) return as_leaf;

    // Build both halves, at once where they are large.
    const std::size_t middle = first + halves.left_count;
    PairNode<Real>& here = nodes_[node];
    here.boxes.set(0, Box<Real>(halves.left.box));
    here.boxes.set(1, Box<Real>(halves.right.box));
    const auto right_node = static_cast<std::uint32_t>(node + halves.left_count);
    const auto build_left = [&] { here.child[0] = build(first, middle, halves.left, node + 1, depth + 1); };
    const auto build_right = [&] {
      here.child[1] = build(middle, last, halves.right, right_node, depth + 1);
    };
    if (range.size() > kSequentialObjects)
      tbb::parallel_invoke(build_left, build_right);
    else
      build_left(), build_right();
    return {node, 0};
  }

  [[gnu::noinline]] ChildReference swept(std::span<BoxedObject<Real>> range, std::size_t first,
                                         const Extent<Real>& extent, std::uint32_t node) const {
    SweptSubtree<Real> subtree(range, first, nodes_);
    return subtree.build(extent.box, node,
                         [&](std::size_t count, const SahSplit& best) { return keeps_leaf(count, best); });
  }

  /// Reorder the range so that its first part goes left; that part is empty where the range remains a leaf.
  [[gnu::noinline]] SahHalves<Real> split(std::span<BoxedObject<Real>> range, const Extent<Real>& extent,
                                          int depth) const {
    if (depth >= kBalancedDepth) return halve(range, extent);
    return config_.method == SahMethod::sweep ? split_swept(range, extent) : split_binned(range, extent);
  }

  /// Equation (3): a leaf tests every object; a split tests two volumes and then the objects of those it
  /// hits.
  bool keeps_leaf(std::size_t count, const SahSplit& split) const {
    const bool worthwhile = split.found() && config_.traversal_cost + split.cost < static_cast<double>(count);
    return !worthwhile && count <= config_.max_objects;
  }

  SahHalves<Real> split_swept(std::span<BoxedObject<Real>> range, const Extent<Real>& extent) const {
    const SahSplit best = sweep_split(range, extent);
    if (keeps_leaf(range.size(), best)) return {};
    if (!(best.cost < static_cast<double>(range.size()))) return halve(range, extent);
    if (best.axis != 2) sort_by_centre(range, best.axis);
    return cut(range, best.place);
  }

  SahHalves<Real> split_binned(std::span<BoxedObject<Real>> range, const Extent<Real>& extent) const {
    const bool in_parallel = range.size() > kParallelObjects;
    Bins<Real> bins(extent, range.size() > kManyBinsObjects ? Bins<Real>::kMost : Bins<Real>::kMost / 2);
    if (in_parallel)
      bins = sum(range, bins);
    else
      for (const BoxedObject<Real>& object : range) bins.add(object);
    const SahSplit best = bins.best(extent);
    if (keeps_leaf(range.size(), best)) return {};
    // No split helps where all boxes are the same.
    if (!(best.cost < static_cast<double>(range.size()))) return halve(range, extent);
    return in_parallel ? partition_in_parallel(range, bins, best) : partition(range, bins, best);
  }

  /// Split in the middle of the longest axis, where no heuristic can tell.
  SahHalves<Real> halve(std::span<BoxedObject<Real>> range, const Extent<Real>& extent) const {
    if (range.size() <= config_.max_objects) return {};
    sort_by_centre(range, extent.longest_axis());
    return cut(range, range.size() / 2);
  }

  static SahHalves<Real> cut(std::span<const BoxedObject<Real>> range, std::size_t place) {
    SahHalves<Real> halves{.left_count = place};
    for (const BoxedObject<Real>& object : range.first(place)) halves.left.include(object);
    for (const BoxedObject<Real>& object : range.subspan(place)) halves.right.include(object);
    return halves;
  }

 public:
  /// Add all objects of a range to an empty sum, in parallel.
  static Bins<Real> sum(std::span<const BoxedObject<Real>> range, const Bins<Real>& empty) {
    return reduced(range, empty, [](Bins<Real>& bins, const auto& part) { bins.add(part); });
  }
  static Extent<Real> extent_of(std::span<const BoxedObject<Real>> range) {
    return reduced(range, Extent<Real>{},
                   [](Extent<Real>& extent, const auto& part) { extent.include(part); });
  }

 private:
  template <class Sum, class Add>
  static Sum reduced(std::span<const BoxedObject<Real>> range, const Sum& empty, const Add& add) {
    const tbb::blocked_range<std::size_t> all(0, range.size(), kSequentialObjects);
    return tbb::parallel_reduce(
        all, empty,
        [&](const auto& part, Sum sum) {
          for (std::size_t i = part.begin(); i < part.end(); ++i) add(sum, range[i]);
          return sum;
        },
        [&](Sum a, const Sum& b) {
          add(a, b);
          return a;
        });
  }

  std::span<BoxedObject<Real>> objects_;
  const SahConfig config_;
  PairNode<Real>* const nodes_;
};

/// Renumbers nodes depth first, without gaps.
template <class Real>
class Compacter {
 public:
  explicit Compacter(const PairTree<Real>& sparse) : sparse_(sparse) {}

  PairTree<Real> compacted() {
    compact_.bounds = sparse_.bounds;
    compact_.root = sparse_.root;
    compact_.nodes.reserve(sparse_.nodes.size() / 2 + 1);
    if (!compact_.root.leaf()) compact_.root.first = copy(sparse_.root.first);
    return std::move(compact_);
  }

 private:
  std::uint32_t copy(std::uint32_t node) {
    const auto number = static_cast<std::uint32_t>(compact_.nodes.size());
    compact_.nodes.push_back(sparse_.nodes[node]);
    for (int side = 0; side < 2; ++side) {
      const ChildReference child = sparse_.nodes[node].child[side];
      if (child.leaf()) continue;
      const std::uint32_t of_child = copy(child.first);
      compact_.nodes[number].child[side].first = of_child;
    }
    return number;
  }

  const PairTree<Real>& sparse_;
  PairTree<Real> compact_;
};

}  // namespace

Parameter sah_method_parameter() {
  return choice_parameter("build", "binned", {"binned", "fast", "sweep", "quality"},
                          "how the binary tree is built");
}

SahMethod sah_method(const Arguments& arguments) {
  const std::string& method = arguments.text("build");
  if (method == "fast") return SahMethod::fast;
  if (method == "sweep") return SahMethod::sweep;
  return method == "quality" ? SahMethod::quality : SahMethod::binned;
}

template <class Real>
HugeVector<BoxedObject<Real>> boxed_objects(const Geometry<Real>& geometry) {
  HugeVector<BoxedObject<Real>> objects(geometry.size());
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, geometry.size()), [&](const auto& part) {
    for (std::uint32_t object = part.begin(); object < part.end(); ++object)
      objects[object] = {geometry.bounds(object), object};
  });
  return objects;
}

template <class Real>
std::vector<std::uint32_t> names_of(std::span<const BoxedObject<Real>> objects) {
  std::vector<std::uint32_t> names(objects.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, objects.size()), [&](const auto& part) {
    for (std::size_t i = part.begin(); i < part.end(); ++i) names[i] = objects[i].object;
  });
  return names;
}

namespace {

/// The tree over objects in the order that its leaves name, with gaps between nodes.
template <class Real>
PairTree<Real> sparse_tree(std::span<BoxedObject<Real>> objects, const SahConfig& config) {
  const Extent<Real> extent = SahBuilder<Real>::extent_of(objects);
  PairTree<Real> tree{.bounds = Box<Real>(extent.box)};
  tree.nodes.resize(objects.size() - 1);
  tree.root = SahBuilder<Real>(objects, config, tree.nodes.data()).build(extent);
  return tree;
}

/// The tree over clusters of objects, which are its leaves.
template <class Real>
PairTree<Real> tree_of_clusters(std::span<BoxedObject<Real>> objects, const SahConfig& config) {
  SahClusters<Real> clusters(objects, SahBuilder<Real>::extent_of(objects), config.max_objects);
  HugeVector<BoxedObject<Real>> boxed = clusters.boxed();
  PairTree<Real> tree = sparse_tree<Real>(boxed, {.max_objects = 1});
  const std::vector<ChildReference> leaves = clusters.arrange(boxed);
  const auto name_objects = [&](ChildReference& child) {
    if (child.leaf()) child = leaves[child.first];
  };
  name_objects(tree.root);
  for (PairNode<Real>& node : tree.nodes) name_objects(node.child[0]), name_objects(node.child[1]);
  return tree;
}

}  // namespace

template <class Real>
PairTree<Real> sah_tree(std::span<BoxedObject<Real>> objects, const SahConfig& config) {
  if (objects.empty()) return {};
  if (config.method == SahMethod::fast) return tree_of_clusters(objects, config);
  PairTree<Real> tree = sparse_tree(objects, config);
  // Where every object has a leaf of its own no number is left out.
  if (config.max_objects > 1) tree = Compacter<Real>(tree).compacted();
  return config.method == SahMethod::quality ? reinserted(tree, objects) : std::move(tree);
}

#define RAYSHOOT_SAH_BUILD(REAL)                                                    \
  template HugeVector<BoxedObject<REAL>> boxed_objects(const Geometry<REAL>&);      \
  template std::vector<std::uint32_t> names_of(std::span<const BoxedObject<REAL>>); \
  template PairTree<REAL> sah_tree(std::span<BoxedObject<REAL>>, const SahConfig&);
RAYSHOOT_SAH_BUILD(float)
RAYSHOOT_SAH_BUILD(double)

}  // namespace rayshoot
