#pragma once

#include <string>

#include "harness/plan/plan.h"

namespace rayshoot {

/// One of several parts of a run. A scene is never divided, so that its techniques are timed together.
struct Shard {
  std::size_t index = 1, count = 1;
};

/// Reads "2/3". Throws InputError on anything else, and on 0/3 or 4/3.
Shard parse_shard(const std::string& text);

/// Leaves to a plan the scenes of a shard: as equal numbers as may be, in order, so that the reports of all shards,
/// joined in order, list what one run would. Throws InputError when there are fewer scenes than shards.
void keep_shard(Plan& plan, const Shard& shard);

}  // namespace rayshoot
