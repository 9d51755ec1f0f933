#include "accel/parts/reinsertion.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace rayshoot {

namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFu;
/// In each round the largest of all nodes, by this share and at least so many, look for a better place.
constexpr double kShareOfNodes = 0.2;
constexpr std::size_t kLeastCandidates = 1000;
constexpr int kRounds = 4;

template <class Real>
class Reinserter {
 public:
  explicit Reinserter(const PairTree<Real>& tree) : nodes_(tree.size()), leaves_(tree.nodes.size() + 1) {
    root_ = copy(tree, tree.root, kNone, united(tree.bounds));
  }

  /// One round: seek places in parallel, then move the subtrees that gain most.
  void improve() {
    std::vector<std::uint32_t> candidates = largest_nodes();
    std::vector<Move> moves(candidates.size());
    tbb::enumerable_thread_specific<std::vector<Below>> stacks;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, candidates.size(), 64), [&](const auto& part) {
      std::vector<Below>& stack = stacks.local();
      for (std::size_t i = part.begin(); i < part.end(); ++i) moves[i] = best_move(candidates[i], stack);
    });
    std::erase_if(moves, [](const Move& move) { return move.place == kNone; });
    std::ranges::sort(moves, [](const Move& a, const Move& b) {
      return a.gain > b.gain || (a.gain == b.gain && a.node < b.node);
    });
    std::vector<bool> touched(nodes_.size());
    for (const Move& move : moves)
      if (claim(move, touched) && is_possible(move)) apply(move);
  }

  /// The tree with its nodes depth first, and the objects in the order of its leaves.
  PairTree<Real> tree(const Box<Real>& bounds, std::span<BoxedObject<Real>> objects) const {
    PairTree<Real> tree{.bounds = bounds};
    tree.nodes.reserve(leaves_.size() - 1);
    const HugeVector<BoxedObject<Real>> old(objects.begin(), objects.end());
    std::uint32_t placed = 0;
    tree.root = lay_out(root_, tree, old, objects, placed);
    return tree;
  }

 private:
  struct Node {
    BoxUnion<Real> box;
    std::uint32_t parent;
    /// Of a leaf, none and its number.
    std::uint32_t child[2];
    /// Interior nodes on the longest way from here to a leaf.
    std::uint32_t height = 0;
  };
  struct Move {
    std::uint32_t node, place = kNone;
    double gain = 0;
  };
  /// A subtree in which a place is sought, and what has been saved where it is entered.
  struct Below {
    std::uint32_t node;
    double saved;
  };

  static BoxUnion<Real> united(const Box<Real>& box) {
    const LaneBox<Real> lanes = BoxedObject<Real>{box, 0}.lanes();
    return {lanes.lo, lanes.hi};
  }
  bool is_leaf(std::uint32_t node) const { return nodes_[node].child[0] == kNone; }
  double area(std::uint32_t node) const { return nodes_[node].box.half_area(); }
  double area_with(std::uint32_t node, const BoxUnion<Real>& box) const {
    BoxUnion<Real> both = nodes_[node].box;
    both.include(box);
    return both.half_area();
  }
  std::uint32_t sibling(std::uint32_t node) const {
    const Node& parent = nodes_[nodes_[node].parent];
    return parent.child[parent.child[0] == node];
  }

  std::uint32_t copy(const PairTree<Real>& tree, const ChildReference& from, std::uint32_t parent,
                     const BoxUnion<Real>& box) {
    const std::uint32_t node = copied_++;
    nodes_[node] = {box, parent, {kNone, copied_leaves_}};
    if (from.leaf()) {
      leaves_[copied_leaves_++] = from;
      return node;
    }
    const PairNode<Real>& pair = tree.nodes[from.first];
    for (int side = 0; side < 2; ++side)
      nodes_[node].child[side] = copy(tree, pair.child[side], node, united(pair.boxes.box(side)));
    nodes_[node].height = height(nodes_[node].child[0], nodes_[node].child[1]);
    return node;
  }

  std::vector<std::uint32_t> largest_nodes() const {
    std::vector<std::pair<double, std::uint32_t>> by_area(nodes_.size());
    tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(nodes_.size()), [&](std::uint32_t node) {
      by_area[node] = {-area(node), node};
    });
    std::erase_if(by_area, [&](const auto& each) { return each.second == root_; });
    const std::size_t share = static_cast<std::size_t>(kShareOfNodes * static_cast<double>(by_area.size()));
    const std::size_t count = std::min(by_area.size(), std::max(share, kLeastCandidates));
    std::nth_element(by_area.begin(), by_area.begin() + static_cast<std::ptrdiff_t>(count) - 1,
                     by_area.end());
    std::vector<std::uint32_t> largest(count);
    std::ranges::transform(std::span(by_area).first(count), largest.begin(),
                           [](const auto& each) { return each.second; });
    return largest;
  }

  /// Where a subtree costs least: climb from it to the root and look below everything that stands beside the way.
  Move best_move(std::uint32_t node, std::vector<Below>& stack) const {
    const BoxUnion<Real>& box = nodes_[node].box;
    Move best{node};
    // Without the subtree its parent goes, whose place its sibling takes.
    const std::uint32_t parent = nodes_[node].parent;
    double saved = area(parent);
    std::uint32_t beside = sibling(node);
    BoxUnion<Real> left = nodes_[beside].box;
    while (true) {
      seek_below(beside, box, saved, best, stack);
      const std::uint32_t above = nodes_[beside].parent;
      // What is above has shrunk by the subtree.
      if (above != parent) {
        left.include(nodes_[beside].box);
        saved += area(above) - left.half_area();
      }
      if (above == root_) return best;
      beside = sibling(above);
    }
  }
  void seek_below(std::uint32_t beside, const BoxUnion<Real>& box, double saved, Move& best,
                  std::vector<Below>& stack) const {
    const double own_area = box.half_area();
    stack.assign(1, {beside, saved});
    while (!stack.empty()) {
      const Below here = stack.back();
      stack.pop_back();
      // A new parent of both costs its area at least.
      if (!(here.saved - own_area > best.gain)) continue;
      const double with = area_with(here.node, box);
      consider(here.node, here.saved - with, best);
      // Below, this node grows by the subtree.
      const double saved_below = here.saved + area(here.node) - with;
      if (is_leaf(here.node) || !(saved_below - own_area > best.gain)) continue;
      for (const std::uint32_t child : nodes_[here.node].child) stack.push_back({child, saved_below});
    }
  }
  static void consider(std::uint32_t place, double gain, Move& best) {
    if (gain > best.gain) best.place = place, best.gain = gain;
  }

  /// Whether no move of this round has changed what this one changes, and from now on it has.
  bool claim(const Move& move, std::vector<bool>& touched) const {
    if (touched[move.node]) return false;
    const std::uint32_t parent = nodes_[move.node].parent;
    const std::uint32_t changed[] = {move.node,  sibling(move.node),       parent, nodes_[parent].parent,
                                     move.place, nodes_[move.place].parent};
    for (const std::uint32_t node : changed)
      if (node != kNone && touched[node]) return false;
    for (const std::uint32_t node : changed)
      if (node != kNone) touched[node] = true;
    return true;
  }
  /// Not where other moves have put the place below the subtree, nor where the tree gets too deep for searches.
  bool is_possible(const Move& move) const {
    std::uint32_t depth = 0;
    for (std::uint32_t node = move.place; node != root_; node = nodes_[node].parent, ++depth)
      if (node == move.node) return false;
    return depth + height(move.node, move.place) <= kMaxSahDepth;
  }
  std::uint32_t height(std::uint32_t left, std::uint32_t right) const {
    return 1 + std::max(nodes_[left].height, nodes_[right].height);
  }

  /// Make a move, unless moves of the same round have turned its gain into a loss.
  void apply(const Move& move) {
    const std::uint32_t back = sibling(move.node);
    if (!(area_saved_by(move.node, move.place) > 0)) area_saved_by(move.node, back);
  }
  /// Move a subtree with its parent, which becomes the parent of the place.
  double area_saved_by(std::uint32_t node, std::uint32_t place) {
    const std::uint32_t parent = nodes_[node].parent, other = sibling(node), above = nodes_[parent].parent;
    replace(above, parent, other);
    replace(nodes_[place].parent, place, parent);
    nodes_[parent].child[0] = place, nodes_[parent].child[1] = node;
    nodes_[place].parent = nodes_[node].parent = parent;
    return area_saved_by_refitting(above) + area_saved_by_refitting(parent);
  }
  void replace(std::uint32_t parent, std::uint32_t child, std::uint32_t by) {
    nodes_[by].parent = parent;
    if (parent == kNone)
      root_ = by;
    else
      nodes_[parent].child[nodes_[parent].child[1] == child] = by;
  }
  double area_saved_by_refitting(std::uint32_t node) {
    double saved = 0;
    for (; node != kNone; node = nodes_[node].parent) {
      const auto [left, right] = nodes_[node].child;
      saved += area(node);
      nodes_[node].box = nodes_[left].box;
      nodes_[node].box.include(nodes_[right].box);
      nodes_[node].height = height(left, right);
      saved -= area(node);
    }
    return saved;
  }

  ChildReference lay_out(std::uint32_t node, PairTree<Real>& tree, const HugeVector<BoxedObject<Real>>& old,
                         std::span<BoxedObject<Real>> objects, std::uint32_t& placed) const {
    if (is_leaf(node)) {
      const ChildReference& leaf = leaves_[nodes_[node].child[1]];
      std::copy_n(old.begin() + leaf.first, leaf.count, objects.begin() + placed);
      placed += leaf.count;
      return {placed - leaf.count, leaf.count};
    }
    const auto number = static_cast<std::uint32_t>(tree.nodes.size());
    tree.nodes.emplace_back();
    for (int side = 0; side < 2; ++side) {
      const std::uint32_t child = nodes_[node].child[side];
      tree.nodes[number].boxes.set(side, Box<Real>(nodes_[child].box));
      const ChildReference made = lay_out(child, tree, old, objects, placed);
      tree.nodes[number].child[side] = made;
    }
    return {number, 0};
  }

  HugeVector<Node> nodes_;
  std::vector<ChildReference> leaves_;
  std::uint32_t root_ = 0, copied_ = 0, copied_leaves_ = 0;
};

}  // namespace

template <class Real>
PairTree<Real> reinserted(const PairTree<Real>& tree, std::span<BoxedObject<Real>> objects) {
  if (tree.nodes.empty()) return tree;
  Reinserter<Real> reinserter(tree);
  for (int round = 0; round < kRounds; ++round) reinserter.improve();
  return reinserter.tree(tree.bounds, objects);
}

template PairTree<float> reinserted(const PairTree<float>&, std::span<BoxedObject<float>>);
template PairTree<double> reinserted(const PairTree<double>&, std::span<BoxedObject<double>>);

}  // namespace rayshoot
