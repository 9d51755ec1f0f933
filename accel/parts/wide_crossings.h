#pragma once

#include <immintrin.h>

#include <bit>

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
    origin_ = _mm256_castps256_ps128(from_zero);

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
  /// Along x, y and z; the last lane is of no account.
  __m128 origin_lanes() const { return origin_; }
  __m128 earliest_lanes() const { return earliest_; }

 private:
  Ray<float> begun_;
  __m128 origin_, earliest_, latest_;
};

/// A ray prepared for testing the boxes of wide nodes, all of them as if grown by `margin`: where that is 0,
/// `Crossings::inside` for all at once, to the last bit.
template <class Isa, class Real>
class WideCrossings;

template <class Isa>
class WideCrossings<Isa, float> {
 public:
  template <class OneRay>
  explicit WideCrossings(const OneRay& ray) : WideCrossings(ray, ray.origin_lanes(), ray.origin_lanes()) {}
  template <class OneRay>
  WideCrossings(const OneRay& ray, float margin)
      : WideCrossings(ray, grown(ray, margin), grown(ray, -margin)) {}

  MetChildren<Isa> met(const WideNode<float>& node, float reach) const {
    const __m256 enter = _mm256_max_ps(_mm256_max_ps(enters(node, 0), enters(node, 1)),
                                       _mm256_max_ps(enters(node, 2), start_));
    const __m256 exit = _mm256_min_ps(_mm256_min_ps(exits(node, 0), exits(node, 1)),
                                      _mm256_min_ps(exits(node, 2), _mm256_set1_ps(reach)));
    return MetChildren<Isa>::of(Isa::not_above(enter, exit), enter);
  }

 private:
  template <class OneRay>
  WideCrossings(const OneRay& ray, __m128 near_origin, __m128 far_origin) {
    const __m128 earliest = ray.earliest_lanes();
    const auto signs = static_cast<unsigned>(_mm_movemask_ps(earliest));
    for (int axis = 0; axis < 3; ++axis) {
      near_[axis] = signs >> axis & 1;
      near_origin_[axis] = _mm256_set1_ps(near_origin[axis]);
      far_origin_[axis] = _mm256_set1_ps(far_origin[axis]);
      earliest_[axis] = _mm256_set1_ps(earliest[axis]);
      latest_[axis] = _mm256_set1_ps(ray.latest(axis));
    }
    start_ = _mm256_set1_ps(ray.t_min());
  }
  /// To come from farther back and to look farther ahead is to meet larger boxes.
  template <class OneRay>
  static __m128 grown(const OneRay& ray, float margin) {
    const __m128 signs = _mm_and_ps(ray.earliest_lanes(), _mm_set1_ps(-0.0f));
    return ray.origin_lanes() + _mm_xor_ps(_mm_set1_ps(margin), signs);
  }

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

}  // namespace rayshoot
