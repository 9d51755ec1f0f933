#include "accel/parts/plane_sets.h"

#include "accel/parts/clipped_bounds.h"

namespace rayshoot {

namespace {

/// The points whose product with `normal` is at most `limit`.
struct HalfSpace {
  Vec3d normal;
  double limit;
};

/// The area of a convex polygon.
double area(const std::vector<Vec3d>& polygon) {
  Vec3d twice{};
  for (std::size_t i = 2; i < polygon.size(); ++i)
    twice += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return length(twice) / 2;
}

/// A square in the boundary of a half-space, of that half side, about the point nearest to the origin.
std::vector<Vec3d> square(const HalfSpace& face, double half) {
  const Vec3d middle = face.normal * (face.limit / dot(face.normal, face.normal));
  const Vec3d beside = face.normal.z == 0 ? Vec3d{0, 0, 1} : Vec3d{face.normal.z, 0, -face.normal.x};
  const Vec3d u = normalized(beside) * half, v = normalized(cross(face.normal, u)) * half;
  return {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
}

}  // namespace

template <class Real>
double surface_area(const Box<Real>& box, const SlopeExtents& extents, int slopes) {
  // Measure from the middle of the box: far from the origin nothing would be left of a small volume.
  const Vec3d middle = Box<double>{Vec3d(box.lo), Vec3d(box.hi)}.centre(), half = Vec3d(box.hi) - middle;
  std::vector<HalfSpace> faces;
  const auto add_slab = [&](const Vec3d& normal, double lo, double hi) {
    faces.push_back({normal, hi}), faces.push_back({-normal, -lo});
  };
  for (int axis = 0; axis < 3; ++axis) add_slab(kPlaneSetNormals[axis], -half[axis], half[axis]);
  for (int k = 0; k < slopes; ++k) {
    const double at = dot(slope_normal(k), middle);
    add_slab(slope_normal(k), extents.lo[k] - at, extents.hi[k] - at);
  }

  // Cut each face out of its plane by all the other half-spaces, which must not cut away what is flat by rounding.
  const double slack = 1e-12 * max_abs(half);
  double sum = 0;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    std::vector<Vec3d> face = square(faces[i], 8 * max_abs(half));
    for (std::size_t j = 0; j < faces.size() && !face.empty(); ++j)
      if (j != i)
        face =
            clipped(face, [&](const Vec3d& p) { return dot(faces[j].normal, p) - faces[j].limit - slack; });
    sum += area(face);
  }
  return sum;
}

template double surface_area(const Box<float>&, const SlopeExtents&, int);
template double surface_area(const Box<double>&, const SlopeExtents&, int);

}  // namespace rayshoot
