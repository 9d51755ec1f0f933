#include <gtest/gtest.h>

#include <numbers>

#include "accel/tests/nasty_scenes.h"
#include "harness/verify/exact_oracle.h"

namespace rayshoot::test {
namespace {

using nasty::Random;
using nasty::uniform;
using nasty::uniform_point;

template <class Real>
class PlantedErrorsTest : public ::testing::Test {
 protected:
  static constexpr Real kEpsilon = std::numeric_limits<Real>::epsilon();

  static Scene scene(const std::function<void(SceneBuilder&)>& build) {
    SceneBuilder builder;
    build(builder);
    return std::move(builder).finish();
  }
  static Ray<Real> ray(const Vec3d& origin, const Vec3d& direction) {
    return {.origin = Vec3<Real>(origin), .direction = Vec3<Real>(direction)};
  }
  static AnswerClass grade(const Scene& scene, const Ray<Real>& ray, const Hit<Real>& answer) {
    const Geometry<Real> geometry(scene);
    return ExactOracle<Real>(geometry).grade(ray, answer).answer;
  }
  /// What becomes of claims that the ray misses, and that it hits object 0, the only one.
  static std::pair<AnswerClass, AnswerClass> grades(const Scene& scene, const Ray<Real>& ray) {
    return {grade(scene, ray, {}), grade(scene, ray, {1, 0})};
  }
};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(PlantedErrorsTest, Scalars);

const std::pair kHit{AnswerClass::false_miss, AnswerClass::exact};
const std::pair kMissed{AnswerClass::exact, AnswerClass::false_hit};
const std::pair kTouched{AnswerClass::ambiguous, AnswerClass::exact};
const std::pair kPassed{AnswerClass::exact, AnswerClass::ambiguous};

void triangle_at(SceneBuilder& builder, double z) { builder.triangle({1, 1, z}, {3, 1, z}, {1, 3, z}); }

TYPED_TEST(PlantedErrorsTest, EveryClassIsRecognised) {
  const double e = this->kEpsilon;
  const Scene scene = this->scene([&](SceneBuilder& b) {
    for (const double z : {-0.5, -0.5, -0.5 - 2 * e, -0.5 - 8 * e}) triangle_at(b, z);
    b.triangle({3, 1, -0.5}, {3, 3, -0.5}, {1, 3, -0.5});
  });
  const auto down = this->ray({1.5, 1.5, 1}, {0, 0, -1});
  const auto edge = this->ray({2, 2, 1}, {0, 0, -1});
  const auto beside = this->ray({0.5, 0.5, 1}, {0, 0, -1});
  const auto grade = [&](const auto& ray, TypeParam t, std::uint32_t object) {
    return this->grade(scene, ray, {t, object});
  };
  EXPECT_EQ(grade(down, 1.5, 0), AnswerClass::exact);
  EXPECT_EQ(grade(down, 1.5, 1), AnswerClass::exact);
  EXPECT_EQ(grade(down, 1.5, 2), AnswerClass::near);
  EXPECT_EQ(grade(down, 1.5, 3), AnswerClass::wrong_object);
  EXPECT_EQ(grade(down, 1.5, 4), AnswerClass::wrong_object);
  EXPECT_EQ(grade(down, 1.5, 5), AnswerClass::wrong_object);
  EXPECT_EQ(grade(edge, 1.5, 4), AnswerClass::exact);
  EXPECT_EQ(grade(edge, 1.5, 3), AnswerClass::ambiguous);
  EXPECT_EQ(this->grade(scene, edge, {}), AnswerClass::ambiguous);
  EXPECT_EQ(this->grade(scene, down, {}), AnswerClass::false_miss);
  EXPECT_EQ(this->grade(scene, beside, {}), AnswerClass::exact);
  EXPECT_EQ(grade(beside, 1.5, 0), AnswerClass::false_hit);
  EXPECT_EQ(grade(beside, 1.5, 5), AnswerClass::false_hit);
  EXPECT_EQ(grade(down, std::numeric_limits<TypeParam>::quiet_NaN(), 0), AnswerClass::not_a_number);
  EXPECT_STREQ(kAnswerClassNames.at(static_cast<std::size_t>(AnswerClass::near)), "near");
  EXPECT_STREQ(kAnswerClassNames.at(static_cast<std::size_t>(AnswerClass::crash)), "crash");
}

TYPED_TEST(PlantedErrorsTest, WhatIsNearIsForTheCallerToSay) {
  const double e = this->kEpsilon;
  const Geometry<TypeParam> geometry(
      this->scene([&](SceneBuilder& b) { triangle_at(b, -0.5), triangle_at(b, -0.5 - 8 * e); }));
  const auto down = this->ray({1.5, 1.5, 1}, {0, 0, -1});
  EXPECT_EQ(ExactOracle<TypeParam>(geometry, 8).grade(down, {1.5, 1}).answer, AnswerClass::near);
  EXPECT_EQ(ExactOracle<TypeParam>(geometry, 7).grade(down, {1.5, 1}).answer, AnswerClass::wrong_object);
}

TYPED_TEST(PlantedErrorsTest, BordersOfTrianglesAreAmbiguousWithinHalfAnUlp) {
  const double e = this->kEpsilon;
  const Scene scene = this->scene([](SceneBuilder& b) { triangle_at(b, 0); });
  const auto at = [&](double x) { return this->grades(scene, this->ray({x, 1.5, 4}, {0, 0, -1})); };
  EXPECT_EQ(at(1 + 8 * e), kHit);
  EXPECT_EQ(at(1), kTouched);
  EXPECT_EQ(at(1 - e / 2), kPassed);
  EXPECT_EQ(at(1 - 4 * e), kMissed);
}

TYPED_TEST(PlantedErrorsTest, RaysInPlanesAreAmbiguousOnlyWhereTheyCross) {
  const Scene scene = this->scene([](SceneBuilder& b) { triangle_at(b, 1); });
  EXPECT_EQ(this->grades(scene, this->ray({0, 1.5, 1}, {1, 0, 0})), kPassed);
  EXPECT_EQ(this->grades(scene, this->ray({0, 0.5, 1}, {1, 0, 0})), kMissed);
  EXPECT_EQ(this->grades(scene, this->ray({0, 4, 1}, {1, -1.25, 0})), kPassed);
  EXPECT_EQ(this->grades(scene, this->ray({0, 4, 1}, {1, -0.25, 0})), kMissed);
  EXPECT_EQ(this->grades(scene, this->ray({1, 4, 1}, {1, -1, 0})), kMissed);
  EXPECT_EQ(this->grades(scene, this->ray({0, 1.5, 1.25}, {1, 0, 0})), kMissed);
  const Scene slope = this->scene([](SceneBuilder& b) { b.triangle({1, 1, 1}, {3, 1, 3}, {1, 3, 1}); });
  EXPECT_EQ(this->grades(slope, this->ray({0, 1.5, 0}, {1, 0, 1})), kPassed);
  EXPECT_EQ(this->grades(slope, this->ray({0, 1.5, 0.25}, {1, 0, 1})), kMissed);
}

TYPED_TEST(PlantedErrorsTest, EndsOfRaysAreAmbiguousWithinHalfAnUlp) {
  const TypeParam e = this->kEpsilon;
  const Scene flat = this->scene([](SceneBuilder& b) { triangle_at(b, 1); });
  const Scene round = this->scene([](SceneBuilder& b) { b.sphere({1.5, 1.5, 0}, 1); });
  for (const Scene* scene : {&flat, &round}) {
    auto ray = this->ray({1.5, 1.5, 3}, {0, 0, -1});
    const auto until = [&](TypeParam t_max) { return ray.t_max = t_max, this->grades(*scene, ray); };
    EXPECT_EQ(until(2 + 16 * e), kHit);
    EXPECT_EQ(until(2), kTouched);
    EXPECT_EQ(until(2 - e), kPassed);
    EXPECT_EQ(until(2 - 16 * e), kMissed);
  }
  auto ray = this->ray({1.5, 1.5, 3}, {0, 0, -1});
  ray.t_min = 2;  // where it enters the sphere, which it leaves for certain
  EXPECT_EQ(this->grades(round, ray), kHit);
  const auto from = [&](TypeParam t_min) { return ray.t_min = t_min, this->grades(flat, ray); };
  EXPECT_EQ(from(2 - 16 * e), kHit);
  EXPECT_EQ(from(2 - e), kTouched);
  EXPECT_EQ(from(2), kPassed);
  EXPECT_EQ(from(2 + 16 * e), kMissed);
}

TYPED_TEST(PlantedErrorsTest, TangentsToSpheresAndCylindersAreAmbiguous) {
  const double e = this->kEpsilon;
  const Scene ball = this->scene([](SceneBuilder& b) { b.sphere({0, 0, 0}, 1); });
  const Scene tube = this->scene([](SceneBuilder& b) { b.cone({0, -1, 0}, 1, {0, 1, 0}, 1); });
  for (const Scene* scene : {&ball, &tube}) {
    const auto at = [&](double x) { return this->grades(*scene, this->ray({x, 0, 4}, {0, 0, -1})); };
    EXPECT_EQ(at(1 - 4 * e), kHit);
    EXPECT_EQ(at(1), kTouched);
    EXPECT_EQ(at(1 + e), kPassed);
    EXPECT_EQ(at(1 + 4 * e), kMissed);
  }
}

TYPED_TEST(PlantedErrorsTest, CirclesAndLinesOfConesAreAmbiguous) {
  const double e = this->kEpsilon;
  const Scene tube = this->scene([](SceneBuilder& b) { b.cone({0, 1, 0}, 1, {0, 2, 0}, 1); });
  const auto at = [&](double y) { return this->grades(tube, this->ray({0, y, 4}, {0, 0, -1})); };
  EXPECT_EQ(at(2 - 8 * e), kHit);
  EXPECT_EQ(at(2), kTouched);
  EXPECT_EQ(at(1), kTouched);
  EXPECT_EQ(at(1 - e / 2), kPassed);
  EXPECT_EQ(at(1 - 8 * e), kMissed);
  EXPECT_EQ(this->grades(tube, this->ray({1, 0, 0}, {0, 1, 0})), kPassed);
  EXPECT_EQ(this->grades(tube, this->ray({0.5, 0, 0}, {0, 1, 0})), kMissed);
  const Scene tip = this->scene([](SceneBuilder& b) { b.cone({0, 1, 0}, 1, {0, 2, 0}, 0); });
  EXPECT_EQ(this->grades(tip, this->ray({0, 2, 4}, {0, 0, -1})), kTouched);
}

TYPED_TEST(PlantedErrorsTest, ConesCanBeSeenFromOutsideOnly) {
  const Geometry<TypeParam> geometry(this->scene([](SceneBuilder& b) {
    b.cone({0, 0, 0}, 2, {0, 0, 1}, 1);
  }),
                                     ConeSides::outside);
  const ExactOracle<TypeParam> oracle(geometry);
  const auto t = [&](const Vec3d& origin, const Vec3d& direction) {
    return oracle.nearest(this->ray(origin, direction)).t;
  };
  EXPECT_EQ(t({4, 0, 0.5}, {-1, 0, 0}), 2.5);
  EXPECT_EQ(t({0, 0, 0.5}, {-1, 0, 0}), kMiss<TypeParam>);
  // Parallel to a line in the surface there is one crossing.
  EXPECT_EQ(t({-2.75, 0, 0.25}, {1, 0, -1}), kMiss<TypeParam>);
  EXPECT_EQ(t({-3, 0, 1.75}, {1, 0, -1}), 1.375);
  EXPECT_EQ(t({2.375, 0, -0.5}, {-1, 0, 1}), kMiss<TypeParam>);
  EXPECT_EQ(t({-1, 0, 0.5}, {-1, 0, -1}), kMiss<TypeParam>);
}

TYPED_TEST(PlantedErrorsTest, BordersOfPolygonsAreAmbiguousInNotchesToo) {
  const double e = this->kEpsilon;
  const Scene scene = this->scene([](SceneBuilder& b) {
    b.polygon(std::array<Vec3d, 6>{{{1, 1, 0}, {4, 1, 0}, {4, 2, 0}, {2, 2, 0}, {2, 4, 0}, {1, 4, 0}}});
  });
  const auto at = [&](double x, double y) { return this->grades(scene, this->ray({x, y, 4}, {0, 0, -1})); };
  EXPECT_EQ(at(1.5, 3), kHit);
  EXPECT_EQ(at(2, 1.5), kHit);  // beyond the end of an edge
  EXPECT_EQ(at(2, 3), kTouched);
  EXPECT_EQ(at(2 + 2 * e, 3), kPassed);
  EXPECT_EQ(at(2 + 16 * e, 3), kMissed);
  EXPECT_EQ(at(2, 2), kTouched);
  EXPECT_EQ(at(4, 1.5), kTouched);
  EXPECT_EQ(this->grades(scene, this->ray({0, 3, 0}, {1, 0, 0})), kPassed);
  EXPECT_EQ(this->grades(scene, this->ray({0, 5, 0}, {1, 0, 0})), kMissed);
}

TYPED_TEST(PlantedErrorsTest, ErrorsAreMeasuredInUlps) {
  const TypeParam e = this->kEpsilon;
  const Geometry<TypeParam> geometry(this->scene([](SceneBuilder& b) {
    triangle_at(b, -0.5), b.sphere({5, 5, 0}, 1);
  }));
  const ExactOracle<TypeParam> oracle(geometry);
  const Grade flat = oracle.grade(this->ray({1.5, 1.5, 1}, {0, 0, -1}), {TypeParam(1.5) + 3 * e, 0});
  EXPECT_NEAR(flat.ulps_of_t, 3, 1e-2);
  EXPECT_NEAR(flat.ulps_of_point, 1.5, 1e-2);  // coordinates up to 3
  const Grade round = oracle.grade(this->ray({5, 5, 2.5}, {0, 0, -1}), {TypeParam(1.5) - 40 * e, 1});
  EXPECT_NEAR(round.ulps_of_t, 40, 1e-2);
  EXPECT_NEAR(round.ulps_of_point, 10, 1e-2);  // coordinates up to 6
  const Grade miss = oracle.grade(this->ray({1.5, 1.5, 1}, {0, 0, 1}), {});
  EXPECT_EQ(miss.ulps_of_t, 0);
  const Grade endless = oracle.grade(this->ray({1.5, 1.5, 1}, {0, 0, -1}), {kMiss<TypeParam>, 0});
  EXPECT_EQ(endless.ulps_of_t, std::numeric_limits<double>::infinity());
}

TYPED_TEST(PlantedErrorsTest, RaysThatAreNoneHitNothing) {
  const Scene scene = this->scene([](SceneBuilder& b) { b.sphere({0, 0, 0}, 1); });
  constexpr double inf = Box<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(this->grades(scene, this->ray({0, 0, 0}, {0, 0, 0})), kMissed);
  EXPECT_EQ(this->grades(scene, this->ray({0, 0, 0}, {inf, 0, 0})), kMissed);
  EXPECT_EQ(this->grades(scene, this->ray({0, nan, 0}, {0, 1, 0})), kMissed);
  auto ray = this->ray({0, 0, 4}, {0, 0, -1});
  ray.t_max = kMiss<TypeParam>;
  EXPECT_EQ(this->grades(scene, ray), kHit);
  ray.t_min = static_cast<TypeParam>(nan);
  EXPECT_EQ(this->grades(scene, ray), kMissed);
}

/// A sphere of triangles between rings of vertices, closed at both poles.
Scene closed_sphere(int rings, const Vec3d& centre) {
  SceneBuilder builder;
  const auto vertex = [&](int ring, int place) {
    const double latitude = std::numbers::pi * ring / rings,
                 longitude = std::numbers::pi * (place % (2 * rings)) / rings;
    if (ring == 0 || ring == rings) return centre + Vec3d{0, 0, ring == 0 ? 1.0 : -1.0};
    return centre + Vec3d{std::sin(latitude) * std::cos(longitude), std::sin(latitude) * std::sin(longitude),
                          std::cos(latitude)};
  };
  for (int ring = 0; ring < rings; ++ring)
    for (int place = 0; place < 2 * rings; ++place) {
      if (ring > 0) builder.triangle(vertex(ring, place), vertex(ring + 1, place), vertex(ring, place + 1));
      if (ring + 1 < rings)
        builder.triangle(vertex(ring, place + 1), vertex(ring + 1, place), vertex(ring + 1, place + 1));
    }
  return std::move(builder).finish();
}

TYPED_TEST(PlantedErrorsTest, ClosedMeshesHaveNoHoles) {
  Random random(5);
  for (const Vec3d& centre : {Vec3d{}, Vec3d{1024, -512, 3}}) {
    const Geometry<TypeParam> geometry(closed_sphere(16, centre));
    const ExactOracle<TypeParam> oracle(geometry);
    std::size_t shared = 0;
    for (std::uint32_t object = 0; object < geometry.size(); ++object)
      for (const Vec3<TypeParam>& corner : {geometry.triangle(object).a, geometry.triangle(object).b}) {
        // Dyadic origins make many directions exact, and then the ray meets all triangles of the vertex.
        const Vec3<TypeParam> origin(centre + nasty::lattice_point(random, -2, 2) * 0.25);
        const Ray<TypeParam> ray{.origin = origin, .direction = corner - origin};
        const ExactHit<TypeParam> hit = oracle.nearest(ray);
        ASSERT_FALSE(hit.objects.empty());
        EXPECT_TRUE(hit.borderline);
        EXPECT_EQ(oracle.grade(ray, {}).answer, AnswerClass::ambiguous);
        shared += hit.objects.size() >= 3;
      }
    EXPECT_GT(shared, 50u);
  }
}

}  // namespace
}  // namespace rayshoot::test
