#include <gtest/gtest.h>

#include <numbers>

#include "scenes/core/geometry.h"
#include "scenes/core/stiffness.h"
#include "scenes/io/mesh.h"
#include "scenes/tests/stiff_settings.h"

namespace rayshoot {
namespace {

/// How often the triangles of a scene go around a point, by the solid angles of Van Oosterom and Strackee (1983).
double winding_number(const Scene& scene, const Vec3d& point) {
  double sum = 0;
  for (const Triangle<double>& triangle : scene.triangles) {
    const Vec3d a = triangle.a - point, b = triangle.b - point, c = triangle.c - point;
    const double la = length(a), lb = length(b), lc = length(c);
    sum += std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (2 * std::numbers::pi);
}

double distance_to_nearest(const std::vector<Vec3d>& points, const Vec3d& p) {
  double nearest = kMiss<double>;
  for (const Vec3d& q : points) nearest = std::min(nearest, length(q - p));
  return nearest;
}

class ClosedMeshes : public testing::TestWithParam<const char*> {};

TEST_P(ClosedMeshes, AreClosedAndSeenFromInside) {
  for (const StiffSetting& setting : settings_of(GetParam())) {
    SCOPED_TRACE(setting.label);
    const auto topology = topology_of(*setting.scene);
    ASSERT_TRUE(topology);
    EXPECT_TRUE(topology->closed);
    EXPECT_EQ(topology->components, 1u);
    EXPECT_EQ(Geometry<float>(*setting.scene).set_aside().size(), 0u);
    for (const Ray<double>& ray : rays_of(setting, 50))
      EXPECT_NEAR(winding_number(*setting.scene, ray.origin), 1, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Stiff, ClosedMeshes, testing::Values("closed_vertex", "closed_edge"));

TEST(ClosedVertex, EvenRaysMeetAVertexExactlyAndOddOnesNearly) {
  for (const StiffSetting& setting : settings_of("closed_vertex")) {
    const auto vertices = vertices_of(*setting.scene);
    const auto rays = rays_of(setting, 50);
    for (std::size_t i = 0; i < rays.size(); ++i)
      EXPECT_LE(distance_to_nearest(vertices, rays[i].at(1)), i % 2 == 0 ? 0 : 2e-7) << setting.label;
  }
}

TEST(ClosedEdge, EvenRaysMeetAMidpointExactly) {
  for (const StiffSetting& setting : settings_of("closed_edge")) {
    std::vector<Vec3d> midpoints;
    for (const auto& [a, b, c] : setting.scene->triangles)
      for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) midpoints.push_back((from + to) * 0.5);
    const auto rays = rays_of(setting, 50);
    for (std::size_t i = 0; i < rays.size(); i += 2)
      EXPECT_EQ(distance_to_nearest(midpoints, rays[i].at(1)), 0) << setting.label;
  }
}

TEST(Fan, RaysMeetTheHubOfAllTriangles) {
  for (const StiffSetting& setting : settings_of("fan")) {
    EXPECT_EQ(setting.scene->size(), static_cast<std::size_t>(setting.stiffness_parameter));
    const Vec3d hub = setting.scene->triangles[0].a;
    for (const Triangle<double>& triangle : setting.scene->triangles) EXPECT_EQ(triangle.a, hub);
    const auto rays = rays_of(setting, 50);
    for (std::size_t i = 0; i < rays.size(); ++i)
      EXPECT_LE(length(rays[i].at(1) - hub), i % 2 == 0 ? 0 : 2e-7) << setting.label;
  }
}

TEST(CtsSquare, TrianglesCoverTheSquareOnce) {
  for (const StiffSetting& setting : settings_of("cts_square")) {
    double doubled_area = 0;
    for (const auto& [a, b, c] : setting.scene->triangles) {
      const double orientation = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
      EXPECT_GT(orientation, 0);
      doubled_area += orientation;
    }
    EXPECT_EQ(doubled_area, 2) << setting.label;
    EXPECT_EQ(static_cast<double>(setting.scene->size()), setting.stiffness_parameter);
    EXPECT_EQ(topology_of(*setting.scene)->boundary_edges, 4u) << setting.label;
  }
}

TEST(GridAxis, RaysRunThroughPointsAndLinesOfTheGrid) {
  const auto settings = settings_of("grid_axis");
  const auto whole = [](double x) { return x == std::floor(x); };
  const auto all = [&](const char* label, const auto& condition) {
    for (const Ray<double>& ray : rays_of(setting_of(settings, label), 100))
      EXPECT_TRUE(condition(ray.origin)) << label << ": " << ray.origin.x << " " << ray.origin.y;
  };
  all("rays=jittered", [&](const Vec3d& p) { return !whole(p.x) && !whole(p.y) && !whole(p.x - p.y); });
  all("rays=vertex", [&](const Vec3d& p) { return whole(p.x) && whole(p.y); });
  all("rays=edge", [&](const Vec3d& p) { return whole(p.x) && !whole(p.y); });
  all("rays=diagonal", [&](const Vec3d& p) { return !whole(p.x) && whole(p.x - p.y); });
  all("rays=along_x", [&](const Vec3d& p) { return whole(p.y) && !whole(p.z); });
  all("rays=level_x", [&](const Vec3d& p) { return whole(p.y) && whole(p.z); });
}

TEST(Sliver, TrianglesHaveTheirAspect) {
  for (const StiffSetting& setting : settings_of("sliver"))
    for (const Triangle<double>& triangle : setting.scene->triangles) {
      const Vec3d ab = triangle.b - triangle.a;
      const double altitude = length(double_area_vector(triangle)) / length(ab);
      const double ratio = length(ab) / altitude / setting.stiffness_parameter;
      EXPECT_GT(ratio, 0.2) << setting.label;
      EXPECT_LT(ratio, 5) << setting.label;
    }
}

TEST(NeedleField, NeedlesAreParallelAndCrossTheScene) {
  const auto settings = settings_of("needle_field");
  for (const StiffSetting& setting : settings) {
    const Vec3d extent = setting.scene->bounds().extent();
    const Triangle<double>& first = setting.scene->triangles[0];
    for (const auto& [a, b, c] : setting.scene->triangles) {
      EXPECT_EQ(b - a, first.b - first.a) << setting.label;
      EXPECT_EQ(b.x - a.x > 0.85 * extent.x, setting.label != "shape=compact") << setting.label;
    }
  }
}

TEST(CoplanarPile, CopiesAreBehindTheFirst) {
  for (const StiffSetting& setting : settings_of("coplanar_pile")) {
    const auto& triangles = setting.scene->triangles;
    const auto copies = std::count(triangles.begin(), triangles.end(), triangles[0]);
    EXPECT_EQ(static_cast<double>(copies), setting.stiffness_parameter);
    for (std::size_t i = 65; i < triangles.size(); ++i) EXPECT_EQ(triangles[i], triangles[0]);
  }
}

TEST(CoplanarOverlap, CornersAndTargetsLieExactlyInTwoPlanes) {
  for (const StiffSetting& setting : settings_of("coplanar_overlap")) {
    const bool tilted = setting.label.starts_with("plane=tilted");
    const auto above = [&](const Vec3d& p) { return p.z - 1.5 - (tilted ? (p.x + p.y) / 8 : 0); };
    std::vector<Vec3d> corners = vertices_of(*setting.scene);
    const auto& more = setting.scene->polygon_vertices;
    corners.insert(corners.end(), more.begin(), more.end());
    const double gap = setting.stiffness_parameter * 0x1p-23;
    for (const Vec3d& corner : corners)
      EXPECT_TRUE(above(corner) == 0 || above(corner) == gap) << setting.label;
    for (const Ray<double>& ray : rays_of(setting, 50)) EXPECT_EQ(above(ray.at(1)), 0) << setting.label;
  }
}

TEST(TeapotStadium, GrowsStifferAsTheTeapotShrinks) {
  const auto settings = settings_of("teapot_stadium");
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const double growth = settings[i].stiffness_parameter / settings[0].stiffness_parameter;
    EXPECT_NEAR(growth / std::pow(1000.0, static_cast<double>(i)), 1, 0.1);
    EXPECT_EQ(stiffness(*settings[i].scene), settings[i].stiffness_parameter);
    EXPECT_EQ(Geometry<float>(*settings[i].scene).set_aside().size(),
              Geometry<float>(*settings[0].scene).set_aside().size());
  }
}

TEST(CsgStack, SolidsShareOneWallAndHoldTheRaysThatStartInside) {
  for (const StiffSetting& setting : settings_of("csg_stack")) {
    SCOPED_TRACE(setting.label);
    const int solids = static_cast<int>(setting.stiffness_parameter);
    const bool inside = setting.label.ends_with("from=inside"), boxes = setting.scene->spheres.empty();
    for (const Sphere<double>& sphere : setting.scene->spheres) EXPECT_EQ(sphere.centre.x + sphere.radius, 1);
    for (const Ray<double>& ray : rays_of(setting, 50)) {
      EXPECT_NEAR(winding_number(*setting.scene, ray.origin), inside && boxes ? solids : 0, 1e-9);
      for (const Sphere<double>& sphere : setting.scene->spheres)
        EXPECT_EQ(length(ray.origin - sphere.centre) < sphere.radius, inside);
    }
  }
}

}  // namespace
}  // namespace rayshoot
