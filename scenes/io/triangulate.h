#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scenes/geometry/vec.h"

namespace rayshoot {

/// Cut any polygon into `vertices.size() - 2` triangles of its corners: a simple one as `triangulate` of
/// scenes/geometry does, and one that crosses itself or has no area into a fan.
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3d> vertices);

}  // namespace rayshoot
