#pragma once

#include <immintrin.h>

#include <cstdint>

namespace rayshoot {

/// What is special to an instruction set in bvh_wide: here the baseline, which every processor has that runs the program.
struct WideAvx2 {
  /// Objects tested at once: their coordinates in floats, and in doubles.
  static constexpr std::uint32_t kObjects = 4;
  using Floats = __m128;
  using Doubles = __m256d;

  /// Rays that go together, one in each lane.
  static constexpr std::uint32_t kRays = 8;
  using Lanes = __m256;

  static Lanes lanes(const float* from) { return _mm256_load_ps(from); }
  static void store(Lanes a, float* to) { _mm256_store_ps(to, a); }
  static Lanes all(float value) { return _mm256_set1_ps(value); }
  static Lanes larger(Lanes a, Lanes b) { return _mm256_max_ps(a, b); }
  static Lanes smaller(Lanes a, Lanes b) { return _mm256_min_ps(a, b); }
  /// a b + c, and c - a b, rounded once.
  static Lanes sum(Lanes a, Lanes b, Lanes c) { return _mm256_fmadd_ps(a, b, c); }
  static Lanes rest(Lanes a, Lanes b, Lanes c) { return _mm256_fnmadd_ps(a, b, c); }
  static Lanes magnitudes(Lanes a) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a); }
  static Lanes signs(Lanes a) { return _mm256_and_ps(a, _mm256_set1_ps(-0.0f)); }
  static Lanes turned(Lanes a, Lanes signs) { return _mm256_xor_ps(a, signs); }
  static unsigned below(Lanes a, Lanes b) {
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LT_OQ)));
  }
  static float least(Lanes a) {
    const __m128 four = _mm_min_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
    const __m128 two = _mm_min_ps(four, _mm_movehl_ps(four, four));
    return _mm_cvtss_f32(_mm_min_ss(two, _mm_movehdup_ps(two)));
  }
  static float largest(Lanes a) { return -least(-a); }
  static unsigned negative(Lanes a) { return static_cast<unsigned>(_mm256_movemask_ps(a)); }

  static Floats load(const float* from) { return _mm_loadu_ps(from); }
  static Doubles load(const double* from) { return _mm256_loadu_pd(from); }
  static Floats spread(float value) { return _mm_set1_ps(value); }
  static Doubles spread(double value) { return _mm256_set1_pd(value); }
  static Doubles widened(Floats a) { return _mm256_cvtps_pd(a); }
  static Floats rounded(Doubles a) { return _mm256_cvtpd_ps(a); }
  static Floats larger(Floats a, Floats b) { return _mm_max_ps(a, b); }
  static Floats smaller(Floats a, Floats b) { return _mm_min_ps(a, b); }
  /// `a`, where `sign` is negative `b`.
  static Floats chosen(Floats a, Floats b, Floats sign) { return _mm_blendv_ps(a, b, sign); }
  /// The sign bits of all lanes, and lanes with some of them turned.
  static Doubles signs(Doubles a) { return _mm256_and_pd(a, _mm256_set1_pd(-0.0)); }
  static Doubles turned(Doubles a, Doubles signs) { return _mm256_xor_pd(a, signs); }
  static Doubles magnitudes(Doubles a) { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), a); }

  /// The numbers whose bits are set; in place of others the largest.
  static __m256i kept(__m256i numbers, unsigned bits) {
    const __m256i places = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const __m256i set = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(bits)), places);
    return _mm256_blendv_epi8(_mm256_set1_epi32(0x7FFFFFFF), numbers, _mm256_cmpeq_epi32(set, places));
  }
  static unsigned not_above(__m256i a, __m256i b) {
    return 0xFF & ~static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(_mm256_cmpgt_epi32(a, b))));
  }

  // One bit for each lane.
  static unsigned not_above(Floats a, Floats b) { return bits(_mm_cmp_ps(a, b, _CMP_LE_OQ)); }
  static unsigned below(Floats a, Floats b) { return bits(_mm_cmp_ps(a, b, _CMP_LT_OQ)); }
  static unsigned below(Doubles a, Doubles b) { return bits(_mm256_cmp_pd(a, b, _CMP_LT_OQ)); }
  /// `a`, and in the lanes whose bits are set `b`.
  static Doubles either(Doubles a, Doubles b, unsigned bits) {
    const __m256i places = _mm256_setr_epi64x(1, 2, 4, 8);
    const __m256i set = _mm256_and_si256(_mm256_set1_epi64x(bits), places);
    return _mm256_blendv_pd(a, b, _mm256_castsi256_pd(_mm256_cmpeq_epi64(set, places)));
  }
  static unsigned no_numbers(Floats a) { return bits(_mm_cmp_ps(a, a, _CMP_UNORD_Q)); }
  static unsigned covered(Doubles u, Doubles v, Doubles approach) {
    const Doubles zero = _mm256_setzero_pd();
    const Doubles within =
        _mm256_and_pd(_mm256_cmp_pd(u, zero, _CMP_GE_OQ), _mm256_cmp_pd(v, zero, _CMP_GE_OQ));
    const Doubles both = _mm256_and_pd(_mm256_cmp_pd(_mm256_add_pd(u, v), approach, _CMP_LE_OQ),
                                       _mm256_cmp_pd(approach, zero, _CMP_NEQ_OQ));
    return bits(_mm256_and_pd(within, both));
  }
  static unsigned not_above(__m256 a, __m256 b) {
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LE_OQ)));
  }

 private:
  static unsigned bits(__m128 a) { return static_cast<unsigned>(_mm_movemask_ps(a)); }
  static unsigned bits(__m256d a) { return static_cast<unsigned>(_mm256_movemask_pd(a)); }
};

}  // namespace rayshoot
