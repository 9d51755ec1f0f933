#pragma once

#include <span>

#include "scenes/core/scene.h"

namespace rayshoot {

/// Give rays random times from 0 to 1 where something moves in the scene; times stay 0 elsewhere.
void set_times(std::span<Ray<double>> rays, const Scene& scene, std::uint64_t seed);

}  // namespace rayshoot
