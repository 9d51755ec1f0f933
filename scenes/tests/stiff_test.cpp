#include <gmock/gmock.h>

#include <numbers>
#include <set>

#include "scenes/core/digest.h"
#include "scenes/core/geometry.h"
#include "scenes/io/mesh.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {
namespace {

const StiffCase& stiff_case(const std::string& id) {
  for (const StiffCase* entry : stiff_cases())
    if (entry->id == id) return *entry;
  throw std::out_of_range(id);
}

std::vector<Ray<double>> rays_of(const StiffSetting& setting, std::size_t count, std::uint64_t first = 0,
                                 std::uint64_t seed = 7) {
  std::vector<Ray<double>> rays(count);
  setting.rays(seed, first, rays);
  return rays;
}

/// The bytes of rays, since not-a-numbers are not equal to themselves.
std::string digest_of(const std::vector<Ray<double>>& rays) {
  Digest digest;
  digest.add_all(rays);
  return digest.hex();
}

/// Call `check(setting)` for every setting of the short form of every case.
template <class Check>
void for_every_setting(const Check& check) {
  for (const StiffCase* entry : stiff_cases())
    for (const StiffSetting& setting : entry->settings(1, 3)) {
      SCOPED_TRACE(entry->id + ": " + setting.label);
      check(setting);
    }
}

bool is_float(double x) { return std::isnan(x) || static_cast<double>(static_cast<float>(x)) == x; }
bool is_float(const Vec3d& p) { return is_float(p.x) && is_float(p.y) && is_float(p.z); }

TEST(Stiff, EveryCaseSaysWhatItIs) {
  std::set<int> numbers;
  for (const StiffCase* entry : stiff_cases()) {
    EXPECT_TRUE(numbers.insert(entry->number).second) << entry->id;
    for (const std::string& text : {entry->title, entry->construction, entry->property, entry->metric})
      EXPECT_FALSE(text.empty()) << entry->id;
  }
}

TEST(Stiff, SettingsHoldTogether) {
  for (const StiffCase* entry : stiff_cases()) {
    const std::vector<StiffSetting> settings = entry->settings(1, 3);
    std::set<std::string> labels, ids;
    EXPECT_GE(settings.size(), 3u) << entry->id;
    for (const StiffSetting& setting : settings) {
      EXPECT_TRUE(labels.insert(setting.label).second) << entry->id << ": " << setting.label;
      EXPECT_THAT(setting.label, testing::HasSubstr("=")) << entry->id;
      EXPECT_THAT(setting.scene->id, testing::StartsWith(entry->id + "(")) << setting.label;
      EXPECT_LE(setting.scene->size(), 6000u) << entry->id << ": " << setting.label;
      EXPECT_GT(setting.default_rays, 0u);
      EXPECT_TRUE(setting.property != Property::same_as_base || setting.base) << setting.label;
      EXPECT_LT(setting.base.value_or(0), settings.size());
    }
  }
}

TEST(Stiff, RaysAreAFunctionOfSeedAndNumber) {
  for_every_setting([](const StiffSetting& setting) {
    const auto whole = rays_of(setting, 64, 1000);
    std::vector<Ray<double>> pieces = rays_of(setting, 7, 1000);
    for (const auto& [first, count] : {std::pair{1007, 1}, {1008, 56}})
      for (const Ray<double>& ray : rays_of(setting, count, first)) pieces.push_back(ray);
    EXPECT_EQ(digest_of(whole), digest_of(pieces));
    EXPECT_EQ(digest_of(whole), digest_of(rays_of(setting, 64, 1000)));
  });
}

TEST(Stiff, ScenesAreAFunctionOfTheSeed) {
  for (const StiffCase* entry : stiff_cases()) {
    const auto first = entry->settings(1, 3), second = entry->settings(1, 3);
    for (std::size_t i = 0; i < first.size(); ++i)
      EXPECT_EQ(scene_hash(*first[i].scene), scene_hash(*second[i].scene)) << first[i].scene->id;
  }
}

TEST(Stiff, NumbersAreFloats) {
  for_every_setting([](const StiffSetting& setting) {
    for (const Ray<double>& ray : rays_of(setting, 200)) {
      EXPECT_TRUE(is_float(ray.origin) && is_float(ray.direction) && is_float(ray.t_min));
      EXPECT_TRUE(is_float(ray.t_max) || ray.t_max == std::numeric_limits<double>::max());
    }
    for (const auto& [a, b, c] : setting.scene->triangles)
      EXPECT_TRUE(is_float(a) && is_float(b) && is_float(c));
    for (const Vec3d& vertex : setting.scene->polygon_vertices) EXPECT_TRUE(is_float(vertex));
    for (const auto& [centre, radius] : setting.scene->spheres)
      EXPECT_TRUE(is_float(centre) && is_float(radius));
    for (const Cone<double>& cone : setting.scene->cones)
      EXPECT_TRUE(is_float(cone.base) && is_float(cone.apex) && is_float(cone.base_radius) &&
                  is_float(cone.apex_radius));
  });
}

// ---------------------------------------------------------------- closed meshes

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

std::vector<Vec3d> vertices_of(const Scene& scene) {
  std::vector<Vec3d> vertices;
  for (const auto& [a, b, c] : scene.triangles) vertices.insert(vertices.end(), {a, b, c});
  return vertices;
}

double distance_to_nearest(const std::vector<Vec3d>& points, const Vec3d& p) {
  double nearest = kMiss<double>;
  for (const Vec3d& q : points) nearest = std::min(nearest, length(q - p));
  return nearest;
}

class ClosedMeshes : public testing::TestWithParam<const char*> {};

TEST_P(ClosedMeshes, AreClosedAndSeenFromInside) {
  for (const StiffSetting& setting : stiff_case(GetParam()).settings(1, 3)) {
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
  for (const StiffSetting& setting : stiff_case("closed_vertex").settings(1, 3)) {
    const auto vertices = vertices_of(*setting.scene);
    const auto rays = rays_of(setting, 50);
    for (std::size_t i = 0; i < rays.size(); ++i)
      EXPECT_LE(distance_to_nearest(vertices, rays[i].at(1)), i % 2 == 0 ? 0 : 2e-7) << setting.label;
  }
}

TEST(ClosedEdge, EvenRaysMeetAMidpointExactly) {
  for (const StiffSetting& setting : stiff_case("closed_edge").settings(1, 3)) {
    std::vector<Vec3d> midpoints;
    for (const auto& [a, b, c] : setting.scene->triangles)
      for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) midpoints.push_back((from + to) * 0.5);
    const auto rays = rays_of(setting, 50);
    for (std::size_t i = 0; i < rays.size(); i += 2)
      EXPECT_EQ(distance_to_nearest(midpoints, rays[i].at(1)), 0) << setting.label;
  }
}

TEST(Fan, RaysMeetTheHubOfAllTriangles) {
  for (const StiffSetting& setting : stiff_case("fan").settings(1, 3)) {
    EXPECT_EQ(setting.scene->size(), static_cast<std::size_t>(setting.stiffness_parameter));
    const Vec3d hub = setting.scene->triangles[0].a;
    for (const Triangle<double>& triangle : setting.scene->triangles) EXPECT_EQ(triangle.a, hub);
    const auto rays = rays_of(setting, 50);
    for (std::size_t i = 0; i < rays.size(); ++i)
      EXPECT_LE(length(rays[i].at(1) - hub), i % 2 == 0 ? 0 : 2e-7) << setting.label;
  }
}

}  // namespace
}  // namespace rayshoot
