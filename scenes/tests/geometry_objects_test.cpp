#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "scenes/core/geometry.h"
#include "scenes/core/scene_builder.h"

namespace rayshoot {
namespace {

constexpr double kInfinity = Box<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

template <class Real>
class GeometryObjects : public ::testing::Test {};

using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(GeometryObjects, Scalars);

using Emit = std::function<void(SceneBuilder&)>;

/// One good object of every kind, side by side along x; rays down -z from (x, 0, 9) meet one each.
const std::vector<Emit> kGoodObjects = {
    [](SceneBuilder& b) {
      b.triangle({-0.5, -0.5, 1}, {0.5, -0.5, 1}, {0, 0.5, 1});
    },
    [](SceneBuilder& b) {
      b.polygon(std::array{Vec3d{1.5, -0.5, 2}, Vec3d{2.5, -0.5, 2}, Vec3d{2.5, 0.5, 2}, Vec3d{1.5, 0.5, 2}});
    },
    [](SceneBuilder& b) {
      b.sphere({4, 0, 2.5}, 0.5);
    },
    [](SceneBuilder& b) {
      b.cone({6, -1, 3.5}, 0.5, {6, 1, 3.5}, 0.5);
    }};

Scene built(const std::vector<Emit>& objects) {
  SceneBuilder builder;
  for (const Emit& emit : objects) emit(builder);
  return std::move(builder).finish();
}

template <class Real>
std::vector<Hit<Real>> nearest_hits(const Geometry<Real>& geometry) {
  std::vector<Hit<Real>> hits;
  for (const Real x : {0, 2, 4, 6, 8}) {
    Hit<Real> nearest;
    for (std::uint32_t object = 0; object < geometry.size(); ++object) {
      const Real t = geometry.hit_distance(object, {.origin = {x, 0, 9}, .direction = {0, 0, -1}});
      if (t < nearest.t) nearest = {t, geometry.scene_number(object)};
    }
    hits.push_back(nearest);
  }
  return hits;
}

struct Garbage {
  std::string reason;
  Emit emit;
};

const std::vector<Garbage> kGarbage = {
    {"not finite",
     [](SceneBuilder& b) {
       b.triangle({0, 0, kNan}, {1, 0, 0}, {0, 1, 0});
     }},
    {"not finite",
     [](SceneBuilder& b) {
       b.triangle({0, 0, 5}, {kInfinity, 0, 5}, {0, 1, 5});
     }},
    {"not finite",
     [](SceneBuilder& b) {
       b.polygon(std::array{Vec3d{}, Vec3d{9, 0, 5}, Vec3d{9, 9, 5}, Vec3d{0, kNan, 5}});
     }},
    {"not finite",
     [](SceneBuilder& b) {
       b.sphere({0, 0, -kInfinity}, 1);
     }},
    {"not finite",
     [](SceneBuilder& b) {
       b.sphere({0, 0, 0}, kNan);
     }},
    {"not finite",
     [](SceneBuilder& b) {
       b.sphere({0, 0, 0}, kInfinity);
     }},
    {"not finite",
     [](SceneBuilder& b) {
       b.cone({0, 0, 0}, 1, {0, kNan, 0}, 1);
     }},
    {"not finite",
     [](SceneBuilder& b) {
       b.cone({0, 0, 0}, kInfinity, {0, 0, 1}, 1);
     }},
    {"out of range",
     [](SceneBuilder& b) {
       b.triangle({1e200, 0, 0}, {0, 1, 0}, {0, 0, 1});
     }},
    {"out of range",
     [](SceneBuilder& b) {
       b.polygon(std::array{Vec3d{}, Vec3d{1e200, 0, 0}, Vec3d{1, 1, 0}, Vec3d{0, 1, 0}});
     }},
    {"out of range",
     [](SceneBuilder& b) {
       b.sphere({0, 0, 0}, 1e200);
     }},
    {"zero area",
     [](SceneBuilder& b) {
       b.triangle({1, 1, 1}, {2, 2, 2}, {4, 4, 4});
     }},
    {"zero area",
     [](SceneBuilder& b) {
       b.triangle({1, 2, 3}, {1, 2, 3}, {0, 0, 9});
     }},
    {"zero area",
     [](SceneBuilder& b) {
       b.polygon(std::array{Vec3d{}, Vec3d{1, 0, 0}, Vec3d{2, 0, 0}, Vec3d{3, 0, 0}});
     }},
    {"fewer than 3 vertices",
     [](SceneBuilder& b) {
       b.polygon(std::array{Vec3d{}, Vec3d{1, 0, 0}});
     }},
    {"radius is not positive",
     [](SceneBuilder& b) {
       b.sphere({0, 0, 5}, -1);
     }},
    {"radius is not positive",
     [](SceneBuilder& b) {
       b.sphere({0, 0, 5}, 0);
     }},
    {"radius is negative",
     [](SceneBuilder& b) {
       b.cone({0, -1, 5}, -1, {0, 1, 5}, 1);
     }},
    {"zero area",
     [](SceneBuilder& b) {
       b.cone({0, -1, 5}, 0, {0, 1, 5}, 0);
     }},
    {"zero height", [](SceneBuilder& b) {
       b.cone({0, 0, 5}, 1, {0, 0, 5}, 2);
     }}};

TYPED_TEST(GeometryObjects, GarbageIsSetAsideWithAReasonAndTheGoodObjectsAreUntouched) {
  using Real = TypeParam;
  const Geometry<Real> good(built(kGoodObjects));
  ASSERT_EQ(good.size(), 4u);
  ASSERT_TRUE(good.set_aside().empty());
  std::vector<Real> distances;
  for (const Hit<Real>& hit : nearest_hits(good)) distances.push_back(hit.t);
  ASSERT_EQ(distances, (std::vector<Real>{8, 7, 6, 5, kMiss<Real>}));

  for (std::size_t k = 0; k < kGarbage.size(); ++k) {
    // The garbage comes first, so that the numbers of all good objects must shift.
    std::vector<Emit> objects = kGoodObjects;
    objects.insert(objects.begin(), kGarbage[k].emit);
    const Scene scene = built(objects);
    const Geometry<Real> geometry(scene);
    ASSERT_EQ(geometry.size(), 4u) << k;
    ASSERT_EQ(geometry.set_aside().size(), 1u) << k;
    EXPECT_EQ(geometry.set_aside()[0].scene_number, 0u) << k;
    EXPECT_EQ(geometry.set_aside()[0].reason, kGarbage[k].reason) << k;
    EXPECT_EQ(geometry.bounds(), good.bounds()) << k;
    std::vector<Hit<Real>> expected = nearest_hits(good);
    for (Hit<Real>& hit : expected)
      if (hit.object != kNoObject) ++hit.object;
    EXPECT_EQ(nearest_hits(geometry), expected) << k;
  }
}

TYPED_TEST(GeometryObjects, CoordinatesBeyondSinglePrecisionAreOutOfRangeThereOnly) {
  const Geometry<TypeParam> geometry(built({[](SceneBuilder& b) { b.sphere({1e20, 0, 0}, 1e19); }}));
  EXPECT_EQ(geometry.size(), (std::is_same_v<TypeParam, double> ? 1u : 0u));
}

TYPED_TEST(GeometryObjects, WhatVanishesInSinglePrecisionIsSetAsideThereOnly) {
  const Geometry<TypeParam> geometry(built({[](SceneBuilder& b) {
                                              b.sphere({0, 0, 0}, 1e-60);
                                            },
                                            [](SceneBuilder& b) {
                                              b.cone({1, 0, 0}, 1, {1 + 1e-12, 0, 0}, 1);
                                            }}));
  EXPECT_EQ(geometry.size(), (std::is_same_v<TypeParam, double> ? 2u : 0u));
}

TYPED_TEST(GeometryObjects, NothingIsLeftOfAnEmptyScene) {
  const Geometry<TypeParam> geometry{Scene{}};
  EXPECT_EQ(geometry.size(), 0u);
  EXPECT_TRUE(geometry.bounds().empty());
  EXPECT_TRUE(geometry.triangles_only());
}

TYPED_TEST(GeometryObjects, ArrangedObjectsAreTheSameObjects) {
  using Real = TypeParam;
  // Once with every kind alike, once with nearly all triangles, which are then kept in another way.
  for (const int triangles : {0, 60}) {
    std::vector<Emit> objects;
    for (const int copy : {0, 1}) {
      objects.insert(objects.end(), kGoodObjects.begin(), kGoodObjects.end());
      objects.push_back(kGarbage[copy].emit);
    }
    objects.insert(objects.end(), triangles, kGoodObjects[0]);
    const Geometry<Real> geometry(built(objects));
    ASSERT_EQ(geometry.mostly_triangles(), triangles > 0);

    std::vector<std::uint32_t> order(geometry.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = (i * 5 + 3) % order.size();
    ASSERT_THAT(std::set(order.begin(), order.end()), testing::SizeIs(order.size()));
    const Geometry<Real> arranged = geometry.arranged(order);
    ASSERT_EQ(arranged.size(), geometry.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
      EXPECT_EQ(arranged.kind(i), geometry.kind(order[i]));
      EXPECT_EQ(arranged.scene_number(i), geometry.scene_number(order[i]));
      EXPECT_EQ(arranged.bounds(i), geometry.bounds(order[i]));
      for (const Real x : {0, 2, 4, 6}) {
        const Ray<Real> ray{.origin = {x, 0, 9}, .direction = {0, 0, -1}};
        EXPECT_EQ(arranged.hit_distance(i, ray), geometry.hit_distance(order[i], ray));
        if (triangles == 0) continue;
        EXPECT_EQ(arranged.template triangle_hit_distance<Intersector::fast>(i, ray),
                  geometry.hit_distance(order[i], ray));
      }
    }
    EXPECT_EQ(arranged.bounds(), geometry.bounds());
    EXPECT_EQ(arranged.set_aside().size(), 2u);
  }
}

TYPED_TEST(GeometryObjects, ConesCanBeLimitedToTheirOutside) {
  using Real = TypeParam;
  const Scene scene = built(kGoodObjects);
  const Ray<Real> from_inside{.origin = {6, 0, 3.5}, .direction = {0, 0, -1}};
  EXPECT_EQ(Geometry<Real>(scene).hit_distance(3, from_inside), Real{0.5});
  const Geometry<Real> outside(scene, ConeSides::outside);
  EXPECT_EQ(outside.hit_distance(3, from_inside), kMiss<Real>);
  EXPECT_EQ(outside.arranged(std::array{3u, 2u, 1u, 0u}).hit_distance(0, from_inside), kMiss<Real>);
}

TEST(SceneBounds, AreThoseOfTheObjectsThatCanBeTraced) {
  const Box<double> good = built(kGoodObjects).bounds();
  EXPECT_EQ(good, (Box<double>{{-0.5, -1, 1}, {6.5, 1, 4}}));
  std::vector<Emit> objects = kGoodObjects;
  for (const Garbage& garbage : kGarbage)
    if (garbage.reason == "not finite" || garbage.reason == "out of range") objects.push_back(garbage.emit);
  EXPECT_EQ(built(objects).bounds(), good);
}

TEST(SceneHash, DependsOnEverythingThatIsSeen) {
  const Scene scene = built(kGoodObjects);
  std::set<std::string> hashes{scene_hash(scene)};
  const auto expect_new = [&](const std::function<void(Scene&)>& change) {
    Scene changed = scene;
    change(changed);
    EXPECT_TRUE(hashes.insert(scene_hash(changed)).second);
  };
  expect_new([](Scene& s) { s.view.angle = 46; });
  expect_new([](Scene& s) { s.view.width = 256; });
  expect_new([](Scene& s) { s.lights.push_back({{1, 2, 3}, std::nullopt}); });
  expect_new([](Scene& s) { s.lights.push_back({{1, 2, 3}, Vec3d{1, 0, 0}}); });
  expect_new([](Scene& s) { s.materials.push_back({}); });
  expect_new([](Scene& s) { s.materials.push_back({}), s.objects[1].material = 1; });
  expect_new([](Scene& s) { s.spheres[0].radius = 0.25; });
  expect_new([](Scene& s) { std::swap(s.objects[0], s.objects[1]); });
}

}  // namespace
}  // namespace rayshoot
