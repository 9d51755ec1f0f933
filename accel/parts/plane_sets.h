#pragma once

#include <array>
#include <span>

#include "accel/parts/volume_kinds.h"

namespace rayshoot {

/// The plane-set normals of Kay and Kajiya (1986): the coordinate axes, then the diagonals of the unit cube, then those of
/// its faces. Any number of the first ones makes volumes that lie within those of fewer. Their components are 0 and ±1, so
/// that a dot product is a sum.
inline constexpr int kMostPlaneSets = 13;
inline constexpr std::array<Vec3d, kMostPlaneSets> kPlaneSetNormals = {{{1, 0, 0},
                                                                        {0, 1, 0},
                                                                        {0, 0, 1},  //
                                                                        {1, 1, 1},
                                                                        {1, -1, -1},
                                                                        {1, 1, -1},
                                                                        {1, -1, 1},  //
                                                                        {1, 1, 0},
                                                                        {1, -1, 0},
                                                                        {0, 1, 1},
                                                                        {0, 1, -1},
                                                                        {1, 0, 1},
                                                                        {1, 0, -1}}};
/// Those that are not coordinate axes: slabs of the axes are boxes, which rays meet as everywhere.
inline constexpr int kMostSlopes = kMostPlaneSets - 3;
inline constexpr const Vec3d& slope_normal(int slope) { return kPlaneSetNormals[3 + slope]; }

/// What a volume reaches along each sloping normal.
struct SlopeExtents {
  std::array<double, kMostSlopes> lo, hi;

  SlopeExtents() {
    lo.fill(Box<double>::infinity());
    hi.fill(-Box<double>::infinity());
  }
  void include(const SurfaceBall& ball) {
    for (int k = 0; k < kMostSlopes; ++k) {
      const double at = dot(slope_normal(k), ball.centre), radius = ball.radius * length(slope_normal(k));
      lo[k] = std::min(lo[k], at - radius), hi[k] = std::max(hi[k], at + radius);
    }
  }
  void include(const SlopeExtents& other) {
    for (int k = 0; k < kMostSlopes; ++k)
      lo[k] = std::min(lo[k], other.lo[k]), hi[k] = std::max(hi[k], other.hi[k]);
  }
};

/// The surface area of a box cut off by the first `slopes` slabs.
template <class Real>
double surface_area(const Box<Real>& box, const SlopeExtents& extents, int slopes);

/// A ray's dot products with the sloping normals, made once a ray: what is left for a slab is two differences, two
/// products and a comparison. The slabs are widened by what a hit may lie beside a surface in a scene, seen from the ray's
/// origin; those of a ray that is not measurable are without end.
template <class Real, int kSlopes>
class SlopeCrossings {
 public:
  SlopeCrossings(const Ray<Real>& ray, const Box<Real>& scene) {
    const bool measurable = is_measurable(ray);
    const Real margin = measurable ? margin_of(ray, scene) : Box<Real>::infinity();
    for (int k = 0; k < kSlopes; ++k) {
      const Vec3<Real> normal(slope_normal(k));
      const Real origin = measurable ? dot(normal, ray.origin) : 0;
      const Real speed = measurable ? dot(normal, ray.direction) : 1;
      from_lo_[k] = origin + margin, from_hi_[k] = origin - margin;
      inverse_[k] = std::clamp(1 / speed, -kLimit, kLimit);
    }
  }

  /// The part of an interval of parameters that lies in the slabs from lo[k] to hi[k].
  Interval<Real> inside(Interval<Real> interval, const Real* lo, const Real* hi) const {
    for (int k = 0; k < kSlopes; ++k) {
      const Real a = (lo[k] - from_lo_[k]) * inverse_[k], b = (hi[k] - from_hi_[k]) * inverse_[k];
      interval.enter = std::max(interval.enter, std::min(a, b));
      interval.exit = std::min(interval.exit, std::max(a, b));
    }
    return interval;
  }

 private:
  /// So that 0 times it is 0.
  static constexpr Real kLimit = std::numeric_limits<Real>::max() / 2;

  /// Twice the error of a hit covers the roundings of the slab's own crossings as well: of sums of three coordinates, of
  /// the planes, and of a parameter along the way.
  static Real margin_of(const Ray<Real>& ray, const Box<Real>& scene) {
    const auto sum = [](const Vec3<Real>& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); };
    const Real reach = sum(ray.origin) + std::max(sum(scene.lo), sum(scene.hi)) + sum(scene.extent());
    return static_cast<Real>(2 * kSurfaceError<Real>) * reach + std::numeric_limits<Real>::min();
  }

  std::array<Real, kSlopes> from_lo_, from_hi_, inverse_;
};

extern template double surface_area(const Box<float>&, const SlopeExtents&, int);
extern template double surface_area(const Box<double>&, const SlopeExtents&, int);

}  // namespace rayshoot
