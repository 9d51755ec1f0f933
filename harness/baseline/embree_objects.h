#pragma once

#include <array>
#include <vector>

#include "harness/baseline/embree_scene.h"
#include "scenes/core/geometry.h"

namespace rayshoot {

/// A scene's objects as objects of Embree's own: triangles and polygons become a triangle mesh, spheres
/// become points, and what is left becomes user geometry that is traced by our test. Embree holds on to the
/// address of this object.
class EmbreeObjects {
 public:
  /// Fill `scene`, which is not built yet. Without `native_spheres` spheres become user geometry, too.
  EmbreeObjects(const Geometry<float>& geometry, bool native_spheres, EmbreeScene& scene);
  EmbreeObjects(const EmbreeObjects&) = delete;
  EmbreeObjects& operator=(const EmbreeObjects&) = delete;

  /// Our number of the object behind a primitive that Embree hit.
  std::uint32_t object(unsigned part, unsigned primitive) const {
    return objects_[part].empty() ? primitive : objects_[part][primitive];
  }

 private:
  enum Part : unsigned { kTriangles, kPoints, kUser, kParts };

  /// A triangle cut from a polygon: three of its corners.
  struct Piece {
    std::uint32_t polygon;
    std::array<std::uint32_t, 3> corners;
  };

  std::vector<Piece> divide(bool native_spheres);
  void cut(std::uint32_t polygon, std::vector<Piece>& pieces);
  void attach_triangles(const std::vector<Piece>& pieces, EmbreeScene& scene);
  void attach_points(EmbreeScene& scene);
  void attach_user(EmbreeScene& scene);

  static void bounds_of_user(const RTCBoundsFunctionArguments* arguments);
  static void intersect_user(const RTCIntersectFunctionNArguments* arguments);
  static void occlude_user(const RTCOccludedFunctionNArguments* arguments);
  float hit_distance(RTCRayN* rays, unsigned count, unsigned i, unsigned primitive) const;

  const Geometry<float>& geometry_;
  /// The objects of each part by primitive number; empty where both numbers are the same.
  std::array<std::vector<std::uint32_t>, kParts> objects_;
};

}  // namespace rayshoot
