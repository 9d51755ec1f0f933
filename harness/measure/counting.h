#pragma once

#include <optional>

#include "harness/report/report.h"
#include "harness/verify/answers.h"

namespace rayshoot {

/// What counting a technique's work on a batch yields.
struct Counts {
  Work work, strict_work;
  report::Efficiency efficiency;
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

/// Equation (3) per ray of the batch; absent where the technique does not predict.
template <class Real>
std::optional<report::Predicted> predict(const Engine<Real>& engine, const Batch<Real>& batch);

}  // namespace rayshoot
