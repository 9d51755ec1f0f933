#include <gtest/gtest.h>

#include "scenes/core/geometry.h"
#include "scenes/tests/stiff_settings.h"

namespace rayshoot {
namespace {

/// All numbers of a scene's objects: those of points, which translation changes, and radii.
struct Numbers {
  std::vector<Vec3d> points;
  std::vector<double> radii;
};

Numbers numbers_of(const Scene& scene) {
  Numbers numbers{vertices_of(scene), {}};
  numbers.points.insert(numbers.points.end(), scene.polygon_vertices.begin(), scene.polygon_vertices.end());
  for (const Sphere<double>& sphere : scene.spheres)
    numbers.points.push_back(sphere.centre), numbers.radii.push_back(sphere.radius);
  for (const Cone<double>& cone : scene.cones) {
    numbers.points.insert(numbers.points.end(), {cone.base, cone.apex});
    numbers.radii.insert(numbers.radii.end(), {cone.base_radius, cone.apex_radius});
  }
  return numbers;
}

/// Expect scene and rays of a setting to be those of its base, points mapped by `map`, radii and directions scaled.
template <class Map>
void expect_image(const StiffSetting& setting, const StiffSetting& base, const Map& map, double radius_scale,
                  double direction_scale) {
  SCOPED_TRACE(setting.label);
  const Numbers image = numbers_of(*setting.scene), original = numbers_of(*base.scene);
  ASSERT_EQ(image.points.size(), original.points.size());
  for (std::size_t i = 0; i < image.points.size(); ++i) EXPECT_EQ(image.points[i], map(original.points[i]));
  for (std::size_t i = 0; i < image.radii.size(); ++i)
    EXPECT_EQ(image.radii[i], original.radii[i] * radius_scale);
  const auto rays = rays_of(setting, 50), base_rays = rays_of(base, 50);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(rays[i].origin, map(base_rays[i].origin));
    EXPECT_EQ(rays[i].direction, base_rays[i].direction * direction_scale);
  }
}

TEST(Shift, IsATranslationToTheLastBit) {
  const auto settings = settings_of("shift");
  EXPECT_EQ(settings.back().label, "k=24");
  for (std::size_t i = 1; i < settings.size(); ++i) {
    const double shift = std::ldexp(1, std::stoi(settings[i].label.substr(2)));
    expect_image(
        settings[i], settings[0],
        [&](const Vec3d& p) {
          return p + Vec3d{shift, shift, shift};
        },
        1, 1);
  }
}

TEST(ScaleDyadic, ChangesNothingButExponents) {
  const auto settings = settings_of("scale_dyadic");
  for (const StiffSetting& setting : settings) {
    const double scale = std::ldexp(1, static_cast<int>(setting.stiffness_parameter));
    EXPECT_EQ(setting.t_scale, scale);
    expect_image(
        setting, settings[0], [&](const Vec3d& p) { return p * scale; }, scale, 1);
  }
}

TEST(ScaleDyadic, IsTracedAsAWholeOrRefusedAsAWhole) {
  for (const StiffSetting& setting : settings_of("scale_dyadic")) {
    const Geometry<float> geometry(*setting.scene);
    EXPECT_TRUE(geometry.set_aside().empty() || geometry.size() == 0) << setting.label;
    for (const SetAside& object : geometry.set_aside()) EXPECT_EQ(object.reason, "out of range");
    EXPECT_EQ(Geometry<double>(*setting.scene).set_aside().size(), 0u) << setting.label;
  }
}

TEST(ScaleDecimal, RoundsAScaledSceneOnce) {
  const auto settings = settings_of("scale_decimal");
  const Numbers original = numbers_of(*setting_of(settings, "k=0").scene);
  for (const StiffSetting& setting : settings) {
    const Numbers image = numbers_of(*setting.scene);
    for (std::size_t i = 0; i < image.points.size(); ++i)
      EXPECT_EQ(image.points[i],
                Vec3d(Vec3<float>(original.points[i] * std::pow(10, setting.stiffness_parameter))));
  }
}

TEST(DirScale, ScalesDirectionsAlone) {
  const auto settings = settings_of("dir_scale");
  for (const StiffSetting& setting : settings) {
    const double scale = std::ldexp(1, static_cast<int>(setting.stiffness_parameter));
    EXPECT_EQ(setting.t_scale, 1 / scale);
    expect_image(
        setting, settings[0], [](const Vec3d& p) { return p; }, 1, scale);
  }
}

TEST(Denormal, NumbersAreBelowTheSmallestNormalFloatAndExact) {
  const auto settings = settings_of("denormal");
  constexpr double kSmallestNormal = std::numeric_limits<float>::min();
  const StiffSetting& both = setting_of(settings, "coordinates=2^-129,directions=2^-129");
  const double scale = 0x1p-129;
  expect_image(
      both, settings[0], [&](const Vec3d& p) { return p * scale; }, scale, scale);
  for (const Vec3d& p : numbers_of(*both.scene).points) EXPECT_LT(max_abs(p), kSmallestNormal);
  for (const Ray<double>& ray : rays_of(both, 50))
    EXPECT_LT(std::max(max_abs(ray.origin), max_abs(ray.direction)), kSmallestNormal);
  const StiffSetting& fast = setting_of(settings, "coordinates=2^-4,directions=2^-129");
  EXPECT_EQ(fast.t_scale, 0x1p125);
  expect_image(
      fast, settings[0], [](const Vec3d& p) { return p * 0x1p-4; }, 0x1p-4, scale);
}

TEST(Huge, ReachesAQuarterOfTheLargestFloatAroundObjectsOfUnitSize) {
  const auto settings = settings_of("huge");
  const Box<double> box = settings.back().scene->bounds();
  EXPECT_EQ(max_abs(box.hi), 0x1p126);
  EXPECT_NEAR(0x1p126 / (std::numeric_limits<float>::max() / 4), 1, 1e-6);
  for (const StiffSetting& setting : settings) {
    EXPECT_EQ(setting.scene->size(), settings[0].scene->size());
    EXPECT_LT(max_abs(setting.scene->triangles.back().a), 1);
  }
}

TEST(Garbage, IsAmongTheGoodAndRaysAreAsTheirLabelSays) {
  const auto settings = settings_of("garbage");
  const auto& good = setting_of(settings, "objects=good,rays=good").scene->triangles;
  const auto& all = setting_of(settings, "objects=garbage,rays=good").scene->triangles;
  EXPECT_NE(std::search(all.begin(), all.end(), good.begin(), good.end()), all.end());
  const auto finite = [](const Vec3d& p) { return is_finite(p); };
  std::size_t garbage = 0;
  for (const Vec3d& vertex : vertices_of(*settings[1].scene)) garbage += !finite(vertex);
  EXPECT_GT(garbage, 0u);
  for (const StiffSetting& setting : settings)
    for (const Ray<double>& ray : rays_of(setting, 200))
      EXPECT_EQ(finite(ray.origin) && finite(ray.direction), !setting.label.ends_with("not_finite"))
          << setting.label;
}

TEST(Degenerate, ScenesOfNothingsAreSetAsideWhole) {
  for (const StiffSetting& setting : settings_of("degenerate")) {
    const Geometry<float> geometry(*setting.scene);
    const bool nothing = setting.property == Property::never_hit && setting.label != "rays=without_direction";
    EXPECT_EQ(geometry.size() == 0, nothing) << setting.label;
    const bool flat = setting.label == "shape=flat";
    EXPECT_EQ(!nothing && setting.scene->bounds().extent().z == 0, flat) << setting.label;
    const auto rays = rays_of(setting, 20);
    const bool no_direction = std::all_of(rays.begin(), rays.end(),
                                          [](const Ray<double>& ray) { return ray.direction == Vec3d{}; });
    EXPECT_EQ(no_direction, setting.label == "rays=without_direction");
  }
}

std::size_t negative_zeros(const std::vector<Vec3d>& points) {
  std::size_t count = 0;
  for (const Vec3d& p : points)
    for (int axis = 0; axis < 3; ++axis) count += p[axis] == 0 && std::signbit(p[axis]);
  return count;
}

TEST(SignedZero, TurnsTheSignOfZerosAndNothingElse) {
  const auto settings = settings_of("signed_zero");
  for (const StiffSetting& setting : settings) {
    expect_image(
        setting, settings[0], [](const Vec3d& p) { return p; }, 1, 1);
    std::vector<Vec3d> origins, directions;
    for (const Ray<double>& ray : rays_of(setting, 100))
      origins.push_back(ray.origin), directions.push_back(ray.direction);
    const bool all = setting.label == "negative=all";
    EXPECT_EQ(negative_zeros(origins) > 20, all || setting.label == "negative=origins");
    EXPECT_EQ(negative_zeros(directions) > 20, all || setting.label == "negative=directions");
    EXPECT_EQ(negative_zeros(vertices_of(*setting.scene)) > 20, all || setting.label == "negative=vertices");
  }
}

}  // namespace
}  // namespace rayshoot
