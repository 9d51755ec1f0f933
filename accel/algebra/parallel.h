#pragma once

#include "accel/algebra/sequential.h"

namespace rayshoot {

/// A1||A2, the parallel composition (Revelles & Ureña §5.2): the candidates that both have.
template <class Real>
std::unique_ptr<Optimizer<Real>> parallel(const OptimizerInput<Real>& input, const BuildPart<Real>& first,
                                          const BuildPart<Real>& second);

}  // namespace rayshoot
