#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "scenes/core/geometry.h"
#include "scenes/core/needs.h"
#include "scenes/core/scene_builder.h"
#include "scenes/core/spec.h"
#include "scenes/core/stiffness.h"
#include "scenes/io/load_scene.h"
#include "scenes/io/mesh.h"
#include "scenes/io/nff.h"
#include "scenes/rays/times.h"

namespace rayshoot {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::shared_ptr<const Scene> shared(SceneBuilder&& builder) {
  return std::make_shared<const Scene>(std::move(builder).finish());
}

/// Two triangles across the z axis, at 0 and 1, of materials of their own.
std::shared_ptr<const Scene> two_triangles() {
  SceneBuilder builder;
  builder.material({.colour = {1, 0, 0}});
  builder.triangle({-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
  builder.material({.colour = {0, 1, 0}, .specular = 0.5});
  builder.triangle({-1, -1, 1}, {1, -1, 1}, {0, 1, 1});
  return shared(std::move(builder));
}

/// A sphere, the part twice, and a part of the part.
Scene nested(const Vec3d& velocity = {}) {
  SceneBuilder inner;
  inner.place(two_triangles(), translation({0, 0, 8}));
  const auto part = two_triangles();
  SceneBuilder builder;
  builder.sphere({0, 0, -4}, 1);
  builder.place(part, translation({4, 0, 0}), velocity);
  builder.place(part, scaling(2));
  builder.place(shared(std::move(inner)), translation({0, 0, 2}));
  return std::move(builder).finish();
}

Ray<double> down(double x, double time = 0) {
  return {.origin = {x, 0, 100}, .direction = {0, 0, -1}, .time = time};
}

TEST(Placement, NumbersTheObjectsOfPartsOneByOne) {
  const Scene scene = nested();
  EXPECT_EQ(scene.size(), 4u);
  EXPECT_EQ(scene.numbers(), 7u);
  EXPECT_EQ(scene.counts(), (ObjectCounts{6, 0, 1, 0, 4}));
  EXPECT_EQ(scene.material_of(3).colour, (Vec3d{1, 0, 0}));
  EXPECT_EQ(scene.material_of(6).colour, (Vec3d{0, 1, 0}));
  const Geometry<double> geometry(scene);
  EXPECT_EQ(geometry.size(), 4u);
  EXPECT_EQ(geometry.numbers(), 7u);
  for (std::uint32_t number = 0; number < 7; ++number) EXPECT_EQ(geometry.scene_number(number), number);
}

TEST(Placement, TestsObjectsWhereTheyArePlaced) {
  const Geometry<double> geometry(nested());
  const std::array expected = {105.0 - 2, 100.0, 99.0, 100.0, 98.0, 90.0, 89.0};
  for (std::uint32_t number = 0; number < 7; ++number)
    EXPECT_DOUBLE_EQ(geometry.hit_distance_of_number(number, down(number == 1 || number == 2 ? 4 : 0)),
                     expected[number])
        << number;
  EXPECT_EQ(geometry.hit_distance_of_number(1, down(0)), kMiss<double>);
  // Of a part as one object, the nearest of its hits.
  EXPECT_DOUBLE_EQ(geometry.hit_distance(2, down(0)), 98);
}

TEST(Placement, BoundsWhatIsPlacedOverAllTimes) {
  const Scene scene = nested({0, 16, 0});
  const Box<double> box = scene.bounds();
  EXPECT_EQ(box.lo, (Vec3d{-2, -2, -5}));
  EXPECT_EQ(box.hi, (Vec3d{5, 17, 11}));
  const Geometry<double> geometry(scene);
  EXPECT_TRUE(geometry.bounds().contains(box));
  EXPECT_LT(geometry.bounds(1, 0, 0).hi.y, 1.1);
  EXPECT_GT(geometry.bounds(1, 0.5, 0.5).lo.y, 6.9);
}

TEST(Placement, MovesWithTheTimeOfTheRay) {
  const Geometry<double> geometry(nested({8, 0, 0}));
  EXPECT_TRUE(geometry.moves());
  EXPECT_FALSE(Geometry<double>(nested()).moves());
  EXPECT_DOUBLE_EQ(geometry.hit_distance_of_number(1, down(4, 0)), 100);
  EXPECT_EQ(geometry.hit_distance_of_number(1, down(4, 1)), kMiss<double>);
  EXPECT_DOUBLE_EQ(geometry.hit_distance_of_number(1, down(12, 1)), 100);
  EXPECT_DOUBLE_EQ(geometry.hit_distance_of_number(1, down(8, 0.5)), 100);
}

TEST(Placement, TurnsNormalsBack) {
  SceneBuilder part;
  part.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  SceneBuilder builder;
  // Turned about x, then stretched along y: the normal (0, -1, 1) before it becomes (0, -1, 2).
  const double q = std::sqrt(0.5);
  const Affine turned{{1, 0, 0}, {0, q, -q}, {0, q, q}, {}};
  builder.place(shared(std::move(part)), compose(Affine{{1, 0, 0}, {0, 2, 0}, {0, 0, 1}, {3, 3, 3}}, turned));
  const Vec3d normal = surface_normal(std::move(builder).finish(), 0, {3, 3, 3});
  EXPECT_NEAR(normal.y, -1 / std::sqrt(5.0), 1e-12);
  EXPECT_NEAR(normal.z, 2 / std::sqrt(5.0), 1e-12);
}

TEST(Placement, UndoesMaps) {
  const Affine map{{2, 1, 0}, {0, 3, -1}, {1, 0, 4}, {5, 6, 7}};
  const Vec3d point{0.25, -2, 9}, back = inverse(map)(map(point));
  EXPECT_LT(length(back - point), 1e-13);
}

TEST(Placement, SetsAsideWhatCannotBePlaced) {
  const auto reason = [](std::shared_ptr<const Scene> part, const Affine& place, const Vec3d& velocity = {}) {
    SceneBuilder builder;
    builder.sphere({0, 0, 0}, 1);
    builder.place(std::move(part), place, velocity);
    const Geometry<float> geometry(std::move(builder).finish());
    // What is good stays.
    EXPECT_EQ(geometry.numbers(), 1u);
    return geometry.set_aside().empty() ? "" : geometry.set_aside().back().reason;
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(reason(two_triangles(), scaling(0)), "its place cannot be undone");
  EXPECT_EQ(reason(two_triangles(), scaling(nan)), "its place cannot be undone");
  EXPECT_EQ(reason(two_triangles(), translation({infinity, 0, 0})), "its place cannot be undone");
  EXPECT_EQ(reason(two_triangles(), translation({1e38, 0, 0})), "out of range");
  EXPECT_EQ(reason(two_triangles(), {}, {nan, 0, 0}), "not finite");
  EXPECT_EQ(reason(shared(SceneBuilder()), {}), "its part has nothing that can be traced");
}

TEST(Placement, SaysOnceWhatIsWrongWithinAPart) {
  SceneBuilder broken;
  broken.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  broken.triangle({0, 0, 0}, {0, 0, 0}, {0, 0, 0});
  const auto part = shared(std::move(broken));
  SceneBuilder builder;
  for (double x = 0; x < 5; ++x) builder.place(part, translation({x, 0, 0}));
  const Geometry<double> geometry(std::move(builder).finish());
  ASSERT_EQ(geometry.set_aside().size(), 1u);
  EXPECT_EQ(geometry.set_aside()[0].scene_number, 1u);
  EXPECT_EQ(geometry.numbers(), 5u);
  EXPECT_EQ(geometry.scene_number(3), 6u);
}

TEST(Placement, StoresAPartOnce) {
  const auto bytes = [](int size) {
    return Geometry<float>(load_scene(fmt::format("grass:{}", size)).scene).bytes();
  };
  EXPECT_LT(bytes(4), 100'000u);
  EXPECT_EQ(load_scene("grass:4").scene.numbers(), 2'500'000'001u);
}

TEST(Placement, RefusesMoreObjectsThanHitsTellApart) {
  EXPECT_THAT([] { load_scene("grass:5"); }, ThrowsMessage<InputError>(HasSubstr("hits tell at most")));
  SceneBuilder builder;
  const auto part = std::make_shared<const Scene>(load_scene("grass:4").scene);
  builder.place(part, {}), builder.place(part, {});
  EXPECT_THROW(std::move(builder).finish(), InputError);
}

TEST(Placement, IsContent) {
  EXPECT_TRUE(same_content(nested(), nested()));
  EXPECT_EQ(scene_hash(nested()), scene_hash(nested()));
  EXPECT_FALSE(same_content(nested(), nested({1, 0, 0})));
  EXPECT_NE(scene_hash(nested()), scene_hash(nested({1, 0, 0})));
  // The same parts, the other one placed.
  const auto with = [](bool second) {
    SceneBuilder sphere, triangle, builder;
    sphere.sphere({0, 0, 0}, 1);
    triangle.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const std::array parts = {shared(std::move(sphere)), shared(std::move(triangle))};
    builder.place(parts[0], {}), builder.place(parts[1], {}), builder.place(parts[second], {});
    return std::move(builder).finish();
  };
  EXPECT_FALSE(same_content(with(false), with(true)));
  EXPECT_NE(scene_hash(with(false)), scene_hash(with(true)));
}

TEST(Placement, TessellatesPartsOnce) {
  const Scene scene = tessellated(load_scene("swarm:2").scene, 1);
  EXPECT_EQ(distinct_parts(scene).size(), 3u);
  EXPECT_EQ(scene.counts()[static_cast<int>(ObjectKind::sphere)], 0u);
  EXPECT_EQ(scene.numbers(), load_scene("swarm:2/patches(tessellation=1)").scene.numbers());
}

TEST(Placement, CannotBeWrittenToFiles) {
  std::ostringstream out;
  EXPECT_THAT([&] { write_nff(nested(), out); }, ThrowsMessage<InputError>(HasSubstr("parts are placed")));
  EXPECT_THAT([] { write_mesh(nested(), "no.obj", 3); },
              ThrowsMessage<InputError>(HasSubstr("parts are placed")));
  EXPECT_FALSE(std::ifstream("no.obj"));
}

TEST(Placement, IsANeedOfTheScene) {
  const SceneNeeds still = needs_of(nested()), moving = needs_of(nested({1, 0, 0})),
                   flat = needs_of(*two_triangles());
  EXPECT_TRUE(still.placed_parts && !still.motion && still.reflected_rays && still.curved_objects);
  EXPECT_TRUE(moving.placed_parts && moving.motion);
  EXPECT_FALSE(flat.placed_parts || flat.motion);
}

TEST(Placement, ScalesTheSmallestFeature) {
  SceneBuilder builder;
  builder.place(two_triangles(), scaling(0.25));
  EXPECT_NEAR(*smallest_feature(std::move(builder).finish()), 0.25 * *smallest_feature(*two_triangles()),
              1e-12);
}

TEST(Times, AreDrawnWhereSomethingMoves) {
  std::vector<Ray<double>> rays(1000);
  set_times(rays, nested(), 1);
  for (const Ray<double>& ray : rays) EXPECT_EQ(ray.time, 0);
  set_times(rays, nested({1, 0, 0}), 1);
  double sum = 0;
  for (const Ray<double>& ray : rays) {
    EXPECT_TRUE(ray.time >= 0 && ray.time <= 1);
    sum += ray.time;
  }
  EXPECT_NEAR(sum / 1000, 0.5, 0.05);
}

}  // namespace
}  // namespace rayshoot
