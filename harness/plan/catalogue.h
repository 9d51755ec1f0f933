#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "accel/core/engine.h"

namespace rayshoot {

/// Every technique that can be run: those of the papers sorted by id, then the baselines.
const std::vector<const TechniqueEntry*>& catalogue();

/// A technique with values for all of its parameters.
struct TechniqueChoice {
  const TechniqueEntry* entry = nullptr;
  Arguments arguments;
  /// What was asked for, for example "uniform_grid(density=2)".
  std::string spec;
  /// Ids of the scenes on which it is to run; empty for all.
  std::vector<std::string> scenes{};
  /// Owns the entry where it is a composition.
  std::shared_ptr<const TechniqueEntry> composed{};
};

/// The technique that `spec`, a name, name(key=value,...) or an expression of the algebra (accel/algebra/expression.h),
/// asks for; throws InputError on an unknown name or key and on a value out of range.
TechniqueChoice choose_technique(std::string_view spec);

}  // namespace rayshoot
