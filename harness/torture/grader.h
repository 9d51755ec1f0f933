#pragma once

#include "harness/torture/cell.h"
#include "harness/torture/tally.h"

namespace rayshoot {

/// Rays that are traced, judged and then counted at once.
inline constexpr std::uint64_t kTorturedAtOnce = 4096;

/// Build the structures of a cell, then trace and judge its rays from number `tally.rays` on until number `end`,
/// `at_once` at a time. After each such batch the tally is as if no other ray existed.
void grade(const TortureCell& cell, Tally& tally, std::uint64_t end, std::uint64_t at_once);

}  // namespace rayshoot
