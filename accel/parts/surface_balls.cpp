#include "accel/parts/surface_balls.h"

#include <numbers>

#include "accel/parts/planar.h"

namespace rayshoot {

namespace {

constexpr double kPi = std::numbers::pi;
/// Corners of the polygon about an end circle of a cone.
constexpr int kCircleCorners = 16;

void append_corners(const Box<double>& box, std::vector<SurfaceBall>& balls) {
  for (int corner = 0; corner < 8; ++corner)
    balls.push_back({{corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y,
                      corner & 4 ? box.hi.z : box.lo.z}});
}

/// The corners of a regular polygon about a circle across a unit axis.
void append_circle(const Vec3d& centre, double radius, const Vec3d& axis, std::vector<SurfaceBall>& balls) {
  if (radius == 0) return balls.push_back({centre});
  const Vec3d u = normalized(cross(std::abs(axis.z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{1, 0, 0}, axis));
  const Vec3d v = cross(axis, u);
  const double to_corner = radius / std::cos(kPi / kCircleCorners);
  for (int k = 0; k < kCircleCorners; ++k) {
    const double angle = 2 * kPi * k / kCircleCorners;
    balls.push_back({centre + (u * std::cos(angle) + v * std::sin(angle)) * to_corner});
  }
}

}  // namespace

void append_frustum(const Vec3d& base, double base_radius, const Vec3d& apex, double apex_radius,
                    std::vector<SurfaceBall>& balls) {
  const Vec3d axis = normalized(apex - base);
  append_circle(base, base_radius, axis, balls);
  append_circle(apex, apex_radius, axis, balls);
}

template <class Real>
void append_surface(const Geometry<Real>& geometry, std::uint32_t object, std::vector<SurfaceBall>& balls) {
  switch (geometry.kind(object)) {
    case ObjectKind::triangle: {
      const Triangle<Real>& triangle = geometry.triangle(object);
      for (const Vec3<Real>& vertex : {triangle.a, triangle.b, triangle.c}) balls.push_back({Vec3d(vertex)});
      return;
    }
    case ObjectKind::sphere: {
      const Sphere<Real>& sphere = geometry.sphere(object);
      return balls.push_back({Vec3d(sphere.centre), sphere.radius});
    }
    case ObjectKind::cone: {
      const Cone<Real>& cone = geometry.cone(object);
      return append_frustum(Vec3d(cone.base), cone.base_radius, Vec3d(cone.apex), cone.apex_radius, balls);
    }
    case ObjectKind::placed: {
      const Box<Real> box = geometry.bounds(object);
      return append_corners({Vec3d(box.lo), Vec3d(box.hi)}, balls);
    }
    case ObjectKind::polygon:
      break;
  }
  const Polygon<Real>& polygon = geometry.polygon(object);
  const std::span<const Vec3<Real>> vertices = geometry.polygon_vertices(object);
  if (!is_planar(polygon, vertices))
    return append_corners({Vec3d(polygon.box.lo), Vec3d(polygon.box.hi)}, balls);
  for (const Vec3<Real>& vertex : vertices) balls.push_back({Vec3d(vertex)});
}

template void append_surface(const Geometry<float>&, std::uint32_t, std::vector<SurfaceBall>&);
template void append_surface(const Geometry<double>&, std::uint32_t, std::vector<SurfaceBall>&);

}  // namespace rayshoot
