#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "scenes/geometry/vec.h"
#include "scenes/rays/random.h"

namespace rayshoot::stiff {

/// Each coordinate as the nearest float, so that geometry is the same in both precisions.
inline Vec3d rounded(const Vec3d& p) { return Vec3d(Vec3<float>(p)); }

/// Each coordinate as the nearest multiple of `step`, a power of two.
inline Vec3d snapped(const Vec3d& p, double step) {
  const auto snap = [&](double x) { return std::nearbyint(x / step) * step; };
  return {snap(p.x), snap(p.y), snap(p.z)};
}

/// The float that is `ulps` floats above the float `x`, or below it where `ulps` is negative.
inline double floats_above(double x, int ulps) {
  auto result = static_cast<float>(x);
  for (int i = 0; i < std::abs(ulps); ++i)
    result = std::nextafter(
        result, ulps > 0 ? std::numeric_limits<float>::infinity() : -std::numeric_limits<float>::infinity());
  return result;
}

/// The float of these bits.
inline double float_of(std::uint64_t bits) { return std::bit_cast<float>(static_cast<std::uint32_t>(bits)); }

/// A whole number from `first` to `last`, both included.
inline int pick(const RandomNumbers& random, std::uint64_t number, std::uint64_t dimension, int first,
                int last) {
  return first +
         static_cast<int>(random.bits(number, dimension) % static_cast<std::uint64_t>(last - first + 1));
}

/// A point of the cube [-1, 1)^3, from dimensions `dimension` to `dimension + 2`.
inline Vec3d point_in_cube(const RandomNumbers& random, std::uint64_t number, std::uint64_t dimension) {
  const auto coordinate = [&](std::uint64_t axis) {
    return 2 * random.uniform(number, dimension + axis) - 1;
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

/// A direction of unit length, not yet rounded, from dimensions `dimension` to `dimension + 1`.
inline Vec3d unit_direction(const RandomNumbers& random, std::uint64_t number, std::uint64_t dimension) {
  const double z = 2 * random.uniform(number, dimension) - 1, across = std::sqrt(1 - z * z);
  const double angle = 6.283185307179586 * random.uniform(number, dimension + 1);
  return {across * std::cos(angle), across * std::sin(angle), z};
}

}  // namespace rayshoot::stiff
