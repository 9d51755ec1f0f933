#pragma once

#include "accel/parts/wide_tree.h"

// Read where code for a kind of processor begins: all that is not included is a template over its instructions.

namespace rayshoot {

/// Where rays hit objects in lanes.
template <class Isa>
struct WideDistances {
  /// One bit for each lane in which there is a hit.
  unsigned bits;
  typename Isa::Floats t;
};

/// The intervals in which rays are inside the bounds of objects, in lanes: `confine`, to the last bit.
template <class Isa>
class WideBounds {
 public:
  using Floats = typename Isa::Floats;

  /// Of triangles.
  template <class Rays>
  static WideBounds of(const Floats (&corner)[3][3], const Rays& rays) {
    Floats lo[3], hi[3], magnitude = Isa::spread(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = Isa::smaller(corner[0][axis], Isa::smaller(corner[1][axis], corner[2][axis]));
      hi[axis] = Isa::larger(corner[0][axis], Isa::larger(corner[1][axis], corner[2][axis]));
      magnitude = Isa::larger(
          magnitude, Isa::larger(Isa::larger(lo[axis], -lo[axis]), Isa::larger(hi[axis], -hi[axis])));
    }
    const Floats margin = Isa::spread(padding(1.0f)) * magnitude;
    for (int axis = 0; axis < 3; ++axis) lo[axis] = lo[axis] - margin, hi[axis] = hi[axis] + margin;
    return WideBounds(lo, hi, rays);
  }

  template <class Rays>
  WideBounds(const Floats* lo, const Floats* hi, const Rays& rays) {
    Floats enter[3], exit[3];
    for (int axis = 0; axis < 3; ++axis) {
      const Floats origin = rays.origin(axis), earliest = rays.earliest(axis);
      const Floats low = lo[axis] - origin, high = hi[axis] - origin;
      enter[axis] = Isa::chosen(low, high, earliest) * earliest;
      exit[axis] = Isa::chosen(high, low, earliest) * rays.latest(axis);
    }
    enters_ = Isa::larger(Isa::larger(enter[0], enter[1]), enter[2]);
    exits_ = Isa::smaller(Isa::smaller(exit[0], exit[1]), exit[2]);
  }

  /// Hold distances to the intervals, and to the rays' own.
  template <class Rays>
  void confine(Floats t, const Rays& rays, Floats reach, WideDistances<Isa>& found) const {
    found.t = Isa::smaller(Isa::larger(t, enters_), exits_);
    found.bits &=
        Isa::not_above(enters_, exits_) & Isa::below(rays.t_min(), found.t) & Isa::not_above(found.t, reach);
  }

 private:
  Floats enters_, exits_;
};

}  // namespace rayshoot
