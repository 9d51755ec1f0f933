#pragma once

#include <cstdint>
#include <optional>

namespace rayshoot::analysis {

/// Events per 10^9 trials; absent without trials.
std::optional<double> per_billion(std::uint64_t events, std::uint64_t trials);

/// The largest rate per 10^9 that so many events of so many trials allow, at 95 %: the upper end of Wilson's interval;
/// without an event 3/n, as the rule of three has it. Absent without trials.
std::optional<double> upper_bound_per_billion(std::uint64_t events, std::uint64_t trials);

}  // namespace rayshoot::analysis
