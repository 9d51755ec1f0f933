#include "accel/parts/wide_build.h"

namespace rayshoot {

namespace {

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
    if (!root.reference.leaf()) measure(root);
    tree_.nodes.reserve(binary_.nodes.size() / 3 + 1);
    // The root is a node even if the whole fits in a leaf.
    if (root.reference.leaf() || forest(root).leaf(1)) {
      tree_.nodes.emplace_back();
      tree_.nodes[0].add(root.box, WideChild::leaf(first(root), count(root)));
      tree_.max_depth = 1;
    } else {
      emit(root, 0);
    }
    return std::move(tree_);
  }

 private:
  struct Subtree {
    ChildReference reference;
    Box<Real> box;
  };
  /// Of an interior node of the binary tree.
  struct Forest {
    /// Least cost as at most i + 1 trees.
    float cost[kWideWidth - 1];
    std::uint32_t first, count;
    /// Of at most i + 1 trees, those that go to the left child; 0 where one tree less is as good. For one tree, those of
    /// a node, or 0 for a leaf.
    std::uint8_t left[kWideWidth - 1];

    bool leaf(int trees) const { return left[trees - 1] == 0; }
  };

  const Forest& forest(const Subtree& subtree) const { return forests_[subtree.reference.first]; }
  std::uint32_t first(const Subtree& subtree) const {
    return subtree.reference.leaf() ? subtree.reference.first : forest(subtree).first;
  }
  std::uint32_t count(const Subtree& subtree) const {
    return subtree.reference.leaf() ? subtree.reference.count : forest(subtree).count;
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
  float cost(const Subtree& subtree, int trees) const {
    return subtree.reference.leaf() ? static_cast<float>(costs_.of_leaf(1)) * area(subtree.box)
                                    : forest(subtree).cost[trees - 1];
  }

  /// Find the least costs of a subtree, its children's first.
  void measure(const Subtree& subtree) {
    const Subtree left = child(subtree, 0), right = child(subtree, 1);
    for (const Subtree& side : {left, right})
      if (!side.reference.leaf()) measure(side);
    Forest& here = forests_[subtree.reference.first];
    here.first = first(left), here.count = count(left) + count(right);

    const auto shared = [&](int trees) {
      std::pair<float, std::uint8_t> best{std::numeric_limits<float>::infinity(), 1};
      for (int to_left = 1; to_left < trees; ++to_left) {
        const int most = kWideWidth - 1;
        const float sum = cost(left, std::min(to_left, most)) + cost(right, std::min(trees - to_left, most));
        if (sum < best.first) best = {sum, static_cast<std::uint8_t>(to_left)};
      }
      return best;
    };
    const float own_area = area(subtree.box);
    const auto [children, to_left] = shared(kWideWidth);
    here.cost[0] = own_area + children, here.left[0] = to_left;
    const float as_leaf = static_cast<float>(costs_.of_leaf(here.count)) * own_area;
    if (here.count <= costs_.max_objects && as_leaf <= here.cost[0]) here.cost[0] = as_leaf, here.left[0] = 0;
    for (int trees = 2; trees < kWideWidth; ++trees) {
      const auto [sum, side] = shared(trees);
      const bool pays = sum < here.cost[trees - 2];
      here.cost[trees - 1] = pays ? sum : here.cost[trees - 2];
      here.left[trees - 1] = pays ? side : 0;
    }
  }

  std::uint32_t emit(const Subtree& subtree, std::uint32_t depth) {
    tree_.max_depth = std::max(tree_.max_depth, depth + 1);
    const auto number = static_cast<std::uint32_t>(tree_.nodes.size());
    tree_.nodes.emplace_back();
    std::vector<Subtree> children;
    share(subtree, forest(subtree).left[0], kWideWidth, children);
    for (const Subtree& each : children) {
      const bool is_leaf = each.reference.leaf() || forest(each).leaf(1);
      const WideChild made =
          is_leaf ? WideChild::leaf(first(each), count(each)) : WideChild::interior(emit(each, depth + 1));
      tree_.nodes[number].add(each.box, made);
    }
    return number;
  }
  /// Collect the trees of a subtree's children, `to_left` of `trees` from the left one.
  void share(const Subtree& subtree, int to_left, int trees, std::vector<Subtree>& into) const {
    collect(child(subtree, 0), to_left, into);
    collect(child(subtree, 1), trees - to_left, into);
  }
  void collect(const Subtree& subtree, int trees, std::vector<Subtree>& into) const {
    if (subtree.reference.leaf()) return into.push_back(subtree);
    trees = std::min(trees, kWideWidth - 1);
    while (trees > 1 && forest(subtree).left[trees - 1] == 0) --trees;
    if (trees == 1) return into.push_back(subtree);
    share(subtree, forest(subtree).left[trees - 1], trees, into);
  }

  const PairTree<Real>& binary_;
  const WideCosts costs_;
  std::vector<Forest> forests_;
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
