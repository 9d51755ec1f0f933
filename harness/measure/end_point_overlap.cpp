#include "harness/measure/end_point_overlap.h"

#include <numbers>
#include <numeric>
#include <random>

#include "accel/core/batch.h"

namespace rayshoot {

namespace {

/// Points that are tried until one is inside a polygon.
constexpr int kTries = 1000;
/// How far beside a point its volumes may end for rounding, in units in the last place of the scene's coordinates.
constexpr double kRounding = 64;

/// Three independent numbers of [0, 1).
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : generator_(seed) {}
  double operator()() { return std::uniform_real_distribution<>()(generator_); }

 private:
  std::mt19937_64 generator_;
};

template <class Real>
double slant_height(const Cone<Real>& cone) {
  return std::hypot(length(Vec3d(cone.apex) - Vec3d(cone.base)),
                    static_cast<double>(cone.base_radius) - cone.apex_radius);
}

/// What is flat has two sides, but a ray ends on one: they count once.
template <class Real>
double surface_area(const Geometry<Real>& geometry, std::uint32_t object) {
  switch (geometry.kind(object)) {
    case ObjectKind::triangle:
      return length(double_area_vector(geometry.triangle(object))) / 2;
    case ObjectKind::polygon:
      return length(geometry.polygon(object).normal) / 2;
    case ObjectKind::sphere: {
      const double radius = geometry.sphere(object).radius;
      return 4 * std::numbers::pi * radius * radius;
    }
    case ObjectKind::cone: {
      const Cone<Real>& cone = geometry.cone(object);
      return std::numbers::pi * (static_cast<double>(cone.base_radius) + cone.apex_radius) *
             slant_height(cone);
    }
    case ObjectKind::placed:
      break;
  }
  return 0;
}

template <class Real>
Vec3d point_of(const Triangle<Real>& triangle, Uniform& uniform) {
  const double root = std::sqrt(uniform()), along = uniform();
  return Vec3d(triangle.a) * (1 - root) + Vec3d(triangle.b) * (root * (1 - along)) +
         Vec3d(triangle.c) * (root * along);
}

template <class Real>
Vec3d point_of(const Sphere<Real>& sphere, Uniform& uniform) {
  const double z = 2 * uniform() - 1, angle = 2 * std::numbers::pi * uniform(), r = std::sqrt(1 - z * z);
  return Vec3d(sphere.centre) + Vec3d{r * std::cos(angle), r * std::sin(angle), z} * sphere.radius;
}

/// A height is as likely as the circle there is long.
template <class Real>
Vec3d point_of(const Cone<Real>& cone, Uniform& uniform) {
  const double base = cone.base_radius, apex = cone.apex_radius, u = uniform();
  const double radius = std::sqrt(base * base + u * (apex * apex - base * base));
  const double part = base == apex ? u : (radius - base) / (apex - base);
  const Vec3d from(cone.base), axis = Vec3d(cone.apex) - from;
  const Vec3d aside = std::abs(axis.x) < std::abs(axis.y) ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d first = normalized(cross(axis, aside)), second = normalized(cross(axis, first));
  const double angle = 2 * std::numbers::pi * uniform();
  return from + axis * part + (first * std::cos(angle) + second * std::sin(angle)) * radius;
}

/// Points of its box are projected on its plane until one is inside.
template <class Real>
std::optional<Vec3d> point_of(const Polygon<Real>& polygon, std::span<const Vec3<Real>> vertices,
                              Uniform& uniform) {
  const Vec3d low(polygon.box.lo), extent = Vec3d(polygon.box.hi) - low;
  const int axis = polygon.dropped_axis;
  for (int i = 0; i < kTries; ++i) {
    Vec3d point{low.x + uniform() * extent.x, low.y + uniform() * extent.y, low.z + uniform() * extent.z};
    point[axis] += (polygon.offset - dot(polygon.normal, point)) / polygon.normal[axis];
    if (covers(vertices, axis, point)) return point;
  }
  return std::nullopt;
}

template <class Real>
std::optional<Vec3d> point_of(const Geometry<Real>& geometry, std::uint32_t object, Uniform& uniform) {
  switch (geometry.kind(object)) {
    case ObjectKind::triangle:
      return point_of(geometry.triangle(object), uniform);
    case ObjectKind::polygon:
      return point_of(geometry.polygon(object), geometry.polygon_vertices(object), uniform);
    case ObjectKind::sphere:
      return point_of(geometry.sphere(object), uniform);
    case ObjectKind::cone:
      return point_of(geometry.cone(object), uniform);
    case ObjectKind::placed:
      break;
  }
  return std::nullopt;
}

/// A ray that begins just before a point and ends just behind it.
template <class Real>
Ray<Real> ray_about(const Vec3d& point, double margin) {
  const Vec3d direction{0.6, 0.48, 0.64};
  return {.origin = Vec3<Real>(point - direction * margin),
          .t_min = 0,
          .direction = Vec3<Real>(direction),
          .t_max = static_cast<Real>(2 * margin)};
}

}  // namespace

template <class Real>
std::vector<SurfacePoint> surface_points(const Geometry<Real>& geometry, std::size_t count,
                                         std::uint64_t seed) {
  std::vector<double> areas(geometry.size());
  for (std::uint32_t object = 0; object < areas.size(); ++object)
    areas[object] = surface_area(geometry, object);
  std::partial_sum(areas.begin(), areas.end(), areas.begin());
  std::vector<SurfacePoint> points;
  if (areas.empty() || !(areas.back() > 0)) return points;
  Uniform uniform(seed);
  for (std::size_t i = 0; i < count; ++i) {
    // One point in each of as many equal parts of the area.
    const double at = (static_cast<double>(i) + uniform()) / static_cast<double>(count) * areas.back();
    const auto found = std::upper_bound(areas.begin(), areas.end() - 1, at);
    const auto object = static_cast<std::uint32_t>(found - areas.begin());
    if (const auto point = point_of(geometry, object, uniform)) points.push_back({*point, object});
  }
  return points;
}

template <class Real>
std::optional<report::EndPointOverlap> end_point_overlap(const Engine<Real>& engine,
                                                         const Geometry<Real>& geometry,
                                                         const std::vector<SurfacePoint>& points,
                                                         int threads) {
  const std::vector<PathTests> paths = engine.path_tests();
  if (!engine.countable() || paths.empty() || points.empty()) return std::nullopt;

  // Count what volumes about the points cost, and take off those that their objects are in.
  const double scale = std::max(max_abs(Vec3d(geometry.bounds().lo)), max_abs(Vec3d(geometry.bounds().hi)));
  const double margin = kRounding * std::numeric_limits<Real>::epsilon() * scale;
  std::vector<Ray<Real>> rays;
  double own_objects = 0, own_volumes = 0;
  for (const SurfacePoint& point : points) {
    rays.push_back(ray_about<Real>(point.point, margin));
    own_objects += static_cast<double>(paths[point.object].object_tests);
    own_volumes += static_cast<double>(paths[point.object].volume_tests);
  }
  std::vector<Hit<Real>> hits(rays.size());
  ThreadScratch<Real> scratch(engine);
  const Work work = count_work<Real>(engine, Query::strict, rays, hits, scratch, threads).total;
  const auto per_point = [&](std::uint64_t tests, double own) {
    return std::max(0.0, static_cast<double>(tests) - own) / static_cast<double>(points.size());
  };
  return report::EndPointOverlap{points.size(), per_point(work.object_tests, own_objects),
                                 per_point(work.volume_tests, own_volumes)};
}

template std::vector<SurfacePoint> surface_points<float>(const Geometry<float>&, std::size_t, std::uint64_t);
template std::vector<SurfacePoint> surface_points<double>(const Geometry<double>&, std::size_t,
                                                          std::uint64_t);
template std::optional<report::EndPointOverlap> end_point_overlap<float>(const Engine<float>&,
                                                                         const Geometry<float>&,
                                                                         const std::vector<SurfacePoint>&,
                                                                         int);
template std::optional<report::EndPointOverlap> end_point_overlap<double>(const Engine<double>&,
                                                                          const Geometry<double>&,
                                                                          const std::vector<SurfacePoint>&,
                                                                          int);

}  // namespace rayshoot
