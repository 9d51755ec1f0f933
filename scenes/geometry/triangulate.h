#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scenes/geometry/vec.h"

namespace rayshoot {

/// Polygons of more vertices are not triangulated: the time grows with their square.
inline constexpr std::size_t kLargestTriangulated = 4096;

/// Cut a planar polygon of n vertices, convex or not, into n - 2 triangles by clipping ears (Meisters 1975). Each
/// triangle is three indices of vertices and runs around the same way as the polygon, whose area vector is
/// `normal`; where corners lie in one line or repeat it may have no area. Empty where the polygon is not
/// simple, so that no triangles cover what it covers, or has too many vertices.
template <class Real>
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3<Real>> vertices,
                                                      const Vec3d& normal);

extern template std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3<float>>,
                                                                      const Vec3d&);
extern template std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3<double>>,
                                                                      const Vec3d&);

}  // namespace rayshoot
