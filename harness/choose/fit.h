#pragma once

#include <span>

#include "harness/choose/constants.h"
#include "harness/report/report.h"

namespace rayshoot {

/// Fit constants to reports of `rayshoot run --technique auto --candidate all --regret`, whose candidates were counted and
/// timed: non-negative least squares of relative errors, over all techniques together, since they share what an object test
/// costs. Throws InputError where there is nothing to fit to.
Constants fit_constants(std::span<const report::Report> reports);

}  // namespace rayshoot
