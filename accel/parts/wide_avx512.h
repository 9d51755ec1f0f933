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

  static Floats load(const float* from) { return _mm256_loadu_ps(from); }
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
