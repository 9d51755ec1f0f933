#include "scenes/core/stiffness.h"

#include <map>

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
    case ObjectKind::placed:
      break;
  }
  return kMiss<double>;
}

using FeaturesOfParts = std::map<const Geometry<double>*, double>;

/// A part's smallest feature where it is placed: it shrinks by what the way into the part stretches the most along an axis.
double feature(const Placed<double>& placed, const FeaturesOfParts& parts) {
  const Affine& inward = placed.part_from_scene;
  return parts.at(placed.part.get()) / std::max({size_of(inward.x), size_of(inward.y), size_of(inward.z)});
}

/// The smallest feature of a scene whose parts' are known; infinite where there is none.
double smallest_feature(const Geometry<double>& geometry, const FeaturesOfParts& parts) {
  double smallest = kMiss<double>;
  for (std::uint32_t object = 0; object < geometry.size(); ++object) {
    const double size = geometry.kind(object) == ObjectKind::placed ? feature(geometry.placed(object), parts)
                                                                    : feature(geometry, object);
    if (size > 0) smallest = std::min(smallest, size);
  }
  return smallest;
}

}  // namespace

std::optional<double> smallest_feature(const Scene& scene) {
  const Geometry<double> geometry(scene);
  FeaturesOfParts parts;
  for (const Geometry<double>* part : geometry.distinct_parts())
    parts.emplace(part, smallest_feature(*part, parts));
  const double smallest = smallest_feature(geometry, parts);
  return smallest == kMiss<double> ? std::nullopt : std::optional(smallest);
}

std::optional<double> stiffness(const Scene& scene) {
  const std::optional<double> smallest = smallest_feature(scene);
  if (!smallest) return std::nullopt;
  return size_of(scene.bounds().extent()) / *smallest;
}

}  // namespace rayshoot
