#pragma once

#include <immintrin.h>

#include <cstdint>

// Read where code for AVX-512 begins.

namespace rayshoot {

/// As WideAvx2, twice as wide.
struct WideAvx512 {
  static constexpr std::uint32_t kObjects = 8;
  using Floats = __m256;
  using Doubles = __m512d;

  /// Rays that go together, one in each lane.
  static constexpr std::uint32_t kRays = 16;
  using Lanes = __m512;

  static Lanes lanes(const float* from) { return _mm512_load_ps(from); }
  static void store(Lanes a, float* to) { _mm512_store_ps(to, a); }
  static Lanes all(float value) { return _mm512_set1_ps(value); }
  static Lanes larger(Lanes a, Lanes b) { return _mm512_max_ps(a, b); }
  static Lanes smaller(Lanes a, Lanes b) { return _mm512_min_ps(a, b); }
  /// a b + c, and c - a b, rounded once.
  static Lanes sum(Lanes a, Lanes b, Lanes c) { return _mm512_fmadd_ps(a, b, c); }
  static Lanes rest(Lanes a, Lanes b, Lanes c) { return _mm512_fnmadd_ps(a, b, c); }
  static Lanes magnitudes(Lanes a) { return _mm512_abs_ps(a); }
  static Lanes signs(Lanes a) { return _mm512_and_ps(a, _mm512_set1_ps(-0.0f)); }
  static Lanes turned(Lanes a, Lanes signs) { return _mm512_xor_ps(a, signs); }
  static unsigned not_above(Lanes a, Lanes b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
  static unsigned below(Lanes a, Lanes b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
  static float least(Lanes a) { return _mm512_reduce_min_ps(a); }
  static float largest(Lanes a) { return _mm512_reduce_max_ps(a); }
  static unsigned negative(Lanes a) { return _mm512_movepi32_mask(_mm512_castps_si512(a)); }

  static Floats load(const float* from) { return _mm256_loadu_ps(from); }
  static Doubles load(const double* from) { return _mm512_loadu_pd(from); }
  static Floats spread(float value) { return _mm256_set1_ps(value); }
  static Doubles spread(double value) { return _mm512_set1_pd(value); }
  static Doubles widened(Floats a) { return _mm512_cvtps_pd(a); }
  static Floats rounded(Doubles a) { return _mm512_cvtpd_ps(a); }
  static Floats larger(Floats a, Floats b) { return _mm256_max_ps(a, b); }
  static Floats smaller(Floats a, Floats b) { return _mm256_min_ps(a, b); }
  static Floats chosen(Floats a, Floats b, Floats sign) { return _mm256_blendv_ps(a, b, sign); }
  static Doubles signs(Doubles a) { return _mm512_and_pd(a, _mm512_set1_pd(-0.0)); }
  static Doubles turned(Doubles a, Doubles signs) { return _mm512_xor_pd(a, signs); }
  static Doubles magnitudes(Doubles a) { return _mm512_andnot_pd(_mm512_set1_pd(-0.0), a); }

  /// The numbers whose bits are set; in place of others the largest.
  static __m256i kept(__m256i numbers, unsigned bits) {
    return _mm256_mask_mov_epi32(_mm256_set1_epi32(0x7FFFFFFF), static_cast<__mmask8>(bits), numbers);
  }
  static unsigned not_above(__m256i a, __m256i b) { return _mm256_cmple_epi32_mask(a, b); }

  static unsigned not_above(Floats a, Floats b) { return _mm256_cmp_ps_mask(a, b, _CMP_LE_OQ); }
  static unsigned below(Floats a, Floats b) { return _mm256_cmp_ps_mask(a, b, _CMP_LT_OQ); }
  static unsigned below(Doubles a, Doubles b) { return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ); }
  static Doubles either(Doubles a, Doubles b, unsigned bits) {
    return _mm512_mask_mov_pd(a, static_cast<__mmask8>(bits), b);
  }
  static unsigned no_numbers(Floats a) { return _mm256_cmp_ps_mask(a, a, _CMP_UNORD_Q); }
  static unsigned covered(Doubles u, Doubles v, Doubles approach) {
    const Doubles zero = _mm512_setzero_pd();
    __mmask8 within = _mm512_cmp_pd_mask(approach, zero, _CMP_NEQ_OQ);
    within = _mm512_mask_cmp_pd_mask(within, u, zero, _CMP_GE_OQ);
    within = _mm512_mask_cmp_pd_mask(within, v, zero, _CMP_GE_OQ);
    return _mm512_mask_cmp_pd_mask(within, _mm512_add_pd(u, v), approach, _CMP_LE_OQ);
  }
};

}  // namespace rayshoot
