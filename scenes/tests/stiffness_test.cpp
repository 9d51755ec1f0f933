#include "scenes/core/stiffness.h"

#include <gtest/gtest.h>

#include "scenes/core/scene_builder.h"

namespace rayshoot {
namespace {

template <class Fill>
Scene scene_of(const Fill& fill) {
  SceneBuilder builder;
  fill(builder);
  return std::move(builder).finish();
}

TEST(Stiffness, OfATriangleIsMeasuredByItsSmallestAltitude) {
  const Scene scene = scene_of([](SceneBuilder& b) { b.triangle({0, 0, 0}, {10, 0, 0}, {5, 0.1, 0}); });
  EXPECT_DOUBLE_EQ(*smallest_feature(scene), 0.1);
  EXPECT_DOUBLE_EQ(*stiffness(scene), std::hypot(10, 0.1) / 0.1);
}

TEST(Stiffness, TakesTheSmallestOfAllKinds) {
  const auto polygon = [](SceneBuilder& b) {
    b.polygon(std::array<Vec3d, 4>{{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}}});
  };
  const auto cone = [](SceneBuilder& b) { b.cone({0, 0, 0}, 0, {0, 0, 2.5}, 1); };
  const auto sphere = [](SceneBuilder& b) { b.sphere({0, 0, 0}, 0.5); };
  EXPECT_EQ(smallest_feature(scene_of(polygon)), 3);
  EXPECT_EQ(smallest_feature(scene_of([&](auto& b) { polygon(b), cone(b); })), 2) << "an apex is no diameter";
  EXPECT_EQ(smallest_feature(scene_of([&](auto& b) { polygon(b), cone(b), sphere(b); })), 1);
}

TEST(Stiffness, LeavesOutWhatIsNotTraced) {
  EXPECT_FALSE(stiffness(Scene{}));
  EXPECT_FALSE(stiffness(scene_of([](SceneBuilder& b) { b.triangle({0, 0, 0}, {1, 0, 0}, {2, 0, 0}); })));
  EXPECT_EQ(smallest_feature(scene_of([](SceneBuilder& b) {
              b.sphere({0, 0, 0}, 1), b.sphere({NAN, 0, 0}, 1e-9);
            })),
            2);
}

TEST(Stiffness, OfAConeIsItsHeightOrADiameter) {
  const auto cone = [](double base_radius, double height, double apex_radius) {
    return smallest_feature(scene_of([=](SceneBuilder& b) {
      b.cone({0, 0, 0}, base_radius, {0, 0, height}, apex_radius);
    }));
  };
  EXPECT_EQ(cone(1, 0.75, 2), 0.75);
  EXPECT_EQ(cone(1, 3, 0.25), 0.5);
  EXPECT_EQ(cone(0.25, 3, 0), 0.5);
}

TEST(Stiffness, SurvivesTinyAndHugeScenesAndRepeatedVertices) {
  for (const double scale : {0x1p-149, 0x1p400}) {
    const Scene scene = scene_of([=](SceneBuilder& b) {
      b.triangle({0, 0, 0}, {2 * scale, 0, 0}, {0, 2 * scale, 0});
    });
    EXPECT_NEAR(*stiffness(scene), 2, 1e-12) << scale;
  }
  EXPECT_EQ(smallest_feature(scene_of([](SceneBuilder& b) {
              b.polygon(std::array<Vec3d, 4>{{{2, 0, 0}, {2, 0, 0}, {5, 0, 0}, {2, 4, 0}}});
            })),
            3);
}

}  // namespace
}  // namespace rayshoot
