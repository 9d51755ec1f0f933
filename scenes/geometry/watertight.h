#pragma once

#include <span>

#include "scenes/geometry/polygon.h"
#include "scenes/geometry/triangle.h"

namespace rayshoot {

// Watertight ray-object tests after Woop, Benthin and Wald (2013): every vertex is moved along the ray into a plane,
// in which the ray is the origin, by a function of ray and vertex alone. On which side of an edge the origin lies is
// then decided exactly. Objects that share vertices share their images, so no ray passes between them.

/// The axes in the order in which a ray is looked along: `along` is that of the largest component of its direction.
struct ViewAxes {
  int across, up, along;

  template <class Real>
  explicit ViewAxes(const Vec3<Real>& direction) {
    const Real x = std::abs(direction.x), y = std::abs(direction.y), z = std::abs(direction.z);
    along = x >= y ? (x >= z ? 0 : 2) : (y >= z ? 1 : 2);
    across = along == 2 ? 0 : along + 1;
    up = across == 2 ? 0 : across + 1;
  }
};

/// The sign of ax by - bx ay, a zero resolved exactly: what its magnitude is beside the error of the products.
inline double side_of_edge(double ax, double ay, double bx, double by) {
  const double first = ax * by, second = bx * ay;
  if (first != second) return first - second;
  return std::fma(ax, by, -first) - std::fma(bx, ay, -second);
}

/// Coordinate `axis` of the three corners of a triangle.
template <class Real>
Lanes<Real> corner_coordinates(const Triangle<Real>& triangle, int axis) {
  const auto first = static_cast<std::size_t>(axis);
  return __builtin_shufflevector(read_lanes<Real>(triangle, first), read_lanes<Real>(triangle, first + 3), 0,
                                 3, 7, 7);
}

/// Whether the origin lies on the left of one edge and on the right of another.
inline bool sides_differ(double u, double v, double w) {
  return ((u < 0) | (v < 0) | (w < 0)) & ((u > 0) | (v > 0) | (w > 0));
}

/// Two-sided ray-triangle test. A ray through an edge or a vertex hits; one in the plane of the triangle misses.
template <class Real>
Real watertight_hit_distance(const Triangle<Real>& triangle, const Ray<Real>& ray) {
  // Move the corners along the ray into the plane through its origin.
  const ViewAxes axes(ray.direction);
  const auto from_origin = [&](int axis) {
    return widened(corner_coordinates(triangle, axis)) - double{ray.origin[axis]};
  };
  const double across = ray.direction[axes.across], up = ray.direction[axes.up],
               along = ray.direction[axes.along];
  const WideLanes z = from_origin(axes.along);
  const WideLanes x = from_origin(axes.across) * along - z * across;
  const WideLanes y = from_origin(axes.up) * along - z * up;

  // Reject the ray unless it passes on the same side of all three edges: lane k is that opposite of corner k - 1.
  const auto next = [](WideLanes v) { return __builtin_shufflevector(v, v, 1, 2, 0, 3); };
  const WideLanes sides = x * next(y) - next(x) * y;
  double w = sides[0], u = sides[1], v = sides[2];
  if (sides_differ(u, v, w)) return kMiss<Real>;
  if ((u == 0) | (v == 0) | (w == 0)) [[unlikely]] {
    w = side_of_edge(x[0], y[0], x[1], y[1]);
    u = side_of_edge(x[1], y[1], x[2], y[2]);
    v = side_of_edge(x[2], y[2], x[0], y[0]);
    if (sides_differ(u, v, w)) return kMiss<Real>;
  }
  const double area = u + v + w;
  if (!(area != 0)) return kMiss<Real>;

  // Measure the distance as the corners' distances weighted by the opposite areas.
  const double t = (u * z[0] + v * z[1] + w * z[2]) / (area * along);
  return confine(t, Corners<Real>(triangle).bounds(), ray);
}

/// Two-sided ray-polygon test: whether the image of the polygon covers the ray is the parity of the edges crossed,
/// each edge closed at its lower and open at its upper end. A ray in the plane misses.
template <class Real>
Real watertight_hit_distance(const Polygon<Real>& polygon, std::span<const Vec3<Real>> vertices,
                             const Ray<Real>& ray) {
  const Vec3d origin(ray.origin), direction(ray.direction);
  const double approach = dot(polygon.normal, direction);
  if (approach == 0) return kMiss<Real>;

  // Move the vertices along the ray into the plane through its origin, and count the edges on one side.
  const ViewAxes axes(ray.direction);
  struct Shifted {
    double x, y;
  };
  const auto image = [&](const Vec3<Real>& vertex) -> Shifted {
    const Vec3d way = Vec3d(vertex) - origin;
    return {way[axes.across] * direction[axes.along] - way[axes.along] * direction[axes.across],
            way[axes.up] * direction[axes.along] - way[axes.along] * direction[axes.up]};
  };
  bool inside = false;
  Shifted a = image(vertices.back());
  for (const Vec3<Real>& vertex : vertices) {
    const Shifted b = image(vertex);
    if ((a.y > 0) != (b.y > 0)) {
      const double side = side_of_edge(a.x, a.y, b.x, b.y);
      inside ^= b.y > a.y ? side > 0 : side < 0;
    }
    a = b;
  }
  if (!inside) return kMiss<Real>;
  return confine(dot(polygon.normal, Vec3d(vertices.front()) - origin) / approach, polygon.box, ray);
}

}  // namespace rayshoot
