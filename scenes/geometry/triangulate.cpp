#include "scenes/geometry/triangulate.h"

namespace rayshoot {

namespace {

struct Point {
  double u, v;
  friend bool operator==(const Point&, const Point&) = default;
};

/// Twice the signed area of a triangle: positive where it runs counter-clockwise.
double turn(const Point& a, const Point& b, const Point& c) {
  return (b.u - a.u) * (c.v - a.v) - (c.u - a.u) * (b.v - a.v);
}

/// A polygon that loses one ear after the other: a ring of the vertices that are left, counter-clockwise.
class Ring {
 public:
  explicit Ring(std::vector<Point> points)
      : points_(std::move(points)), before_(points_.size()), after_(points_.size()) {
    const auto size = static_cast<std::uint32_t>(points_.size());
    for (std::uint32_t i = 0; i < size; ++i) before_[i] = (i + size - 1) % size, after_[i] = (i + 1) % size;
    left_ = size;
  }

  std::uint32_t left() const { return left_; }
  std::uint32_t before(std::uint32_t i) const { return before_[i]; }
  std::uint32_t after(std::uint32_t i) const { return after_[i]; }
  double turn_at(std::uint32_t i) const { return turn(points_[before_[i]], points_[i], points_[after_[i]]); }

  /// Whether the triangle at a convex vertex lies in the polygon: no other vertex lies in it or on its
  /// border, except at its corners, where polygons with bridges to their holes pass twice.
  bool is_ear(std::uint32_t i) const {
    const Point &a = points_[before_[i]], &b = points_[i], &c = points_[after_[i]];
    for (std::uint32_t k = after_[after_[i]]; k != before_[i]; k = after_[k]) {
      const Point& p = points_[k];
      const bool inside = turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
      if (inside && p != a && p != b && p != c) return false;
    }
    return true;
  }

  void remove(std::uint32_t i) {
    after_[before_[i]] = after_[i], before_[after_[i]] = before_[i];
    --left_;
  }

 private:
  std::vector<Point> points_;
  std::vector<std::uint32_t> before_, after_;
  std::uint32_t left_;
};

/// Look at the polygon along the axis nearest to its normal, so that it runs counter-clockwise.
template <class Real>
std::vector<Point> projected(std::span<const Vec3<Real>> vertices, const Vec3d& normal) {
  const Vec3d size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
  const int along = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  int u = (along + 1) % 3, v = (along + 2) % 3;
  if (normal[along] < 0) std::swap(u, v);
  std::vector<Point> points;
  points.reserve(vertices.size());
  for (const Vec3<Real>& vertex : vertices)
    points.push_back({static_cast<double>(vertex[u]), static_cast<double>(vertex[v])});
  return points;
}

}  // namespace

template <class Real>
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3<Real>> vertices,
                                                      const Vec3d& normal) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  if (vertices.size() < 3 || vertices.size() > kLargestTriangulated) return triangles;
  Ring ring(projected(vertices, normal));

  // Walk around and clip what can be clipped, until a whole round finds nothing.
  std::uint32_t at = 0, fruitless = 0;
  while (ring.left() > 2 && fruitless < ring.left()) {
    const std::uint32_t next = ring.after(at);
    const double turn = ring.turn_at(at);
    if (turn == 0 || (turn > 0 && ring.is_ear(at))) {
      triangles.push_back({ring.before(at), at, next});
      ring.remove(at);
      fruitless = 0;
    } else {
      ++fruitless;
    }
    at = next;
  }
  if (ring.left() > 2) triangles.clear();
  return triangles;
}

template std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3<float>>, const Vec3d&);
template std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3<double>>, const Vec3d&);

}  // namespace rayshoot
