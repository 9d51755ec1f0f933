#include "accel/parts/wide_kernels.h"

// All that follows may use AVX-512; what stands above may not, since other files share it.
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx512f,avx512vl,avx512dq,avx512bw"))), \
                             apply_to = function)
#else
#pragma GCC target("avx512f,avx512vl,avx512dq,avx512bw")
// GCC 12's own intrinsics begin with vectors that they leave open on purpose.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif

#include "accel/parts/wide_avx512.h"
#include "accel/parts/wide_search.h"

namespace rayshoot {

const WideKernels kWideKernelsAvx512{"avx512", WideSearch<WideAvx512>::closest_of_all,
                                     WideSearch<WideAvx512>::any_of_all};

}  // namespace rayshoot

#ifdef __clang__
#pragma clang attribute pop
#endif
