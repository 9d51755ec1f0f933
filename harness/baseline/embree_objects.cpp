#include "harness/baseline/embree_objects.h"

#include <tbb/parallel_for.h>

#include "scenes/geometry/triangulate.h"

namespace rayshoot {

EmbreeObjects::EmbreeObjects(const Geometry<float>& geometry, bool native_spheres, EmbreeScene& scene)
    : geometry_(geometry) {
  const std::vector<Piece> pieces = divide(native_spheres);
  if (!objects_[kTriangles].empty()) attach_triangles(pieces, scene);
  if (!objects_[kPoints].empty()) attach_points(scene);
  if (!objects_[kUser].empty()) attach_user(scene);
  if (geometry.triangles_only()) objects_[kTriangles] = {};
}

/// Sort the objects by part. Triangles cut from polygons come behind the others and are returned as well.
std::vector<EmbreeObjects::Piece> EmbreeObjects::divide(bool native_spheres) {
  std::vector<Piece> pieces;
  for (std::uint32_t object = 0; object < geometry_.size(); ++object) switch (geometry_.kind(object)) {
      case ObjectKind::triangle:
        objects_[kTriangles].push_back(object);
        break;
      case ObjectKind::polygon:
        cut(object, pieces);
        break;
      case ObjectKind::sphere:
        objects_[native_spheres ? kPoints : kUser].push_back(object);
        break;
      case ObjectKind::cone:
      case ObjectKind::placed:
        objects_[kUser].push_back(object);
        break;
    }
  for (const Piece& piece : pieces) objects_[kTriangles].push_back(piece.polygon);
  return pieces;
}

/// Cut a polygon into triangles; one that cannot be cut is left to our own test.
void EmbreeObjects::cut(std::uint32_t polygon, std::vector<Piece>& pieces) {
  const auto triangles = triangulate(geometry_.polygon_vertices(polygon), geometry_.polygon(polygon).normal);
  for (const auto& corners : triangles) pieces.push_back({polygon, corners});
  if (triangles.empty()) objects_[kUser].push_back(polygon);
}

void EmbreeObjects::attach_triangles(const std::vector<Piece>& pieces, EmbreeScene& scene) {
  const std::size_t count = objects_[kTriangles].size(), whole = count - pieces.size();
  EmbreeGeometry mesh(RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = mesh.buffer<Vec3<float>>(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 3 * count);
  auto* indices = mesh.buffer<std::array<unsigned, 3>>(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    const auto first = static_cast<unsigned>(3 * i);
    indices[i] = {first, first + 1, first + 2};
    if (i < whole) {
      const Triangle<float>& triangle = geometry_.triangle(objects_[kTriangles][i]);
      vertices[first] = triangle.a, vertices[first + 1] = triangle.b, vertices[first + 2] = triangle.c;
    } else {
      const Piece& piece = pieces[i - whole];
      const auto corners = geometry_.polygon_vertices(piece.polygon);
      for (unsigned k = 0; k < 3; ++k) vertices[first + k] = corners[piece.corners[k]];
    }
  });
  scene.attach(mesh, kTriangles);
}

void EmbreeObjects::attach_points(EmbreeScene& scene) {
  const std::vector<std::uint32_t>& spheres = objects_[kPoints];
  EmbreeGeometry points(RTC_GEOMETRY_TYPE_SPHERE_POINT);
  auto* centres = points.buffer<Sphere<float>>(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, spheres.size());
  for (std::size_t i = 0; i < spheres.size(); ++i) centres[i] = geometry_.sphere(spheres[i]);
  scene.attach(points, kPoints);
}

void EmbreeObjects::attach_user(EmbreeScene& scene) {
  EmbreeGeometry user(RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(user.get(), static_cast<unsigned>(objects_[kUser].size()));
  rtcSetGeometryBoundsFunction(user.get(), bounds_of_user, nullptr);
  rtcSetGeometryIntersectFunction(user.get(), intersect_user);
  rtcSetGeometryOccludedFunction(user.get(), occlude_user);
  rtcSetGeometryUserData(user.get(), this);
  scene.attach(user, kUser);
}

void EmbreeObjects::bounds_of_user(const RTCBoundsFunctionArguments* arguments) {
  const auto& self = *static_cast<const EmbreeObjects*>(arguments->geometryUserPtr);
  const Box<float> box = self.geometry_.bounds(self.objects_[kUser][arguments->primID]);
  *arguments->bounds_o = {box.lo.x, box.lo.y, box.lo.z, 0, box.hi.x, box.hi.y, box.hi.z, 0};
}

/// Our test of ray number `i` of a packet.
float EmbreeObjects::hit_distance(RTCRayN* rays, unsigned count, unsigned i, unsigned primitive) const {
  const Ray<float> ray{
      .origin = {RTCRayN_org_x(rays, count, i), RTCRayN_org_y(rays, count, i), RTCRayN_org_z(rays, count, i)},
      .t_min = RTCRayN_tnear(rays, count, i),
      .direction = {RTCRayN_dir_x(rays, count, i), RTCRayN_dir_y(rays, count, i),
                    RTCRayN_dir_z(rays, count, i)},
      .t_max = RTCRayN_tfar(rays, count, i)};
  return geometry_.hit_distance(objects_[kUser][primitive], ray);
}

void EmbreeObjects::intersect_user(const RTCIntersectFunctionNArguments* arguments) {
  const auto& self = *static_cast<const EmbreeObjects*>(arguments->geometryUserPtr);
  const unsigned count = arguments->N;
  RTCRayN* const rays = RTCRayHitN_RayN(arguments->rayhit, count);
  RTCHitN* const hits = RTCRayHitN_HitN(arguments->rayhit, count);
  for (unsigned i = 0; i < count; ++i) {
    if (!arguments->valid[i]) continue;
    const float t = self.hit_distance(rays, count, i, arguments->primID);
    if (!(t <= RTCRayN_tfar(rays, count, i))) continue;
    RTCRayN_tfar(rays, count, i) = t;
    RTCHitN_geomID(hits, count, i) = arguments->geomID;
    RTCHitN_primID(hits, count, i) = arguments->primID;
  }
}

void EmbreeObjects::occlude_user(const RTCOccludedFunctionNArguments* arguments) {
  const auto& self = *static_cast<const EmbreeObjects*>(arguments->geometryUserPtr);
  const unsigned count = arguments->N;
  for (unsigned i = 0; i < count; ++i) {
    float& end = RTCRayN_tfar(arguments->ray, count, i);
    if (arguments->valid[i] && self.hit_distance(arguments->ray, count, i, arguments->primID) <= end)
      end = -std::numeric_limits<float>::infinity();
  }
}

}  // namespace rayshoot
