// What makes bounding_volumes that technique.
#include <gtest/gtest.h>

#include <numbers>

#include "accel/parts/volume_kinds.h"
#include "accel/tests/built_engine.h"
#include "accel/tests/conformance.h"
#include "scenes/core/affine.h"
#include "scenes/io/load_scene.h"

namespace rayshoot {
namespace {

std::unique_ptr<Engine<double>> bounded(const Geometry<double>& geometry, const char* combination,
                                        const char* fit = "enclosed_volume") {
  return build("bounding_volumes", geometry, {{"combination", combination}, {"fit", fit}});
}

/// Shapes that no single volume fits: slanted cones with a thick and a thin end, and slanted triangles.
Scene slanted_scene() {
  SceneBuilder builder;
  for (int i = 0; i < 6; ++i) {
    const Affine turn = rotation(normalized(Vec3d{1, 2, i * 0.7}), 0.4 + i);
    builder.cone(turn({4.0 * i, 0, 0}), 1, turn({4.0 * i, 0, 3}), 0.05);
    builder.triangle(turn({4.0 * i, 5, 0}), turn({4.0 * i + 3, 5, 0.2}), turn({4.0 * i, 6, 3}));
  }
  return std::move(builder).finish();
}

TEST(BoundingVolumes, AnswersAsExhaustiveSearchHoweverTheVolumesAreCombined) {
  std::vector<Scene> scenes{slanted_scene(), soup_scene(100)};
  for (const char* spec : {"balls:1", "gears:1", "tree:3", "teapot:2"})
    scenes.push_back(load_scene(spec).scene);
  for (const Scene& scene : scenes) {
    const Geometry<double> geometry(scene);
    const auto rays = nasty::rays(geometry, 1, 20);
    const auto truths = conformance::truths<double>(geometry, rays);
    for (const char* combination : {"single", "intersection", "union"})
      for (const char* fit : {"enclosed_volume", "projected_area"})
        conformance::check_engine<double>(*bounded(geometry, combination, fit), rays, truths);
    for (const char* kind : kVolumeKindNames)
      for (const char* combination : {"single", "union"})
        conformance::check_engine<double>(
            *build("bounding_volumes", geometry, {{"combination", combination}, {"volumes", kind}}), rays,
            truths);
  }
}

TEST(BoundingVolumes, ChoosesTheLeastVolumeTimesComplexity) {
  for (const char* spec : {"gears:1", "tree:4", "balls:1"}) {
    const Geometry<double> geometry(load_scene(spec).scene);
    std::array<double, 4> expected{};
    for (std::uint32_t object = 0; object < geometry.size(); ++object) {
      const auto volumes = bounding_volumes<double>(geometry, std::array{object});
      std::size_t best = 0;
      for (std::size_t kind = 1; kind < 4; ++kind)
        if (volumes[kind].enclosed_volume() * kVolumeTestCost[kind] <
            volumes[best].enclosed_volume() * kVolumeTestCost[best])
          best = kind;
      ++expected[best];
    }
    const auto figures = bounded(geometry, "single")->structure().figures;
    for (std::size_t kind = 0; kind < 4; ++kind)
      EXPECT_EQ(figures.at(kVolumeKindNames[kind] + std::string("_volumes")), expected[kind]) << spec;
  }
}

TEST(BoundingVolumes, TheCheapestKindThatFitsIsTaken) {
  SceneBuilder builder;
  builder.sphere({0, 0, 0}, 1);
  const Affine turn = rotation(normalized(Vec3d{1, 2, 3}), 0.8);
  builder.cone(turn({5, 0, 0}), 0.3, turn({5, 0, 4}), 0.3);
  builder.polygon(std::array{Vec3d{9, 0, 0}, Vec3d{9, 2, 0}, Vec3d{9, 2, 2}, Vec3d{9, 0, 2}});
  builder.polygon(std::array{turn({13, 0, 0}), turn({13, 4, 0}), turn({13, 4, 2}), turn({13, 0, 2})});
  const Geometry<double> geometry(std::move(builder).finish());
  const auto figures = bounded(geometry, "single")->structure().figures;
  for (const char* kind : kVolumeKindNames) EXPECT_EQ(figures.at(kind + std::string("_volumes")), 1) << kind;
}

/// Rays for which turned volumes are tested: others meet them all.
std::vector<Ray<double>> measurable_rays(const Geometry<double>& geometry) {
  auto rays = nasty::rays(geometry, 1, 60);
  std::erase_if(rays, [](const Ray<double>& ray) { return !is_measurable(ray); });
  return rays;
}

Work strict_work(const Geometry<double>& geometry, const std::vector<Ray<double>>& rays,
                 const char* combination) {
  return counted(*bounded(geometry, combination, "projected_area"), Query::strict, rays).work;
}

/// Cost of a composite (§4.1): a ray that misses the first volume of an intersection is done with it, one that hits the
/// first of a union likewise.
TEST(BoundingVolumes, ASecondVolumeIsTestedOnlyWhereTheFirstLeavesItOpen) {
  const Geometry<double> geometry(slanted_scene());
  const auto rays = measurable_rays(geometry);
  const std::uint64_t once = rays.size() * geometry.size();
  const Work single = strict_work(geometry, rays, "single");
  EXPECT_EQ(single.volume_tests, once);

  // Every object here has a second volume, behind the one that it has alone.
  EXPECT_EQ(bounded(geometry, "intersection", "projected_area")->structure().nodes, 2 * geometry.size());
  const Work both = strict_work(geometry, rays, "intersection");
  EXPECT_EQ(both.volume_tests, once + single.object_tests);

  // Of the halves of an object the second is tested where the first is missed.
  const std::uint64_t halved =
      bounded(geometry, "union", "projected_area")->structure().nodes - geometry.size();
  const Work either = strict_work(geometry, rays, "union");
  EXPECT_GT(halved, 0u);
  EXPECT_GT(either.volume_tests, once);
  EXPECT_LT(either.volume_tests, once + rays.size() * halved);
}

TEST(BoundingVolumes, CompositesFitBetter) {
  const Geometry<double> geometry(slanted_scene());
  const auto rays = measurable_rays(geometry);
  const auto single = bounded(geometry, "single", "projected_area");
  const auto both = bounded(geometry, "intersection", "projected_area");
  for (const Ray<double>& ray : rays) {
    const auto all = candidates(*single, Query::strict, ray), fewer = candidates(*both, Query::strict, ray);
    EXPECT_TRUE(std::includes(all.begin(), all.end(), fewer.begin(), fewer.end()));
  }
  const std::uint64_t alone = strict_work(geometry, rays, "single").object_tests;
  EXPECT_LT(strict_work(geometry, rays, "intersection").object_tests, alone);
  EXPECT_LT(strict_work(geometry, rays, "union").object_tests, alone);
}

TEST(BoundingVolumes, ReportsTheVoidAreaOfAnObject) {
  SceneBuilder ball, square;
  ball.sphere({1, 2, 3}, 2);
  square.polygon(std::array{Vec3d{0, 0, 0}, Vec3d{1, 0, 1}, Vec3d{1, 1, 1}, Vec3d{0, 1, 0}});
  const Geometry<double> balls(std::move(ball).finish()), squares(std::move(square).finish());
  const auto void_area = [](const Geometry<double>& geometry, const char* kind) {
    return build("bounding_volumes", geometry, {{"volumes", kind}})
        ->structure()
        .figures.at("void_area_per_object");
  };
  constexpr double kPi = std::numbers::pi;
  EXPECT_NEAR(void_area(balls, "sphere"), 0, 1e-9);
  EXPECT_NEAR(void_area(balls, "axis_box"), 24 - 4 * kPi, 1e-9);
  EXPECT_NEAR(void_area(squares, "oriented_box"), 0, 1e-9);
  EXPECT_NEAR(void_area(squares, "axis_box"), 6.0 / 4 - std::sqrt(2.0) / 2, 1e-9);
}

TEST(BoundingVolumes, AnIntersectionOfOneKindIsRefused) {
  const Geometry<double> geometry(soup_scene(3));
  EXPECT_THROW(build("bounding_volumes", geometry, {{"combination", "intersection"}, {"volumes", "sphere"}}),
               InputError);
}

}  // namespace
}  // namespace rayshoot
