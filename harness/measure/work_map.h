#pragma once

#include "harness/report/report.h"
#include "harness/verify/answers.h"

namespace rayshoot {

/// Rows and columns of tiles that a map has at most.
inline constexpr std::uint64_t kMapColumns = 64;

/// The work of the eye rays that a set begins with, `resolution` rows of as many, in tiles as large as `kMapColumns` asks for.
template <class Real>
report::WorkMap work_map(const Engine<Real>& engine, const Batch<Real>& batch, std::uint64_t resolution,
                         EngineScratch& scratch);

extern template report::WorkMap work_map<float>(const Engine<float>&, const Batch<float>&, std::uint64_t,
                                                EngineScratch&);
extern template report::WorkMap work_map<double>(const Engine<double>&, const Batch<double>&, std::uint64_t,
                                                 EngineScratch&);

}  // namespace rayshoot
