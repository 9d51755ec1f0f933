#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scenes/geometry/vec.h"

namespace rayshoot {

/// Triangles over shared vertices, each running counter-clockwise when seen from outside.
struct TriangleMesh {
  std::vector<Vec3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

}  // namespace rayshoot
