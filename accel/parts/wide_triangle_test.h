#pragma once

#include "accel/parts/wide_triangles.h"
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

  struct Distances {
    /// One bit for each lane in which there is a hit.
    unsigned bits;
    Floats t;
  };

  /// The hits at `reach` at the farthest in the lanes `in_use`.
  template <class Rays>
  static Distances hits(const Corners& corner, const Rays& rays, Floats reach, unsigned in_use) {
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
    cross(ab, ac, normal), cross(to_a, direction, q);
    const Doubles approach = dot(normal, direction), sign = Isa::signs(approach);
    const Doubles u = Isa::turned(dot(ac, q), sign), v = Isa::turned(-dot(ab, q), sign);
    Distances found{Isa::covered(u, v, Isa::magnitudes(approach)) & in_use, {}};
    if (found.bits == 0) return found;

    // Measure the distances along the ray to the planes of the triangles.
    confine(Isa::rounded(dot(normal, to_a) / approach), corner, rays, reach, found);
    return found;
  }

 private:
  static Doubles dot(const Doubles* a, const Doubles* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static void cross(const Doubles* a, const Doubles* b, Doubles* product) {
    product[0] = a[1] * b[2] - a[2] * b[1];
    product[1] = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
  }

  /// Hold distances to the intervals in which the rays are inside the triangles' bounds, and to their own.
  template <class Rays>
  static void confine(Floats t, const Corners& corner, const Rays& rays, Floats reach, Distances& found) {
    Floats lo[3], hi[3], magnitude = Isa::spread(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = Isa::smaller(corner[0][axis], Isa::smaller(corner[1][axis], corner[2][axis]));
      hi[axis] = Isa::larger(corner[0][axis], Isa::larger(corner[1][axis], corner[2][axis]));
      magnitude = Isa::larger(
          magnitude, Isa::larger(Isa::larger(lo[axis], -lo[axis]), Isa::larger(hi[axis], -hi[axis])));
    }
    const Floats margin = Isa::spread(padding(1.0f)) * magnitude;
    Floats enter[3], exit[3];
    for (int axis = 0; axis < 3; ++axis) {
      const Floats origin = rays.origin(axis), earliest = rays.earliest(axis);
      const Floats low = (lo[axis] - margin) - origin, high = (hi[axis] + margin) - origin;
      enter[axis] = Isa::chosen(low, high, earliest) * earliest;
      exit[axis] = Isa::chosen(high, low, earliest) * rays.latest(axis);
    }
    const Floats enters = Isa::larger(Isa::larger(enter[0], enter[1]), enter[2]);
    const Floats exits = Isa::smaller(Isa::smaller(exit[0], exit[1]), exit[2]);
    found.t = Isa::smaller(Isa::larger(t, enters), exits);
    found.bits &=
        Isa::not_above(enters, exits) & Isa::below(rays.t_min(), found.t) & Isa::not_above(found.t, reach);
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

/// The hits of a ray at `reach` at the farthest with the objects from number `first` on among the `count` of a leaf: one
/// bit for each.
template <class Isa, class OneRay>
auto hits_in_leaf(const OneRay& ray, const float* leaf, std::uint32_t count, std::uint32_t first,
                  float reach) {
  typename Isa::Floats corner[3][3];
  for (std::uint32_t which = 0; which < 3; ++which)
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      corner[which][axis] = Isa::load(leaf + (3 * which + axis) * count + first);
  const std::uint32_t left = count - first;
  const unsigned in_use = left < Isa::kObjects ? (1u << left) - 1 : (1u << Isa::kObjects) - 1;
  return WideTriangleTest<Isa>::hits(corner, WideSpreadRay<Isa, OneRay>{ray}, Isa::spread(reach), in_use);
}

}  // namespace rayshoot
