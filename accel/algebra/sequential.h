#pragma once

#include "accel/core/optimizer.h"

namespace rayshoot {

/// What A1|A2 leaves open.
struct SequentialConfig {
  /// Where the second part is built: where voxel and objects both are; in the voxel; where the objects are.
  enum class Box { fit, voxel, objects };

  /// A voxel with at most so many objects keeps its plain list.
  std::uint32_t until = 8;
  Box box = Box::fit;
};

std::vector<Parameter> sequential_parameters(const SequentialConfig& defaults = {});
SequentialConfig sequential_config(const Arguments& arguments);

template <class Real>
using BuildPart = std::function<std::unique_ptr<Optimizer<Real>>(const OptimizerInput<Real>&)>;

/// A1|A2, the sequential composition (Revelles & Ureña §5.1): `second` built over the objects of each voxel of `first`.
template <class Real>
std::unique_ptr<Optimizer<Real>> sequential(const OptimizerInput<Real>& input, const BuildPart<Real>& first,
                                            const BuildPart<Real>& second, const SequentialConfig& config);

}  // namespace rayshoot
