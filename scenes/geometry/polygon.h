#pragma once

#include <span>

#include "scenes/geometry/ray.h"

namespace rayshoot {

/// A planar polygon of any number of vertices, convex or not: one object. Its vertices are kept elsewhere.
template <class Real>
struct Polygon {
  std::uint32_t first_vertex = 0;
  std::uint32_t vertex_count = 0;
  /// Newell's area vector, twice the area long, and the plane dot(normal, p) = offset, in double precision.
  Vec3d normal;
  double offset = 0;
  Box<Real> box;
  /// The axis along which the polygon is projected to decide what is inside: that of the largest normal component.
  int dropped_axis = 2;
};

template <class Real>
Polygon<Real> make_polygon(std::span<const Vec3<Real>> vertices, std::uint32_t first_vertex) {
  Polygon<Real> polygon{.first_vertex = first_vertex, .vertex_count = static_cast<std::uint32_t>(vertices.size())};
  const Vec3d anchor(vertices.front());
  Vec3d previous = Vec3d(vertices.back()) - anchor;
  for (const Vec3<Real>& vertex : vertices) {
    const Vec3d current = Vec3d(vertex) - anchor;
    polygon.normal += cross(previous, current);
    polygon.box.include(vertex);
    previous = current;
  }
  polygon.offset = dot(polygon.normal, anchor);
  polygon.box = padded(polygon.box);
  const Vec3d size{std::abs(polygon.normal.x), std::abs(polygon.normal.y), std::abs(polygon.normal.z)};
  polygon.dropped_axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  return polygon;
}

template <class Real>
Box<Real> bounds(const Polygon<Real>& polygon) {
  return polygon.box;
}

/// Whether the projection of `point` lies inside that of the polygon: odd number of edge crossings, each edge
/// closed at its lower and open at its upper end, so that a shared vertex counts once.
template <class Real>
bool covers(std::span<const Vec3<Real>> vertices, int dropped_axis, const Vec3d& point) {
  const int u = (dropped_axis + 1) % 3, v = (dropped_axis + 2) % 3;
  bool inside = false;
  Vec3d a(vertices.back());
  for (const Vec3<Real>& vertex : vertices) {
    const Vec3d b(vertex);
    if ((a[v] > point[v]) != (b[v] > point[v])) {
      const double side = (b[u] - a[u]) * (point[v] - a[v]) - (point[u] - a[u]) * (b[v] - a[v]);
      inside ^= (b[v] > a[v]) ? side > 0 : side < 0;
    }
    a = b;
  }
  return inside;
}

/// Two-sided ray-polygon test in double precision: the point at which the ray meets the plane, if the polygon
/// covers it. A ray in the plane misses.
template <class Real>
Real hit_distance(const Polygon<Real>& polygon, std::span<const Vec3<Real>> vertices, const Ray<Real>& ray) {
  const Vec3d origin(ray.origin), direction(ray.direction);
  const double approach = dot(polygon.normal, direction);
  if (approach == 0) return kMiss<Real>;
  const double t = dot(polygon.normal, Vec3d(vertices.front()) - origin) / approach;
  // What lies outside of the ray's interval is found out at less cost than what lies outside of the polygon.
  const Real confined = t > 0 ? confine(t, polygon.box, ray) : kMiss<Real>;
  if (confined == kMiss<Real> || !covers(vertices, polygon.dropped_axis, origin + direction * t)) return kMiss<Real>;
  return confined;
}

}  // namespace rayshoot
