#include "scenes/io/triangulate.h"

#include "scenes/geometry/polygon.h"
#include "scenes/geometry/triangulate.h"

namespace rayshoot {

std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3d> vertices) {
  auto triangles = triangulate<double>(vertices, make_polygon<double>(vertices, 0).normal);
  for (std::uint32_t i = 2; triangles.size() + 2 < vertices.size(); ++i) triangles.push_back({0, i - 1, i});
  return triangles;
}

}  // namespace rayshoot
