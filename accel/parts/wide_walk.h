#pragma once

#include "accel/parts/branch.h"
#include "accel/parts/pair_tree.h"
#include "accel/parts/wide_crossings.h"

// Read where code for a kind of processor begins: all that is not included is a template over its instructions.

namespace rayshoot {

/// children[which], found by a jump: the processor guesses where it goes and is at the child before `which` is worked out.
[[gnu::always_inline]] inline WideChild guessed(const WideChild* children, unsigned which) {
  WideChild child;
  const auto arrive = [&](int number) {
    child = children[number];
    keep_branch();
  };
  switch (which) {
    case 0:
      arrive(0);
      break;
    case 1:
      arrive(1);
      break;
    case 2:
      arrive(2);
      break;
    case 3:
      arrive(3);
      break;
    case 4:
      arrive(4);
      break;
    case 5:
      arrive(5);
      break;
    case 6:
      arrive(6);
      break;
    case 7:
      arrive(7);
      break;
    default:
      __builtin_unreachable();
  }
  return child;
}

/// How to walk when successive rays take much the same way: the next child is guessed.
template <class Isa>
struct WideCoherent {
  static WideChild next(const WideChild* children, unsigned which) { return guessed(children, which); }
  static void fetch(WideChild) {}
};
/// How to walk when they do not: guesses would fail, and what waits is best fetched meanwhile.
template <class Isa, class Real>
struct WideIncoherent {
  const WideNode<Real>* nodes;
  /// What leaves hold, `bytes` for each object.
  const char* leaves;
  std::size_t bytes;

  /// Of a node all, and of most leaves.
  static constexpr int kLines = sizeof(WideNode<Real>) / 64;

  static WideChild next(const WideChild* children, unsigned which) { return children[which]; }
  void fetch(WideChild child) const {
    const char* const at = child.is_leaf() ? leaves + bytes * child.first()
                                           : reinterpret_cast<const char*>(nodes + child.node());
    for (int line = 0; line < kLines; ++line) __builtin_prefetch(at + 64 * line);
  }
};

/// Children that wait for their turn. How many, the walk keeps to itself, where the compiler can see it.
template <class Isa>
class WideStack {
 public:
  /// Take the last child that `last_key` does not rule out; false where none is left.
  bool pop(unsigned& waiting, int last_key, WideChild& child) const {
    do {
      if (waiting == 0) return false;
      --waiting;
    } while (keys_[waiting] > last_key);
    child = children_[waiting];
    return true;
  }

  /// Keep all children that were met but the nearest, which is returned.
  template <class Real, class Manner>
  WideChild push_farther(unsigned& waiting, const WideNode<Real>& node, const MetChildren<Isa>& met,
                         const Manner& manner) {
    const auto first = static_cast<unsigned>(std::countr_zero(met.bits));
    const unsigned others = met.bits & (met.bits - 1);
    if (others == 0) return manner.next(node.child, first);
    if ((others & (others - 1)) != 0) return push_sorted(waiting, node, met, manner);
    const auto second = static_cast<unsigned>(std::countr_zero(others));
    alignas(32) int keys[kWideWidth];
    _mm256_store_si256(reinterpret_cast<__m256i*>(keys), met.keys);
    const bool swapped = keys[second] < keys[first];
    const unsigned near = swapped ? second : first, far = swapped ? first : second;
    keys_[waiting] = keys[far];
    children_[waiting++] = node.child[far];
    manner.fetch(node.child[far]);
    return manner.next(node.child, near);
  }

 private:
  template <class Real>
  static __m256i children_of(const WideNode<Real>& node) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(node.child));
  }

  template <class Real, class Manner>
  WideChild push_sorted(unsigned& waiting, const WideNode<Real>& node, const MetChildren<Isa>& met,
                        const Manner& manner) {
    const __m256i places = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const __m256i bits = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(met.bits)), places);
    // What was not met sorts behind everything.
    const __m256i missed = _mm256_cmpeq_epi32(bits, _mm256_setzero_si256());
    const __m256i sorted = descending(_mm256_or_si256(met.keys, missed));
    const __m256i children = _mm256_permutevar8x32_epi32(children_of(node), sorted);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(keys_ + waiting), sorted);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(children_ + waiting), children);
    waiting += static_cast<unsigned>(std::popcount(met.bits)) - 1;
    manner.fetch(children_[waiting - 1]), manner.fetch(children_[waiting - 2]);
    return manner.next(node.child, met.nearest());
  }

  /// Sort eight numbers by a network of 19 comparisons in six layers.
  static __m256i descending(__m256i a) {
    a = layer<0b11001100>(a, _mm256_shuffle_epi32(a, 0x4E));
    a = layer<0b11110000>(a, _mm256_permute2x128_si256(a, a, 1));
    a = layer<0b10101010>(a, _mm256_shuffle_epi32(a, 0xB1));
    a = layer<0b00110000>(a, _mm256_permute4x64_epi64(a, 0xD8));
    a = layer<0b01010000>(a, _mm256_permutevar8x32_epi32(a, _mm256_setr_epi32(0, 4, 2, 6, 1, 5, 3, 7)));
    return layer<0b01010100>(a, _mm256_permutevar8x32_epi32(a, _mm256_setr_epi32(0, 2, 1, 4, 3, 6, 5, 7)));
  }
  /// Of each number and its partner the smaller one in the places that are set, the larger in others.
  template <int kSmaller>
  static __m256i layer(__m256i a, __m256i partners) {
    return _mm256_blend_epi32(_mm256_max_epi32(a, partners), _mm256_min_epi32(a, partners), kSmaller);
  }

  // Every level leaves all children of a node but one; stores write eight places at once.
  static constexpr int kPlaces = kMaxSahDepth * (kWideWidth - 1) + kWideWidth;

  int keys_[kPlaces];
  WideChild children_[kPlaces];
};

/// The leaves below `start` in a wide hierarchy that a ray meets, near to far: of a node's children the nearest is entered, the others
/// wait in order of distance until it is done.
///   visit(leaf)  is called with each leaf, a WideChild; true ends the walk
///   reach()      is the distance at which the walk may end; leaves that begin there are still visited
template <class Isa, class Real, class Counter, class Reach, class Manner, class Visit>
void walk_wide(const WideTree<Real>& tree, WideChild start, const WideCrossings<Isa, Real>& crossings,
               Counter count, const Reach& reach, const Manner& manner, const Visit& visit) {
  WideStack<Isa> stack;
  unsigned waiting = 0;
  WideChild current = start;
  const WideNode<Real>* const nodes = tree.nodes.data();
  while (true) {
    if (current.is_leaf()) {
      if (visit(current)) return;
    } else {
      const WideNode<Real>& node = nodes[current.node()];
      count.step(), count.volume_tests(node.children);
      const MetChildren<Isa> met = crossings.met(node, reach());
      if (met.bits != 0) {
        current = stack.push_farther(waiting, node, met, manner);
        continue;
      }
    }
    if (!stack.pop(waiting, MetChildren<Isa>::last_key(static_cast<float>(reach())), current)) return;
  }
}

/// The leaves below `start` in a wide hierarchy that a ray meets up to `reach`, in no order of distance: for those who look for any hit.
template <class Isa, class Real, class Counter, class Manner, class Visit>
void walk_wide_unordered(const WideTree<Real>& tree, WideChild start,
                         const WideCrossings<Isa, Real>& crossings, Counter count, Real reach,
                         const Manner& manner, const Visit& visit) {
  struct Waiting {
    const WideNode<Real>* node;
    unsigned bits;
  };
  // Every level leaves children of one node behind.
  Waiting levels[kMaxSahDepth + 1];
  Waiting* top = levels;
  const auto first = [](unsigned bits) { return static_cast<unsigned>(std::countr_zero(bits)) % kWideWidth; };
  WideChild current = start;
  const WideNode<Real>* const nodes = tree.nodes.data();
  while (true) {
    if (current.is_leaf()) {
      if (visit(current)) return;
    } else {
      const WideNode<Real>& node = nodes[current.node()];
      count.step(), count.volume_tests(node.children);
      const unsigned bits = crossings.met(node, reach).bits;
      if (bits != 0) {
        current = manner.next(node.child, first(bits));
        // Written in any case, kept where something waits: cheaper than to branch on it.
        *top = {&node, bits & (bits - 1)};
        top += top->bits != 0;
        continue;
      }
    }
    if (top == levels) return;
    --top;
    current = top->node->child[first(top->bits)];
    top->bits &= top->bits - 1;
    top += top->bits != 0;
  }
}

}  // namespace rayshoot
