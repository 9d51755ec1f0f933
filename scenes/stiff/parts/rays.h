#pragma once

#include <functional>
#include <span>

#include "scenes/geometry/ray.h"
#include "scenes/stiff/parts/numbers.h"

namespace rayshoot::stiff {

/// Makes ray `number` from random numbers addressed by it.
using RayMaker = std::function<Ray<double>(const RandomNumbers& random, std::uint64_t number)>;

/// What `StiffSetting::rays` asks for: number by number.
inline auto ray_by_ray(RayMaker make) {
  return [make = std::move(make)](std::uint64_t seed, std::uint64_t first, std::span<Ray<double>> rays) {
    const RandomNumbers random(seed);
    for (std::size_t i = 0; i < rays.size(); ++i) rays[i] = make(random, first + i);
  };
}

/// The ray of floats from `origin` to `target`, which it reaches at t = 1: exactly where the differences of their
/// coordinates are floats, and otherwise up to rounding.
inline Ray<double> ray_to(const Vec3d& origin, const Vec3d& target) {
  const Vec3d start = rounded(origin), path = rounded(rounded(target) - start);
  return {.origin = start, .direction = path == Vec3d{} ? Vec3d{0, 0, 1} : path};
}

}  // namespace rayshoot::stiff
