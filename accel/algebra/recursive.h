#pragma once

#include "accel/algebra/sequential.h"

namespace rayshoot {

struct RecursiveConfig {
  SequentialConfig division{.until = 8, .box = SequentialConfig::Box::voxel};
  int max_depth = 6;
};

std::vector<Parameter> recursive_parameters();
RecursiveConfig recursive_config(const Arguments& arguments);

/// A = B|A, the recursive optimizer of B = `part` (Revelles & Ureña §5.3).
template <class Real>
std::unique_ptr<Optimizer<Real>> recursive(const OptimizerInput<Real>& input, const BuildPart<Real>& part,
                                           const RecursiveConfig& config);

}  // namespace rayshoot
