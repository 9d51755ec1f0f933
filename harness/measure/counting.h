#pragma once

#include <optional>

#include "harness/report/report.h"
#include "harness/verify/answers.h"

namespace rayshoot {

/// What counting a technique's work on a batch yields.
struct Counts {
  Work work, strict_work;
  report::Efficiency efficiency;
  /// Standard deviation of the cells of a ray; absent where there are no cells.
  std::optional<double> cells_deviation;
};

/// Count the work of all rays and, on a random subset of about `strict_tests` ray-object tests where all rays
/// would need more, the work of the strict optimizer. The same for any number of threads.
template <class Real>
Counts count(const Engine<Real>& engine, const Batch<Real>& batch, std::uint32_t objects, double strict_tests,
             std::uint64_t seed, int threads);

/// Half the 95 % interval of M over M; zero where no ray has a candidate.
template <class Real>
double relative_m_error(const Engine<Real>& engine, const Batch<Real>& batch, std::uint32_t objects,
                        int threads);

}  // namespace rayshoot
