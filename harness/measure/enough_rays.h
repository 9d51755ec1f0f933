#pragma once

#include <functional>

#include "harness/plan/plan.h"

namespace rayshoot {

/// The rays of `spec` in the number that the suite's `target_m_error` needs: the fewest tried at which half the 95 % interval
/// of every technique's M is at most that part of M. Their number is the parameter `rays`, or the resolution of distributions
/// that have none; it ends at the largest that the distribution takes. `tracer` sees the scene as the rays need it.
RaySpec enough_rays(const Plan& plan, const RaySpec& spec, const Scene& scene, const Tracer& tracer,
                    int threads, const std::function<bool()>& stopped);

}  // namespace rayshoot
