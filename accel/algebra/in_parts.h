#pragma once

#include <functional>

#include "accel/core/engine.h"

namespace rayshoot {

/// Builds the optimizer over one scene of a scene of placed parts: over the `whole`, or over one of its parts.
template <class Real>
using BuildLevel =
    std::function<std::unique_ptr<Optimizer<Real>>(const OptimizerInput<Real>& input, bool whole)>;

/// An engine that searches a scene of placed parts with an optimizer for each part, however often it is placed: a part is an
/// object of the optimizer around it (Arvo & Kirk §12, meta-hierarchies). `composed` says whether the optimizers count
/// the events of compositions by level.
template <class Real>
std::unique_ptr<Engine<Real>> engine_in_parts(const EngineInput<Real>& input, const BuildLevel<Real>& build,
                                              bool composed);

}  // namespace rayshoot
