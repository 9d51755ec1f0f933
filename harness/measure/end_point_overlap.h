#pragma once

#include <optional>
#include <vector>

#include "accel/core/engine.h"
#include "harness/report/report.h"

namespace rayshoot {

struct SurfacePoint {
  Vec3d point;
  std::uint32_t object = 0;
};

/// Random points of all surfaces, spread evenly by area: the same for a seed. Fewer where points of a surface are hard to
/// find, none where there is no area.
template <class Real>
std::vector<SurfacePoint> surface_points(const Geometry<Real>& geometry, std::size_t count,
                                         std::uint64_t seed);

/// End-point overlap, equation (3) of Aila, Karras and Laine 2013: what a ray costs, that ends at a random point of the
/// surfaces, in volumes about other objects than the one it ends at. Absent where the engine is no hierarchy of volumes.
template <class Real>
std::optional<report::EndPointOverlap> end_point_overlap(const Engine<Real>& engine,
                                                         const Geometry<Real>& geometry,
                                                         const std::vector<SurfacePoint>& points,
                                                         int threads);

}  // namespace rayshoot
