#include "accel/parts/wide_build.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

namespace rayshoot {

namespace {

/// Subtrees of so many objects and their like are laid out by one thread.
constexpr std::uint32_t kSequentialObjects = 4096;
/// Nodes less deep are measured by several threads.
constexpr int kParallelDepth = 10;

/// Eight costs at once (the vector extension of GCC and Clang), and as many choices.
typedef float Costs __attribute__((vector_size(32)));
typedef std::int32_t Choices __attribute__((vector_size(32)));
typedef std::uint8_t Bytes __attribute__((vector_size(8)));
constexpr float kNever = std::numeric_limits<float>::infinity();

/// After T. Karras & S. Laine for leaves and H. Ylitie, T. Karras & S. Laine, "Efficient incoherent ray traversal on GPUs
/// through compressed wide BVHs", 2017, for nodes: the least cost of every subtree as a forest of at most so many
/// trees, from the leaves up.
template <class Real>
class Widener {
 public:
  Widener(const PairTree<Real>& binary, const WideCosts& costs)
      : binary_(binary), costs_(costs), forests_(binary.nodes.size()) {}

  WideTree<Real> build() {
    tree_.bounds = binary_.bounds;
    if (binary_.empty()) return std::move(tree_);
    const Subtree root{binary_.root, binary_.bounds};
    measure(root, 0);
    tree_.nodes.reserve(binary_.nodes.size() / 6 + 1);
    // The root is a node even if the whole fits in a leaf.
    if (is_leaf(root)) {
      tree_.nodes.emplace_back();
      tree_.nodes[0].add(root.box, WideChild::leaf(first(root), count(root)));
      tree_.max_depth = 1;
    } else {
      lay_out(root);
    }
    return std::move(tree_);
  }

 private:
  static_assert(kWideWidth == 8, "costs fill one vector");

  struct Subtree {
    ChildReference reference;
    Box<Real> box;
  };
  /// Of an interior node of the binary tree.
  struct Forest {
    std::uint32_t first, count;
    /// Of at most i + 1 trees, those that go to the left child; 0 where one tree less is as good. For one tree, those of
    /// a node, or 0 for a leaf.
    Bytes left;
  };
  /// Up to eight trees.
  struct Trees {
    Subtree tree[kWideWidth];
    int count = 0;
  };
  /// A part of the tree that one thread lays out: what is below a child of a node.
  struct Part {
    Subtree subtree;
    std::uint32_t node, which, depth;
    std::vector<WideNode<Real>> nodes{};
    std::uint32_t max_depth = 0;
  };

  const Forest& forest(const Subtree& subtree) const { return forests_[subtree.reference.first]; }
  std::uint32_t first(const Subtree& subtree) const {
    return subtree.reference.leaf() ? subtree.reference.first : forest(subtree).first;
  }
  std::uint32_t count(const Subtree& subtree) const {
    return subtree.reference.leaf() ? subtree.reference.count : forest(subtree).count;
  }
  bool is_leaf(const Subtree& subtree) const {
    return subtree.reference.leaf() || forest(subtree).left[0] == 0;
  }
  Subtree child(const Subtree& subtree, int side) const {
    const PairNode<Real>& node = binary_.nodes[subtree.reference.first];
    return {node.child[side], node.boxes.box(side)};
  }

  /// Costs in units of the surface area of the root.
  float area(const Box<Real>& box) const {
    const double whole = binary_.bounds.surface_area();
    return whole > 0 ? static_cast<float>(box.surface_area() / whole) : 1;
  }

  /// Find the least costs of a subtree as at most 1, 2 ... 7 trees, its children's first.
  Costs measure(const Subtree& subtree, int depth) {
    const float own_area = area(subtree.box);
    if (subtree.reference.leaf())
      return Costs{} + static_cast<float>(costs_.of_leaf(subtree.reference.count)) * own_area;
    const Subtree left = child(subtree, 0), right = child(subtree, 1);
    Costs of_left, of_right;
    const auto measure_left = [&] { of_left = measure(left, depth + 1); };
    const auto measure_right = [&] { of_right = measure(right, depth + 1); };
    if (depth < kParallelDepth)
      tbb::parallel_invoke(measure_left, measure_right);
    else
      measure_left(), measure_right();

    Forest& here = forests_[subtree.reference.first];
    here.first = first(left), here.count = count(left) + count(right);
    Choices to_left = {};
    const Costs exactly = shared(of_left, of_right, to_left, std::make_index_sequence<kWideWidth - 1>());
    // One tree is a node of eight, or a leaf.
    float least = own_area + exactly[kWideWidth - 1];
    std::int32_t of_one = to_left[kWideWidth - 1];
    const float as_leaf = static_cast<float>(costs_.of_leaf(here.count)) * own_area;
    if (here.count <= costs_.max_objects && as_leaf <= least) least = as_leaf, of_one = 0;
    // More trees need not be made where less are as good.
    Costs at_most = exactly;
    at_most[0] = least;
    at_most = min_lanes(at_most, behind<1>(at_most));
    at_most = min_lanes(at_most, behind<2>(at_most));
    at_most = min_lanes(at_most, behind<4>(at_most));
    to_left = exactly < behind<1>(at_most) ? to_left : Choices{};
    to_left[0] = of_one;
    here.left = __builtin_convertvector(to_left, Bytes);
    return at_most;
  }

  /// The least costs of two subtrees as exactly 1, 2 ... 8 trees, which is none for one, and how many of these go to the left one.
  template <std::size_t... kTrees>
  static Costs shared(const Costs& left, const Costs& right, Choices& to_left,
                      std::index_sequence<kTrees...>) {
    Costs least = Costs{} + kNever;
    const auto consider = [&](const Costs& sum, int trees) {
      to_left = sum < least ? Choices{} + trees : to_left;
      least = min_lanes(sum, least);
    };
    (consider(left[kTrees] + behind<kTrees + 1>(right), kTrees + 1), ...);
    return least;
  }
  /// Costs moved to so many trees more.
  template <int kMore>
  static Costs behind(const Costs& costs) {
    const Costs never = Costs{} + kNever;
    return __builtin_shufflevector(never, costs, 8 - kMore, 9 - kMore, 10 - kMore, 11 - kMore, 12 - kMore,
                                   13 - kMore, 14 - kMore, 15 - kMore);
  }

  /// Lay out the top of the tree, then its parts at once, and put them one behind the other.
  void lay_out(const Subtree& root) {
    std::vector<Part> parts;
    emit(root, 0, tree_.nodes, tree_.max_depth, &parts);
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
      parts[i].nodes.reserve(count(parts[i].subtree) / 4 + 1);
      emit(parts[i].subtree, parts[i].depth, parts[i].nodes, parts[i].max_depth, nullptr);
    });
    for (Part& part : parts) {
      const auto offset = static_cast<std::uint32_t>(tree_.nodes.size());
      tree_.nodes[part.node].child[part.which] = WideChild::interior(offset);
      for (WideNode<Real>& node : part.nodes) {
        for (std::uint32_t which = 0; which < node.children; ++which)
          if (!node.child[which].is_leaf())
            node.child[which] = WideChild::interior(offset + node.child[which].node());
        tree_.nodes.push_back(node);
      }
      tree_.max_depth = std::max(tree_.max_depth, part.max_depth);
      part.nodes = {};
    }
  }

  /// Append the nodes of a subtree, but for small subtrees where `parts` collects them; returns the number of its root.
  template <class Nodes>
  std::uint32_t emit(const Subtree& subtree, std::uint32_t depth, Nodes& nodes, std::uint32_t& max_depth,
                     std::vector<Part>* parts) const {
    max_depth = std::max(max_depth, depth + 1);
    const auto number = static_cast<std::uint32_t>(nodes.size());
    nodes.emplace_back();
    Trees children;
    share(subtree, forest(subtree).left[0], kWideWidth, children);
    for (int which = 0; which < children.count; ++which) {
      const Subtree& each = children.tree[which];
      WideChild made = WideChild::leaf(first(each), count(each));
      if (!is_leaf(each) && parts && count(each) <= kSequentialObjects)
        parts->push_back({each, number, static_cast<std::uint32_t>(which), depth + 1});
      else if (!is_leaf(each))
        made = WideChild::interior(emit(each, depth + 1, nodes, max_depth, parts));
      nodes[number].add(each.box, made);
    }
    return number;
  }
  /// Collect the trees of a subtree's children, `to_left` of `trees` from the left one.
  void share(const Subtree& subtree, int to_left, int trees, Trees& into) const {
    collect(child(subtree, 0), to_left, into);
    collect(child(subtree, 1), trees - to_left, into);
  }
  void collect(const Subtree& subtree, int trees, Trees& into) const {
    trees = std::min(trees, kWideWidth - 1);
    while (trees > 1 && !subtree.reference.leaf() && forest(subtree).left[trees - 1] == 0) --trees;
    if (trees == 1 || subtree.reference.leaf())
      into.tree[into.count++] = subtree;
    else
      share(subtree, forest(subtree).left[trees - 1], trees, into);
  }

  const PairTree<Real>& binary_;
  const WideCosts costs_;
  HugeVector<Forest> forests_;
  WideTree<Real> tree_;
};

}  // namespace

template <class Real>
WideTree<Real> widened_tree(const PairTree<Real>& binary, const WideCosts& costs) {
  return Widener<Real>(binary, costs).build();
}

template WideTree<float> widened_tree(const PairTree<float>&, const WideCosts&);
template WideTree<double> widened_tree(const PairTree<double>&, const WideCosts&);

}  // namespace rayshoot
