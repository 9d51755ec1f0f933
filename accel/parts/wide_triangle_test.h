#pragma once

#include "accel/parts/wide_bounds.h"
#include "accel/parts/wide_triangles.h"
#include "accel/parts/wide_vectors.h"
#include "accel/parts/wide_walk.h"

// Read where code for a kind of processor begins: all that is not included is a template over its instructions.

namespace rayshoot {

/// `hit_distance` of triangles and rays in lanes, to the last bit. A lane has a corner of its own or shares it with the
/// others, and so it is with rays: `lanes` has what the ray, or the rays, are made of.
template <class Isa>
class WideTriangleTest {
 public:
  using Floats = typename Isa::Floats;
  using Doubles = typename Isa::Doubles;
  using Corners = Floats[3][3];

  /// The hits at `reach` at the farthest in the lanes `in_use`.
  template <class Rays>
  static WideDistances<Isa> hits(const Corners& corner, const Rays& rays, Floats reach, unsigned in_use) {
    // Reject triangles unless the ray passes on the same side of all three edges.
    Doubles ab[3], ac[3], to_a[3], direction[3];
    for (int axis = 0; axis < 3; ++axis) {
      direction[axis] = rays.direction(axis);
      const Doubles a = Isa::widened(corner[0][axis]);
      ab[axis] = Isa::widened(corner[1][axis]) - a;
      ac[axis] = Isa::widened(corner[2][axis]) - a;
      to_a[axis] = a - rays.exact_origin(axis);
    }
    Doubles normal[3], q[3];
    wide_cross(ab, ac, normal), wide_cross(to_a, direction, q);
    const Doubles approach = wide_dot(normal, direction), sign = Isa::signs(approach);
    const Doubles u = Isa::turned(wide_dot(ac, q), sign), v = Isa::turned(-wide_dot(ab, q), sign);
    WideDistances<Isa> found{Isa::covered(u, v, Isa::magnitudes(approach)) & in_use, {}};
    if (found.bits == 0) return found;

    // Measure the distances along the ray to the planes of the triangles.
    WideBounds<Isa>::of(corner, rays)
        .confine(Isa::rounded(wide_dot(normal, to_a) / approach), rays, reach, found);
    return found;
  }
};

/// One ray in all lanes.
template <class Isa, class OneRay>
struct WideSpreadRay {
  const OneRay& ray;

  auto direction(int axis) const { return Isa::spread(double{ray.direction(axis)}); }
  auto exact_origin(int axis) const { return Isa::spread(double{ray.origin(axis)}); }
  auto origin(int axis) const { return Isa::spread(ray.origin(axis)); }
  auto earliest(int axis) const { return Isa::spread(ray.earliest(axis)); }
  auto latest(int axis) const { return Isa::spread(ray.latest(axis)); }
  auto t_min() const { return Isa::spread(ray.t_min()); }
};

/// One bit for each object from number `first` on among the `count` of a leaf.
template <class Isa>
unsigned wide_objects_in_use(std::uint32_t count, std::uint32_t first) {
  const std::uint32_t left = count - first;
  return left < Isa::kObjects ? (1u << left) - 1 : (1u << Isa::kObjects) - 1;
}

/// The hits of a ray at `reach` at the farthest with the triangles from number `first` on among the `count` of a leaf: one
/// bit for each.
template <class Isa, class OneRay>
auto hits_in_leaf(const OneRay& ray, const float* leaf, std::uint32_t count, std::uint32_t first,
                  float reach) {
  typename WideTriangleTest<Isa>::Corners corner;
  for (std::uint32_t which = 0; which < 3; ++which)
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      corner[which][axis] = Isa::load(leaf + (3 * which + axis) * count + first);
  return WideTriangleTest<Isa>::hits(corner, WideSpreadRay<Isa, OneRay>{ray}, Isa::spread(reach),
                                     wide_objects_in_use<Isa>(count, first));
}

}  // namespace rayshoot
