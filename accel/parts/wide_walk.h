#pragma once

#include <immintrin.h>

#include <bit>

#include "accel/parts/branch.h"
#include "accel/parts/pair_tree.h"
#include "accel/parts/wide_tree.h"

// Read where code for a kind of processor begins: all that is not included is a template over its instructions.

namespace rayshoot {

/// The children of a node that a ray meets: one bit for each, and for each a key: the distance, not below 0, where the ray
/// enters it, as an integer that compares likewise, with the number of the child in its lowest bits. Keys are never above
/// the distance.
template <class Isa>
struct MetChildren {
  static constexpr int kChildBits = kWideWidth - 1;

  unsigned bits;
  __m256i keys;

  static MetChildren of(unsigned bits, __m256 distances) {
    const __m256i numbers = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    const __m256i cleared =
        _mm256_andnot_si256(_mm256_set1_epi32(kChildBits), _mm256_castps_si256(distances));
    return {bits, _mm256_or_si256(cleared, numbers)};
  }
  /// The child with the least key of those whose bits are set.
  unsigned nearest() const {
    const __m256i kept = Isa::kept(keys, bits);
    const __m128i four = _mm_min_epi32(_mm256_castsi256_si128(kept), _mm256_extracti128_si256(kept, 1));
    const __m128i two = _mm_min_epi32(four, _mm_shuffle_epi32(four, 0x4E));
    return static_cast<unsigned>(_mm_cvtsi128_si32(_mm_min_epi32(two, _mm_shuffle_epi32(two, 0xB1)))) &
           kChildBits;
  }
  /// No key of a child that is entered at `distance` or before is above this one.
  static int last_key(float distance) { return std::bit_cast<int>(distance) | kChildBits; }
};

/// A ray that has `begun`, with its `Crossings`.
template <class Isa>
struct WideRay {
  /// Whether the ray can hit anything: its origin and direction are finite, and its interval holds a number.
  bool can_hit;

  explicit WideRay(const Ray<float>& given) {
    static_assert(offsetof(Ray<float>, time) == sizeof(__m256));
    // The ray is read and written as a whole: parts of it would have to wait for one another.
    const __m256 all = _mm256_loadu_ps(&given.origin.x);
    const __m256 from_zero = _mm256_blend_ps(all, _mm256_max_ps(all, _mm256_setzero_ps()), 0b1000);
    _mm256_storeu_ps(&begun_.origin.x, from_zero);

    const __m128 limit = _mm_set1_ps(std::numeric_limits<float>::max() / 2);
    // In the last lane stands t_max, whose inverse may be a denormal number, over which processors stumble.
    const __m128 direction = _mm_blend_ps(_mm256_extractf128_ps(all, 1), _mm_set1_ps(1), 0b1000);
    const __m128 unlimited = _mm_set1_ps(1) / direction;
    const __m128 inverse = _mm_min_ps(_mm_max_ps(unlimited, -limit), limit);
    earliest_ = inverse * (1 - kCrossingError<float>);
    latest_ = inverse * (1 + kCrossingError<float>);

    const __m256 zero = all - all;
    const auto finite = static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(zero, zero, _CMP_ORD_Q)));
    can_hit = (finite & 0x77) == 0x77 && begun_.t_min < begun_.t_max;
  }

  const Ray<float>& begun() const { return begun_; }
  float origin(int axis) const { return begun_.origin[axis]; }
  float direction(int axis) const { return begun_.direction[axis]; }
  float earliest(int axis) const { return earliest_[axis]; }
  float latest(int axis) const { return latest_[axis]; }
  float t_min() const { return begun_.t_min; }

 private:
  Ray<float> begun_;
  __m128 earliest_, latest_;
};

/// A ray prepared for testing the boxes of wide nodes, all of them as if grown by `margin`: where that is 0,
/// `Crossings::inside` for all at once, to the last bit.
template <class Isa, class Real>
class WideCrossings;

template <class Isa>
class WideCrossings<Isa, float> {
 public:
  template <class OneRay>
  explicit WideCrossings(const OneRay& ray, float margin = 0) {
    for (int axis = 0; axis < 3; ++axis) {
      near_[axis] = std::signbit(ray.earliest(axis));
      // To come from farther back and to look farther ahead is to meet larger boxes.
      const float grown = near_[axis] ? -margin : margin;
      near_origin_[axis] = _mm256_set1_ps(ray.origin(axis) + grown);
      far_origin_[axis] = _mm256_set1_ps(ray.origin(axis) - grown);
      earliest_[axis] = _mm256_set1_ps(ray.earliest(axis));
      latest_[axis] = _mm256_set1_ps(ray.latest(axis));
    }
    start_ = _mm256_set1_ps(ray.t_min());
  }

  MetChildren<Isa> met(const WideNode<float>& node, float reach) const {
    const __m256 enter = _mm256_max_ps(_mm256_max_ps(enters(node, 0), enters(node, 1)),
                                       _mm256_max_ps(enters(node, 2), start_));
    const __m256 exit = _mm256_min_ps(_mm256_min_ps(exits(node, 0), exits(node, 1)),
                                      _mm256_min_ps(exits(node, 2), _mm256_set1_ps(reach)));
    return MetChildren<Isa>::of(Isa::not_above(enter, exit), enter);
  }

 private:
  __m256 enters(const WideNode<float>& node, int axis) const {
    return (_mm256_load_ps(node.planes[axis][near_[axis]]) - near_origin_[axis]) * earliest_[axis];
  }
  __m256 exits(const WideNode<float>& node, int axis) const {
    return (_mm256_load_ps(node.planes[axis][near_[axis] ^ 1]) - far_origin_[axis]) * latest_[axis];
  }

  __m256 near_origin_[3], far_origin_[3], earliest_[3], latest_[3], start_;
  std::size_t near_[3];
};

template <class Isa>
class WideCrossings<Isa, double> {
 public:
  explicit WideCrossings(const Ray<double>& ray, double margin = 0)
      : crossings_(ray), start_(ray.t_min), margin_(margin) {}

  MetChildren<Isa> met(const WideNode<double>& node, double reach) const {
    const Half low = half(node, 0, reach), high = half(node, 1, reach);
    return MetChildren<Isa>::of(low.bits | high.bits << 4, _mm256_set_m128(high.distances, low.distances));
  }

 private:
  struct Half {
    unsigned bits;
    /// Rounded to floats, which keeps their order.
    __m128 distances;
  };
  Half half(const WideNode<double>& node, int which, double reach) const {
    __m256d enter = _mm256_set1_pd(start_), exit = _mm256_set1_pd(reach);
    for (int axis = 0; axis < 3; ++axis) {
      const int near = crossings_.inverse[axis] < 0;
      const double origin = crossings_.origin[axis], grown = near ? -margin_ : margin_;
      const __m256d enters = _mm256_load_pd(node.planes[axis][near] + 4 * which) - (origin + grown);
      const __m256d exits = _mm256_load_pd(node.planes[axis][near ^ 1] + 4 * which) - (origin - grown);
      enter = _mm256_max_pd(enters * _mm256_set1_pd(crossings_.earliest[axis]), enter);
      exit = _mm256_min_pd(exits * _mm256_set1_pd(crossings_.latest[axis]), exit);
    }
    const auto bits = static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(enter, exit, _CMP_LE_OQ)));
    return {bits, _mm256_cvtpd_ps(enter)};
  }

  Crossings<double> crossings_;
  double start_, margin_;
};

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
