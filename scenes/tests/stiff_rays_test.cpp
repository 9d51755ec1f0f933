#include <gtest/gtest.h>

#include <map>

#include "scenes/core/geometry.h"
#include "scenes/tests/exhaustive_tracer.h"
#include "scenes/tests/stiff_settings.h"

namespace rayshoot {
namespace {

bool is_whole(double x) { return x == std::floor(x); }

TEST(InPlane, RaysKeepToAsManyPlanesAsTheySay) {
  for (const StiffSetting& setting : settings_of("in_plane")) {
    const int expected = setting.label == "rays=off_planes"                                       ? 0
                         : setting.label == "rays=in_face" || setting.label == "rays=in_box_face" ? 1
                                                                                                  : 2;
    for (const Ray<double>& ray : rays_of(setting, 100)) {
      int planes = 0;
      for (int axis = 0; axis < 3; ++axis) planes += is_whole(ray.origin[axis]) && ray.direction[axis] == 0;
      EXPECT_EQ(planes, expected) << setting.label;
    }
  }
}

TEST(CornerWalk, TrianglesTouchCornersThroughWhichTheRaysPass) {
  const auto is_corner = [](const Vec3d& p) { return is_whole(p.x) && is_whole(p.y) && is_whole(p.z); };
  for (const StiffSetting& setting : settings_of("corner_walk")) {
    EXPECT_EQ(setting.scene->bounds(), (Box<double>{{0, 0, 0}, {8, 8, 8}}));
    for (const auto& [a, b, c] : setting.scene->triangles) {
      EXPECT_TRUE(is_corner(a));
      EXPECT_LT(max_abs(b - a), 0.5);
      EXPECT_LT(max_abs(c - a), 0.5);
    }
    std::size_t through = 0;
    for (const Ray<double>& ray : rays_of(setting, 100)) {
      through += is_corner(ray.at(16));
      EXPECT_EQ(ray.at(16) - ray.at(15), ray.direction);
    }
    EXPECT_EQ(through > 50, setting.label != "rays=beside_corners");
    EXPECT_TRUE(through == 100 || setting.label == "rays=beside_corners");
  }
}

/// Whether a point is exactly on the cube, the octahedron or the sphere of the case; coordinates have few bits.
bool is_on_surface(const Vec3d& p) {
  const auto size = [](const Vec3d& q) { return Vec3d{std::abs(q.x), std::abs(q.y), std::abs(q.z)}; };
  const Vec3d octahedral = size(p - Vec3d{4, 0, 0}), spherical = p - Vec3d{-4, 0, 0};
  return max_abs(p) == 0.5 || octahedral.x + octahedral.y + octahedral.z == 1 ||
         dot(spherical, spherical) == 0.9375 * 0.9375;
}

TEST(OnSurface, RaysStartExactlyThereOrJustOutside) {
  for (const StiffSetting& setting : settings_of("on_surface")) {
    if (!setting.label.starts_with("ulps=")) continue;
    const auto rays = rays_of(setting, 100);
    for (std::size_t i = 0; i < rays.size(); ++i)
      EXPECT_EQ(is_on_surface(rays[i].origin), setting.stiffness_parameter == 0)
          << setting.label << ", ray " << i;
  }
}

TEST(RayEnds, AreTheDistanceOfTheFirstPlateOrTheFloatBeside) {
  const auto settings = settings_of("ray_ends");
  const auto first = [](const Ray<double>& ray) { return (ray.origin.z + 1) / -ray.direction.z; };
  const auto neighbour = [](double t, double towards) {
    return static_cast<double>(std::nextafter(static_cast<float>(t), static_cast<float>(towards)));
  };
  const auto rays = [&](const char* label) { return rays_of(setting_of(settings, label), 100); };
  for (const Ray<double>& ray : rays("t_max=hit")) EXPECT_EQ(ray.t_max, first(ray));
  for (const Ray<double>& ray : rays("t_max=hit-ulp")) EXPECT_EQ(ray.t_max, neighbour(first(ray), 0));
  for (const Ray<double>& ray : rays("t_max=hit+ulp")) EXPECT_EQ(ray.t_max, neighbour(first(ray), 1e30));
  for (const Ray<double>& ray : rays("t_min=hit")) EXPECT_EQ(ray.t_min, first(ray));
  for (const Ray<double>& ray : rays("interval=empty")) EXPECT_EQ(ray.t_min, ray.t_max);
  for (const Ray<double>& ray : rays("interval=reversed")) EXPECT_GT(ray.t_min, ray.t_max);
}

/// The discriminant of a ray and a surface through the whole numbers of the case, exact in double precision.
double discriminant(const StiffSetting& setting, const Ray<double>& ray) {
  const auto squared = [](const Vec3d& v) { return dot(v, v); };
  // Back to the copy around the origin: the point touched is (3, 4, 0) or nearly so.
  const Vec3d touched = ray.at(setting.stiffness_parameter) - Vec3d{3, 4, 0};
  const Vec3d copy{32 * std::nearbyint(touched.x / 32), 32 * std::nearbyint(touched.y / 32),
                   32 * std::nearbyint(touched.z / 32)};
  const Vec3d p = ray.at(setting.stiffness_parameter) - copy, d = ray.direction;
  if (setting.label.starts_with("object=sphere")) return 25 * squared(d) - squared(cross(p, d));
  const bool is_cone = setting.label.starts_with("object=cone");
  // x^2 + y^2 = (5 - z)^2, or 5^2.
  const double rise = is_cone ? -d.z : 0, radius = is_cone ? 5 - p.z : 5;
  const double a = d.x * d.x + d.y * d.y - rise * rise, b = p.x * d.x + p.y * d.y - radius * rise;
  return b * b - a * (p.x * p.x + p.y * p.y - radius * radius);
}

TEST(QuadricGraze, EvenRaysTouchExactlyAndOddOnesDoNot) {
  for (const StiffSetting& setting : settings_of("quadric_graze")) {
    const auto rays = rays_of(setting, 100);
    for (std::size_t i = 0; i < rays.size(); ++i)
      EXPECT_EQ(discriminant(setting, rays[i]) == 0, i % 2 == 0) << setting.label << ", ray " << i;
  }
}

TEST(RayClassBorder, DirectionsLieOnTheirBorder) {
  for (const StiffSetting& setting : settings_of("ray_class_border"))
    for (const Ray<double>& ray : rays_of(setting, 100)) {
      int ones = 0, sixteenths = 0, zeros = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const double size = std::abs(ray.direction[axis]);
        ones += size == 1, sixteenths += is_whole(16 * size), zeros += size == 0;
      }
      const std::map<std::string, bool> lies_on = {{"border=none", ones == 1 && sixteenths == 1},
                                                   {"border=face", ones == 2 && sixteenths == 2},
                                                   {"border=cell", ones == 1 && sixteenths == 2},
                                                   {"border=corner", ones == 3},
                                                   {"border=axis", ones == 1 && zeros == 2}};
      EXPECT_TRUE(lies_on.at(setting.label)) << setting.label;
    }
}

TEST(Threads, RaysMeetVerticesExactlyAndFollowAxes) {
  const auto settings = settings_of("threads");
  const std::vector<Vec3d> vertices = vertices_of(*settings[0].scene);
  for (const Ray<double>& ray : rays_of(setting_of(settings, "rays=to_vertices"), 100))
    EXPECT_NE(std::find(vertices.begin(), vertices.end(), ray.at(1)), vertices.end());
  for (const Ray<double>& ray : rays_of(setting_of(settings, "rays=along_axes"), 100)) {
    EXPECT_EQ(max_abs(ray.direction), 1);
    EXPECT_EQ(dot(ray.direction, ray.direction), 1);
  }
}

TEST(Replay, FirstRaysAreTheReportedOnes) {
  const auto settings = settings_of("replay");
  const auto first = [&](const char* label) { return rays_of(setting_of(settings, label), 1)[0]; };
  const Ray<double> cts = first("case=vk_cts_446");
  EXPECT_EQ(cts.origin, (Vec3d{240.5 / 256, 15.5 / 256, 0}));
  EXPECT_EQ(cts.direction, (Vec3d{0, 0, -1}));
  EXPECT_EQ(setting_of(settings, "case=vk_cts_446").scene->triangles[0].c,
            (Vec3d{std::bit_cast<float>(0x3ec83ac8), std::bit_cast<float>(0x3f1be29d),
                   std::bit_cast<float>(0xbed79c23)}));
  EXPECT_EQ(first("case=tinybvh_283").origin, (Vec3d{2e-4f / 3, 2e-4f / 3, -1}));
  EXPECT_TRUE(std::signbit(first("case=madmann_20").direction.y));
  EXPECT_EQ(first("case=pbrt_bad_cases").t_max, 0.9999f);
}

TEST(Replay, WhatTheReportsMissedIsThere) {
  for (const StiffSetting& setting : settings_of("replay")) {
    if (!setting.label.starts_with("case=")) continue;
    const auto rays = rays_of(setting, 100);
    std::vector<Hit<double>> hits(rays.size());
    ExhaustiveTracer(*setting.scene).closest(rays, hits);
    for (const Hit<double>& hit : hits)
      EXPECT_EQ(hit.object != kNoObject, setting.property != Property::never_hit) << setting.label;
  }
}

}  // namespace
}  // namespace rayshoot
