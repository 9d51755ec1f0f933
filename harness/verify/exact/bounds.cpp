#include "harness/verify/exact/bounds.h"

namespace rayshoot::exact {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The box grown by `margin` and by the rounding of that.
Box<double> grown(Box<double> box, const Vec3d& margin) {
  for (int axis = 0; axis < 3; ++axis) {
    if (margin[axis] == 0) continue;
    box.lo[axis] = std::nextafter(box.lo[axis] - margin[axis], -kInfinity);
    box.hi[axis] = std::nextafter(box.hi[axis] + margin[axis], kInfinity);
  }
  return box;
}

/// The box of a ball about a point; of an end circle of a cone it contains more than needed.
template <class Real>
Box<double> ball(const Vec3<Real>& centre, Real radius) {
  const double r = radius;
  return grown({Vec3d(centre), Vec3d(centre)}, {r, r, r});
}

/// How far a polygon's vertices lie off its plane along an axis, at most; infinite where that is not known.
double off_plane(const std::vector<Vec3<Bounded<double>>>& vertices, const Vec3<Bounded<double>>& normal,
                 int axis) {
  double farthest = 0;
  for (const auto& vertex : vertices) {
    const Bounded<double> off = dot(normal, vertex - vertices.front()) / normal[axis];
    if (!std::isfinite(off.error)) return kInfinity;
    farthest = std::max({farthest, off.highest(), -off.lowest()});
  }
  return farthest;
}

/// A contact with a polygon lies in its plane above the projection of the polygon. There the plane is between
/// its points above the vertices, hence no farther from the box of the vertices than these are off the plane.
template <class Real>
Box<double> polygon_bounds(const ExactContacts<Real>& contacts, std::uint32_t object) {
  const auto corners = contacts.geometry().polygon_vertices(object);
  Box<double> box;
  for (const Vec3<Real>& vertex : corners) box.include(Vec3d(vertex));
  const int axis = contacts.geometry().polygon(object).dropped_axis;
  Vec3d margin;
  margin[axis] = off_plane(numbers<Bounded<double>>(corners), contacts.bounded_normal(object), axis);
  // Where the plane is not known, neither is where it ends: the range of coordinates is all there is.
  margin[axis] = std::min(margin[axis], std::numeric_limits<double>::max() / 4);
  return grown(box, margin);
}

}  // namespace

template <class Real>
Box<double> exact_bounds(const ExactContacts<Real>& contacts, std::uint32_t object) {
  const Geometry<Real>& geometry = contacts.geometry();
  Box<double> box;
  switch (geometry.kind(object)) {
    case ObjectKind::triangle: {
      const Triangle<Real>& triangle = geometry.triangle(object);
      for (const Vec3<Real>& corner : {triangle.a, triangle.b, triangle.c}) box.include(Vec3d(corner));
      return box;
    }
    case ObjectKind::polygon:
      return polygon_bounds(contacts, object);
    case ObjectKind::sphere:
      return ball(geometry.sphere(object).centre, geometry.sphere(object).radius);
    case ObjectKind::cone:
      box.include(ball(geometry.cone(object).base, geometry.cone(object).base_radius));
      box.include(ball(geometry.cone(object).apex, geometry.cone(object).apex_radius));
      return box;
    case ObjectKind::placed:
      break;
  }
  return box;
}

template Box<double> exact_bounds(const ExactContacts<float>&, std::uint32_t);
template Box<double> exact_bounds(const ExactContacts<double>&, std::uint32_t);

}  // namespace rayshoot::exact
