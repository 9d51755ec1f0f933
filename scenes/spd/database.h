#pragma once

#include <initializer_list>
#include <numbers>

#include "scenes/core/affine.h"
#include "scenes/core/registry.h"

namespace rayshoot {

/// What the generators of the Standard Procedural Databases have in common.
namespace spd {

inline constexpr double kPi = std::numbers::pi;
inline constexpr Vec3d kSky{0.078, 0.361, 0.753};
/// The Phong exponent of a surface without highlight.
inline constexpr double kNoHighlight = 100000;

/// Sources of the six databases of the paper, and of those that joined the package later.
inline constexpr const char* kPaper =
    "Haines, A Proposal for Standard Graphics Environments, IEEE CG&A 7(11), 1987";
inline constexpr const char* kPackage = "Haines, Standard Procedural Databases (SPD) 3";

constexpr double radians(double degrees) { return degrees * kPi / 180; }

/// Everything that comes before the first material.
inline void open(SceneBuilder& builder, const View& view, std::initializer_list<Vec3d> lights,
                 const Vec3d& background = kSky) {
  builder.background(background);
  builder.view(view);
  for (const Vec3d& light : lights) builder.light(light);
}

}  // namespace spd

}  // namespace rayshoot
