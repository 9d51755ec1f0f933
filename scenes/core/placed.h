#pragma once

#include <memory>

#include "scenes/core/affine.h"
#include "scenes/geometry/ray.h"

namespace rayshoot {

template <class Real>
class Geometry;

/// A placed part, compiled for tracing as one object. Rays are taken into its coordinates, where distances stay what they
/// are: directions keep no unit length.
template <class Real>
struct Placed {
  std::shared_ptr<const Geometry<Real>> part;
  Affine part_from_scene;
  /// About what is in it, at the time 0; so wide that the rounding of rays on their way into the part does not matter.
  Box<Real> box;
  Vec3<Real> velocity;

  bool moves() const { return !(velocity == Vec3<Real>{}); }

  /// The box at a time; it never leaves `box_between` of times around it, for rounding is monotone.
  Box<Real> box_at(Real time) const {
    const Vec3<Real> way = velocity * time;
    return {box.lo + way, box.hi + way};
  }
  /// About the boxes at all times between two.
  Box<Real> box_between(Real first, Real last) const {
    Box<Real> all = box_at(first);
    all.include(box_at(last));
    return all;
  }

  /// Where on a ray hits in the part count: as long as it is inside the box at its time.
  Interval<Real> interval(const Ray<Real>& ray) const {
    return interval_inside(moves() ? box_at(ray.time) : box, ray);
  }

  /// The ray as the part sees it.
  Ray<Real> inside(const Ray<Real>& ray) const {
    const Vec3d origin = Vec3d(ray.origin) - Vec3d(velocity) * static_cast<double>(ray.time);
    Ray<Real> result = ray;
    result.origin = Vec3<Real>(part_from_scene(origin));
    result.direction = Vec3<Real>(part_from_scene.direction(Vec3d(ray.direction)));
    return result;
  }
};

/// So many units in the last place are rays off, in a part's coordinates and back again, at the most.
inline constexpr int kPlacingUlps = 16;

/// Whether a hit in a part counts, which lies in that interval.
template <class Real>
bool counts_within(Real t, const Interval<Real>& interval) {
  return t >= interval.enter && t <= interval.exit;
}

}  // namespace rayshoot
