#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scenes/geometry/vec.h"

namespace rayshoot {

/// Cut a simple polygon, convex or not, into `vertices.size() - 2` triangles of its corners by clipping ears
/// (Meisters 1975) in the plane in which it looks largest. Of a polygon that crosses itself it makes as many
/// triangles, of no promised shape.
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3d> vertices);

}  // namespace rayshoot
