#include "scenes/core/stiffness.h"

#include "scenes/core/geometry.h"

namespace rayshoot {

namespace {

double size_of(const Vec3d& extent) { return std::hypot(extent.x, extent.y, extent.z); }

/// The altitude over the longest edge, from edges of about unit length, whose products keep within range.
double feature(const Triangle<double>& triangle) {
  const Vec3d ab = triangle.b - triangle.a, ac = triangle.c - triangle.a, bc = triangle.c - triangle.b;
  const double longest = std::max({size_of(ab), size_of(ac), size_of(bc)});
  return size_of(cross(ab * (1 / longest), ac * (1 / longest))) * longest;
}

double feature(std::span<const Vec3d> vertices) {
  double shortest = kMiss<double>;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const double edge = size_of(vertices[(i + 1) % vertices.size()] - vertices[i]);
    if (edge > 0) shortest = std::min(shortest, edge);
  }
  return shortest;
}

double feature(const Cone<double>& cone) {
  double smallest = size_of(cone.apex - cone.base);
  for (const double radius : {cone.base_radius, cone.apex_radius})
    if (radius > 0) smallest = std::min(smallest, 2 * radius);
  return smallest;
}

double feature(const Geometry<double>& geometry, std::uint32_t object) {
  switch (geometry.kind(object)) {
    case ObjectKind::triangle:
      return feature(geometry.triangle(object));
    case ObjectKind::polygon:
      return feature(geometry.polygon_vertices(object));
    case ObjectKind::sphere:
      return 2 * geometry.sphere(object).radius;
    case ObjectKind::cone:
      return feature(geometry.cone(object));
  }
  return kMiss<double>;
}

}  // namespace

std::optional<double> smallest_feature(const Scene& scene) {
  const Geometry<double> geometry(scene);
  std::optional<double> smallest;
  for (std::uint32_t object = 0; object < geometry.size(); ++object) {
    const double size = feature(geometry, object);
    if (size > 0) smallest = std::min(smallest.value_or(size), size);
  }
  return smallest;
}

std::optional<double> stiffness(const Scene& scene) {
  const std::optional<double> smallest = smallest_feature(scene);
  if (!smallest) return std::nullopt;
  return size_of(scene.bounds().extent()) / *smallest;
}

}  // namespace rayshoot
