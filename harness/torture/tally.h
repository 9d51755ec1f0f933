#pragma once

#include <array>
#include <cstdint>

#include "accel/core/counters.h"
#include "harness/verify/grades.h"

namespace rayshoot {

/// What is known of the answers so far. It lies in memory that survives the process that fills it, so it has neither
/// pointers nor constructors worth the name.
struct Tally {
  /// Rays answered and counted: the next to be traced.
  std::uint64_t rays = 0;
  /// Grows as long as the process gets on, also within a batch.
  std::uint64_t pulse = 0;
  /// Whether the structures stand.
  bool built = false;
  std::uint64_t objects = 0, set_aside = 0;

  Grades grades;
  std::uint64_t leaks = 0, forbidden_hits = 0, changed = 0, any_differs = 0, threads_differ = 0;
  /// Rays all of whose crossings were looked for, and crossings that were not found.
  std::uint64_t crossed_rays = 0, crossings_lost = 0;
  Work work;
  std::uint64_t most_steps = 0;
  /// Why nothing was traced; a text that ends with zero.
  std::array<char, 256> message{};
};

}  // namespace rayshoot
