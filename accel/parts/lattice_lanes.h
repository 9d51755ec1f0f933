#pragma once

#include <immintrin.h>

#include "accel/parts/lattice.h"

namespace rayshoot {

/// One bit for each of the axes x, y and z on which a comparison of lanes holds.
inline unsigned axes_of(decltype(Lanes<float>{} < Lanes<float>{}) holds) {
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(holds))) & 7;
}
inline unsigned axes_of(decltype(Lanes<double>{} < Lanes<double>{}) holds) {
  return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(holds))) & 7;
}

/// The lanes of the axes on which an octant is the upper half.
template <class Real>
auto upper_halves(unsigned octant) {
  using Number = std::conditional_t<std::is_same_v<Real, float>, std::int32_t, std::int64_t>;
  struct alignas(sizeof(Lanes<Real>)) Masks {
    Number axes[8][4];
  };
  static constexpr Masks masks = [] {
    Masks made{};
    for (unsigned number = 0; number < 8; ++number)
      for (unsigned axis = 0; axis < 3; ++axis) made.axes[number][axis] = number >> axis & 1 ? -1 : 0;
    return made;
  }();
  decltype(Lanes<Real>{} < Lanes<Real>{}) upper;
  std::memcpy(&upper, masks.axes[octant], sizeof upper);
  return upper;
}

/// Numbers of planes of a lattice, which are small enough to be exact in any precision, in lanes.
template <class Real>
Lanes<Real> in_lanes(const Layers& planes) {
  return Lanes<Real>{static_cast<Real>(planes[0]), static_cast<Real>(planes[1]), static_cast<Real>(planes[2]),
                     0};
}

/// A `LatticeRay` in lanes: of the axes x, y and z, with the same parameters to the last bit.
template <class Real>
class LatticeLanes {
 public:
  LatticeLanes(const Lattice<Real>& lattice, const LatticeRay<Real>& path) {
    const Crossings<Real>& crossings = path.crossings();
    for (int axis = 0; axis < 3; ++axis) {
      const bool backwards = path.mirror() >> axis & 1;
      first_[axis] = backwards ? static_cast<Real>(lattice.layers()) : 0;
      sign_[axis] = backwards ? -1 : 1;
      lo_[axis] = lattice.lo[axis], step_[axis] = lattice.step[axis];
      origin_[axis] = crossings.origin[axis];
      earliest_[axis] = crossings.earliest[axis], latest_[axis] = crossings.latest[axis];
    }
  }

  /// Where planes of the mirrored axes are, as seen from the ray's origin.
  Lanes<Real> away(Lanes<Real> planes) const { return lo_ + (first_ + sign_ * planes) * step_ - origin_; }
  /// The earliest parameters at which the ray may pass planes that far away, and the latest.
  Lanes<Real> entry(Lanes<Real> away) const { return away * earliest_; }
  Lanes<Real> exit(Lanes<Real> away) const { return away * latest_; }

 private:
  Lanes<Real> first_{}, sign_{}, lo_{}, step_{}, origin_{}, earliest_{}, latest_{};
};

}  // namespace rayshoot
