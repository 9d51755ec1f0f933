#pragma once

#include "scenes/geometry/ray.h"

namespace rayshoot {

/// Two boxes laid side by side: for every axis the lower planes of both, then the upper planes of both.
template <class Real>
struct BoxPair {
  typename LaneTypes<Real>::Two planes[3][2];

  void set(int which, const Box<Real>& box) {
    for (int axis = 0; axis < 3; ++axis) {
      planes[axis][0][which] = box.lo[axis];
      planes[axis][1][which] = box.hi[axis];
    }
  }
  Box<Real> box(int which) const {
    Box<Real> box;
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = planes[axis][0][which];
      box.hi[axis] = planes[axis][1][which];
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
      const Real origin = crossings.origin[axis];
      const Real earliest = crossings.earliest[axis], latest = crossings.latest[axis];
      origin_[axis] = Lanes<Real>{origin, origin, origin, origin};
      inverse_[axis] = Lanes<Real>{earliest, earliest, -latest, -latest};
      near_[axis] = crossings.inverse[axis] < 0;
    }
  }

  /// {enter of first, enter of second, -exit of first, -exit of second}, narrowed to `limits`, which is
  /// {t_min, t_min, -reach, -reach}. A box is met where enter <= exit.
  Lanes<Real> inside(const BoxPair<Real>& pair, Lanes<Real> limits) const {
    return max_lanes(max_lanes(crossing(pair, 0), crossing(pair, 1)), max_lanes(crossing(pair, 2), limits));
  }

 private:
  /// Where the ray meets the nearer planes of an axis, and minus where it meets the farther ones.
  Lanes<Real> crossing(const BoxPair<Real>& pair, int axis) const {
    const auto near = pair.planes[axis][near_[axis]], far = pair.planes[axis][near_[axis] ^ 1];
    return (__builtin_shufflevector(near, far, 0, 1, 2, 3) - origin_[axis]) * inverse_[axis];
  }

  Lanes<Real> origin_[3], inverse_[3];
  std::size_t near_[3];
};

}  // namespace rayshoot
