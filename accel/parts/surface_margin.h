#pragma once

#include "scenes/geometry/ray.h"

namespace rayshoot {

/// Where objects are assigned to cells by their surfaces instead of their bounds, a hit must lie in a cell that the
/// surface reaches. A hit is exact to some units in the last place of the way from the ray's origin, so no margin
/// around the cells serves all rays: this one serves every ray that starts within `kReach` scene sizes of the scene's
/// centre. The others are given, ray by ray, the margin that they need.
template <class Real>
class SurfaceMargin {
 public:
  explicit SurfaceMargin(const Box<Real>& scene)
      : centre_(scene.empty() ? Vec3<Real>{} : scene.centre()),
        size_(scene.empty() ? 0 : max_abs(scene.extent())) {}

  /// By how much to widen a cell before asking which surfaces reach it.
  Real of_cells() const { return kRounding * (kReach + 1) * size_; }

  /// By how much to widen all cells once more for this ray: zero for an ordinary one, infinity where the direction is
  /// so short or so long that its inverse is no measure any more.
  Real of_ray(const Ray<Real>& ray) const {
    using Limits = std::numeric_limits<Real>;
    const Real length = max_abs(ray.direction), distance = max_abs(ray.origin - centre_);
    if (!(length >= Limits::min() / Limits::epsilon() * 8 && length <= Limits::max() * Limits::epsilon() / 8))
      return Limits::infinity();
    return distance <= kReach * size_ ? 0 : kRounding * distance;
  }

 private:
  static constexpr Real kReach = 4;
  /// How far a hit may be misplaced, by its distance from the ray's origin; generous.
  static constexpr Real kRounding = 32 * std::numeric_limits<Real>::epsilon();

  Vec3<Real> centre_;
  Real size_;
};

/// The box grown by `margin` on every side.
template <class Real>
Box<Real> widened(const Box<Real>& box, Real margin) {
  const Vec3<Real> by{margin, margin, margin};
  return {box.lo - by, box.hi + by};
}

}  // namespace rayshoot
