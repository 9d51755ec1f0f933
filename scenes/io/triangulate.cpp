#include "scenes/io/triangulate.h"

#include <numeric>

#include "scenes/geometry/polygon.h"

namespace rayshoot {

namespace {

struct Point2 {
  double u, v;
};

/// Twice the signed area of a triangle: positive when its corners run counter-clockwise.
double double_area(const Point2& a, const Point2& b, const Point2& c) {
  return (b.u - a.u) * (c.v - a.v) - (c.u - a.u) * (b.v - a.v);
}

/// The corners projected along the axis closest to the polygon's normal, counter-clockwise.
std::vector<Point2> projected(std::span<const Vec3d> vertices) {
  const Polygon<double> polygon = make_polygon<double>(vertices, 0);
  const int axis = polygon.dropped_axis;
  const double sign = polygon.normal[axis] < 0 ? -1 : 1;
  std::vector<Point2> points;
  for (const Vec3d& vertex : vertices)
    points.push_back({sign * vertex[(axis + 1) % 3], vertex[(axis + 2) % 3]});
  return points;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3d> vertices) {
  const std::vector<Point2> points = projected(vertices);
  std::vector<std::uint32_t> left(vertices.size());
  std::iota(left.begin(), left.end(), 0u);
  std::vector<std::array<std::uint32_t, 3>> triangles;

  const auto corners_at = [&](std::size_t k) {
    return std::array{left[(k + left.size() - 1) % left.size()], left[k], left[(k + 1) % left.size()]};
  };
  // An ear is a convex corner whose triangle holds no other corner of what is left.
  const auto is_ear = [&](std::size_t k) {
    const auto [a, b, c] = corners_at(k);
    if (!(double_area(points[a], points[b], points[c]) > 0)) return false;
    for (const std::uint32_t other : left) {
      if (other == a || other == b || other == c) continue;
      const Point2& p = points[other];
      if (double_area(points[a], points[b], p) >= 0 && double_area(points[b], points[c], p) >= 0 &&
          double_area(points[c], points[a], p) >= 0)
        return false;
    }
    return true;
  };

  // Clip the next ear around the polygon; where there is none the polygon is degenerate, and any corner will
  // do.
  std::size_t next = 0;
  while (left.size() > 3) {
    std::size_t tried = 0;
    while (tried < left.size() && !is_ear((next + tried) % left.size())) ++tried;
    const std::size_t ear = (next + tried) % left.size();
    triangles.push_back(corners_at(ear));
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
    next = ear;
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

}  // namespace rayshoot
