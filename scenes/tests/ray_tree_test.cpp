#include "scenes/rays/ray_tree.h"

#include <gmock/gmock.h>

#include <numbers>

#include "scenes/core/scene_builder.h"
#include "scenes/rays/load_rays.h"
#include "scenes/rays/optics.h"
#include "scenes/tests/exhaustive_tracer.h"

namespace rayshoot {
namespace {

constexpr Material kMatt{.diffuse = 1};
constexpr Material kMirror{.diffuse = 0, .specular = 1};
constexpr Material kGlass{.diffuse = 0, .transmittance = 1, .index_of_refraction = 1.5};

void square(SceneBuilder& builder, double z, double half = 10) {
  builder.polygon(
      std::array{Vec3d{-half, -half, z}, Vec3d{half, -half, z}, Vec3d{half, half, z}, Vec3d{-half, half, z}});
}

RayCounts counts_of(const Scene& scene, const std::string& spec) {
  const RaySpec rays = resolve_rays(spec);
  return make_rays(rays, scene, ExhaustiveTracer(scene, rays.cone_sides()), 1).counts;
}

double angle_to(const Vec3d& a, const Vec3d& b) { return std::acos(dot(a, b)); }

TEST(Camera, OutermostRaysLieOnTheFrustumsEdge) {
  const View view{.from = {0, 0, -5}, .at = {0, 0, 0}, .up = {0, 1, 0}, .angle = 90};
  const auto rays = pixel_rays(view, 3, PixelGrid::edge_to_edge);
  // Seen along +z with y up, right is -x: the first ray is the upper left one.
  const double third = 1 / std::sqrt(3.0);
  EXPECT_NEAR(length(rays[0].direction - Vec3d{third, third, third}), 0, 1e-12);
  EXPECT_NEAR(length(rays[4].direction - Vec3d{0, 0, 1}), 0, 1e-12);
  EXPECT_NEAR(length(rays[8].direction - Vec3d{-third, -third, third}), 0, 1e-12);
}

TEST(Camera, RaysThroughPixelCornersPassHalfAPixelOutsideTheOutermostCentres) {
  const View view{.from = {0, 0, 0}, .at = {0, 0, 1}, .up = {0, 1, 0}, .angle = 90};
  const auto rays = pixel_rays(view, 513, PixelGrid::pixel_corners_512);
  const Vec3d& middle_left = rays[256 * 513].direction;
  EXPECT_NEAR(middle_left.x / middle_left.z, 256 / 255.5, 1e-12);
}

TEST(Camera, SurvivesAViewWithoutADirection) {
  for (const View& view :
       {View{.from = {1, 1, 1}, .at = {1, 1, 1}}, View{.from = {0, 0, 0}, .at = {0, 1, 0}}})
    for (const Ray<double>& ray : pixel_rays(view, 3, PixelGrid::edge_to_edge))
      EXPECT_NEAR(length(ray.direction), 1, 1e-12);
}

TEST(Optics, RefractionObeysSnellsLaw) {
  const Vec3d outward{0, 0, 1};
  for (const double degrees : {0.0, 10.0, 40.0, 80.0}) {
    const double incidence = degrees * std::numbers::pi / 180;
    const Vec3d entering{std::sin(incidence), 0, -std::cos(incidence)};
    const auto inside = refracted(entering, outward, 1.5);
    ASSERT_TRUE(inside);
    EXPECT_NEAR(std::sin(angle_to(*inside, -outward)), std::sin(incidence) / 1.5, 1e-12);
    // The way out is the way in reversed.
    const auto outside = refracted(-*inside, outward, 1.5);
    ASSERT_TRUE(outside);
    EXPECT_NEAR(length(*outside + entering), 0, 1e-12);
  }
}

TEST(Optics, BeyondTheCriticalAngleNothingLeaves) {
  const double critical = std::asin(1 / 1.5);
  const auto leaving = [](double angle) { return Vec3d{std::sin(angle), 0, std::cos(angle)}; };
  EXPECT_TRUE(refracted(leaving(critical - 1e-6), {0, 0, 1}, 1.5));
  EXPECT_FALSE(refracted(leaving(critical + 1e-6), {0, 0, 1}, 1.5));
}

TEST(Optics, ReflectionDoesNotDependOnTheSideOfTheNormal) {
  const Vec3d incoming = normalized(Vec3d{1, 2, -3}), expected = normalized(Vec3d{1, 2, 3});
  EXPECT_NEAR(length(reflected(incoming, {0, 0, 1}) - expected), 0, 1e-12);
  EXPECT_NEAR(length(reflected(incoming, {0, 0, -1}) - expected), 0, 1e-12);
}

TEST(RayTree, FacingMirrorsReflectUntilTheFifthGeneration) {
  SceneBuilder builder;
  builder.view({.from = {0, 0, 0}, .at = {0, 0, 1}, .up = {0, 1, 0}, .angle = 1});
  builder.light({0, 0, 0.5});
  builder.material(kMirror);
  square(builder, 1), square(builder, -1);
  const RayCounts counts = counts_of(std::move(builder).finish(), "whitted@3");
  EXPECT_EQ(counts.primary_rays, 9u);
  EXPECT_EQ(counts.primary_hits, 9u);
  EXPECT_EQ(counts.reflected_rays, 4u * 9);
  EXPECT_EQ(counts.secondary_hits, 4u * 9);
  // Every hit sees the light, that of the last generation too.
  EXPECT_EQ(counts.shadow_rays, 5u * 9);
  EXPECT_EQ(counts.shadow_hits, 0u);
}

TEST(RayTree, GlassReflectsAndRefractsAndBlocksLight) {
  SceneBuilder builder;
  builder.view({.from = {0, 0, -3}, .at = {0, 0, 0}, .up = {0, 1, 0}, .angle = 1});
  builder.light({0, 0, -10});
  builder.material(kGlass);
  builder.sphere({0, 0, 0}, 1);
  const RayCounts counts = counts_of(std::move(builder).finish(), "whitted@3");
  // Near the axis: the tree enters, and at each of the three inner hits splits into a ray out and a ray in.
  EXPECT_EQ(counts.reflected_rays, 9u * (1 + 1 + 1 + 1));
  EXPECT_EQ(counts.refracted_rays, 9u * (1 + 1 + 1 + 1));
  EXPECT_EQ(counts.secondary_hits, 9u * (1 + 1 + 1 + 1));
  // Light comes from the eye's side: the outer hit sees it. At the inner hits the normal faces inward, and
  // light from that half is blocked by the glass itself: both in front of the far wall, none in front of the
  // near one.
  EXPECT_EQ(counts.shadow_rays, 9u * (1 + 2));
  EXPECT_EQ(counts.shadow_hits, 9u * 2);
}

TEST(RayTree, TotalInternalReflectionCastsNoRefractedRay) {
  SceneBuilder builder;
  builder.view({.from = {0, -0.9, 0}, .at = {1, -0.9, 0}, .up = {0, 0, 1}, .angle = 1});
  builder.material(kGlass);
  builder.sphere({0, 0, 0}, 1);
  const RayCounts counts = counts_of(std::move(builder).finish(), "whitted@3");
  EXPECT_EQ(counts.refracted_rays, 0u);
  EXPECT_EQ(counts.total_internal_reflections, 4u * 9);
  EXPECT_EQ(counts.reflected_rays, 4u * 9);
}

/// A sheet seen from behind, with a light on its outward side and one on the eye's.
Scene sheet_from_behind() {
  SceneBuilder builder;
  builder.view({.from = {0, 0, -5}, .at = {0, 0, 0}, .up = {0, 1, 0}, .angle = 1});
  builder.light({0, 0, 5}), builder.light({0, 0, -5}), builder.light({1, 0, -5});
  builder.material(kMatt);
  square(builder, 0);
  return std::move(builder).finish();
}

TEST(RayTree, CleanRulesLightTheSideThatIsSeenAndHavransTheOutwardSide) {
  EXPECT_EQ(counts_of(sheet_from_behind(), "whitted@3").shadow_rays, 2u * 9);
  EXPECT_EQ(counts_of(sheet_from_behind(), "whitted(rules=haines)@3").shadow_rays, 2u * 9);
  EXPECT_EQ(counts_of(sheet_from_behind(), "whitted(rules=havran)@3").shadow_rays, 1u * 9);
}

TEST(RayTree, HavransRulesOverlookWhatIsNearerThanAHundredth) {
  // The eye looks aslant past a small square that hangs just above the sheet, between it and the light.
  SceneBuilder builder;
  builder.view({.from = {-5, 0, 5}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle = 1e-6});
  builder.light({0, 0, 10});
  builder.material(kMatt);
  square(builder, 0), square(builder, 0.005, 0.001);
  const Scene scene = std::move(builder).finish();
  EXPECT_EQ(counts_of(scene, "whitted@3").shadow_hits, 9u);
  EXPECT_EQ(counts_of(scene, "whitted(rules=haines)@3").shadow_hits, 9u);
  EXPECT_EQ(counts_of(scene, "whitted(rules=havran)@3").shadow_rays, 9u);
  EXPECT_EQ(counts_of(scene, "whitted(rules=havran)@3").shadow_hits, 0u);
}

TEST(RayTree, HavransRulesMeetConesFromOutsideAlone) {
  EXPECT_EQ(resolve_rays("whitted(rules=havran)").cone_sides(), ConeSides::outside);
  EXPECT_EQ(resolve_rays("whitted").cone_sides(), ConeSides::both);
}

TEST(RayTree, HavransConeNormalsTiltByTheBaseRadius) {
  SceneBuilder builder;
  builder.material(kMatt);
  builder.cone({0, 0, 0}, 2, {0, 0, 4}, 1);
  const Scene scene = std::move(builder).finish();
  const Vec3d point{2, 0, 0};
  EXPECT_NEAR(
      length(outward_normal(ray_tree_rules("clean"), scene, 0, point) - normalized(Vec3d{1, 0, 0.25})), 0,
      1e-12);
  EXPECT_NEAR(
      length(outward_normal(ray_tree_rules("havran"), scene, 0, point) - normalized(Vec3d{1, 0, 0.5})), 0,
      1e-12);
}

TEST(RayTree, EpsilonShrinksWithSmallScenesAndGrowsWithFarPoints) {
  const RayTreeRules &clean = ray_tree_rules("clean"), &havran = ray_tree_rules("havran");
  EXPECT_EQ(first_distance(clean, 10, {1, 2, 3}), 1e-7);
  EXPECT_EQ(first_distance(clean, 1e-3, {0, 0, 0}), 1e-10);
  EXPECT_GT(first_distance(clean, 1e12, {1e12, 0, 0}), 1e-4);
  EXPECT_EQ(first_distance(havran, 1e-3, {0, 0, 0}), 0.01);
}

TEST(RayTree, BrokenVertexNormalsGiveSomeUnitNormal) {
  SceneBuilder builder;
  builder.material(kMatt);
  builder.patch({Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{0, 1, 0}}, {Vec3d{}, Vec3d{}, Vec3d{}});
  const Vec3d normal = outward_normal(ray_tree_rules("clean"), std::move(builder).finish(), 0, {0.2, 0.2, 0});
  EXPECT_EQ(normal, (Vec3d{0, 0, 1}));
}

}  // namespace
}  // namespace rayshoot
