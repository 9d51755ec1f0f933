#pragma once

#include <immintrin.h>

namespace rayshoot {

/// Makes this thread take denormal numbers as zero, in operands and results, for as long as it lives, where it is told
/// to; elsewhere it changes nothing.
class FlushToZero {
 public:
  explicit FlushToZero(bool on) : saved_(_mm_getcsr()) {
    if (on) _mm_setcsr(saved_ | _MM_FLUSH_ZERO_ON | _MM_DENORMALS_ZERO_ON);
  }
  ~FlushToZero() { _mm_setcsr(saved_); }
  FlushToZero(const FlushToZero&) = delete;
  FlushToZero& operator=(const FlushToZero&) = delete;

 private:
  unsigned saved_;
};

}  // namespace rayshoot
