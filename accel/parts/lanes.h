#pragma once

#include <cstdint>

#include "scenes/geometry/ray.h"

namespace rayshoot {

/// Vectors of four numbers handled by one instruction (the vector extension of GCC and Clang), and the masks that
/// permute them.
template <class Real>
struct LaneTypes;
template <>
struct LaneTypes<float> {
  typedef float Vector __attribute__((vector_size(16)));
  typedef std::int32_t Mask __attribute__((vector_size(16)));
};
template <>
struct LaneTypes<double> {
  typedef double Vector __attribute__((vector_size(32)));
  typedef std::int64_t Mask __attribute__((vector_size(32)));
};
template <class Real>
using Lanes = typename LaneTypes<Real>::Vector;

/// The larger of each pair.
template <class Vector>
inline Vector max_lanes(Vector a, Vector b) {
  return a > b ? a : b;
}

/// Two boxes laid side by side, an axis a row: {lo of first, lo of second, hi of first, hi of second}.
template <class Real>
struct BoxPair {
  Lanes<Real> planes[3];

  void set(int which, const Box<Real>& box) {
    for (int axis = 0; axis < 3; ++axis) {
      planes[axis][which] = box.lo[axis];
      planes[axis][2 + which] = box.hi[axis];
    }
  }
  Box<Real> box(int which) const {
    Box<Real> box;
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = planes[axis][which];
      box.hi[axis] = planes[axis][2 + which];
    }
    return box;
  }
};

/// A ray prepared for testing pairs of boxes: `Crossings::inside` for both at once, to the last bit.
template <class Real>
class PairCrossings {
 public:
  explicit PairCrossings(const Ray<Real>& ray) {
    const Crossings<Real> crossings(ray);
    for (int axis = 0; axis < 3; ++axis) {
      const Real origin = crossings.origin[axis], inverse = crossings.inverse[axis];
      origin_[axis] = Lanes<Real>{origin, origin, origin, origin};
      inverse_[axis] = Lanes<Real>{inverse, inverse, -inverse, -inverse};
      turn_[axis] = inverse < 0 ? Mask{2, 3, 0, 1} : Mask{0, 1, 2, 3};
    }
  }

  /// {enter of first, enter of second, -exit of first, -exit of second}, narrowed to `limits`, which is
  /// {t_min, t_min, -reach, -reach}. A box is met where enter <= exit.
  Lanes<Real> inside(const BoxPair<Real>& pair, Lanes<Real> limits) const {
    const Lanes<Real> x = (__builtin_shuffle(pair.planes[0], turn_[0]) - origin_[0]) * inverse_[0];
    const Lanes<Real> y = (__builtin_shuffle(pair.planes[1], turn_[1]) - origin_[1]) * inverse_[1];
    const Lanes<Real> z = (__builtin_shuffle(pair.planes[2], turn_[2]) - origin_[2]) * inverse_[2];
    return max_lanes(max_lanes(x, y), max_lanes(z, limits));
  }

 private:
  using Mask = typename LaneTypes<Real>::Mask;

  Lanes<Real> origin_[3], inverse_[3];
  Mask turn_[3];
};

}  // namespace rayshoot
