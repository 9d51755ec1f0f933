#pragma once

#include "accel/parts/wide_bounds.h"
#include "accel/parts/wide_others.h"
#include "accel/parts/wide_triangle_test.h"
#include "accel/parts/wide_vectors.h"

// Read where code for a kind of processor begins: all that is not included is a template over its instructions.

namespace rayshoot {

/// `hit_distance` of a ray and polygons with four corners in lanes, to the last bit.
template <class Isa, class OneRay>
class WideQuadTest {
 public:
  using Floats = typename Isa::Floats;
  using Doubles = typename Isa::Doubles;

  WideQuadTest(const OneRay& ray, const WideQuads& quads) : ray_{ray}, quads_(quads) {}

  /// The hits at `reach` at the farthest with the polygons from number `first` on: one bit for each.
  WideDistances<Isa> hits(std::uint32_t first, float reach) const {
    // Measure the distances along the ray to the planes, and meanwhile those to the bounds.
    Floats lo[3], hi[3];
    Doubles normal[3], to_corner[3], direction[3];
    for (int axis = 0; axis < 3; ++axis) {
      direction[axis] = ray_.direction(axis);
      normal[axis] = Isa::load(quads_.normals + static_cast<std::uint32_t>(axis) * quads_.count + first);
      to_corner[axis] = Isa::widened(row(WideQuads::kCorner, axis, first)) - ray_.exact_origin(axis);
      lo[axis] = row(WideQuads::kLow, axis, first);
      hi[axis] = row(WideQuads::kHigh, axis, first);
    }
    const Doubles approach = wide_dot(normal, direction), zero = Isa::spread(0.0);
    const Doubles t = wide_dot(normal, to_corner) / approach;
    WideDistances<Isa> found{wide_objects_in_use<Isa>(quads_.count, first) & Isa::below(zero, t) &
                                 Isa::below(zero, Isa::magnitudes(approach)),
                             {}};
    WideBounds<Isa>(lo, hi, ray_).confine(Isa::rounded(t), ray_, Isa::spread(reach), found);
    if (found.bits == 0) return found;

    // Keep those that cover the point there.
    Doubles point[3];
    for (int axis = 0; axis < 3; ++axis) point[axis] = ray_.exact_origin(axis) + direction[axis] * t;
    found.bits &= covering(first, point);
    return found;
  }

 private:
  Floats row(std::uint32_t begin, int which, std::uint32_t first) const {
    return Isa::load(quads_.rows + (begin + static_cast<std::uint32_t>(which)) * quads_.count + first);
  }

  /// `covers`: one bit for each polygon of which a line from the point to the side crosses an odd number of edges.
  unsigned covering(std::uint32_t first, const Doubles* point) const {
    // Project along the axis of the largest normal component.
    const unsigned x = quads_.along_x >> first, y = quads_.along_y >> first;
    const Doubles u = Isa::either(Isa::either(point[0], point[2], y), point[1], x);
    const Doubles v = Isa::either(Isa::either(point[1], point[0], y), point[2], x);

    const auto corner = [&](int which) { return Isa::widened(row(WideQuads::kProjected, which, first)); };
    const Doubles zero = Isa::spread(0.0);
    Doubles from_u = corner(6), from_v = corner(7);
    unsigned inside = 0, from_above = Isa::below(v, from_v);
    for (int which = 0; which < 4; ++which) {
      const Doubles to_u = corner(2 * which), to_v = corner(2 * which + 1);
      const unsigned to_above = Isa::below(v, to_v);
      const Doubles side = (to_u - from_u) * (v - from_v) - (u - from_u) * (to_v - from_v);
      inside ^= (from_above ^ to_above) &
                ((to_above & Isa::below(zero, side)) | (~to_above & Isa::below(side, zero)));
      from_u = to_u, from_v = to_v, from_above = to_above;
    }
    return inside;
  }

  WideSpreadRay<Isa, OneRay> ray_;
  const WideQuads& quads_;
};

}  // namespace rayshoot
