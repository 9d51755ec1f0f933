#include "scenes/core/geometry.h"

#include <gtest/gtest.h>

#include <numbers>

#include "scenes/core/scene_builder.h"

namespace rayshoot {
namespace {

template <class Real>
class ObjectTest : public ::testing::Test {};

using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(ObjectTest, Scalars);

template <class Real>
Ray<Real> ray(const Vec3d& origin, const Vec3d& direction) {
  return {.origin = Vec3<Real>(origin), .direction = Vec3<Real>(direction)};
}

/// A hit at exactly `t` counts in (t_min, t_max], on either side of the surface.
template <class Real, class Test>
void expect_half_open_interval(const Test& test, const Ray<Real>& ray, Real t) {
  ASSERT_EQ(test(ray), t);
  const Real before = std::nextafter(t, Real{0}), after = std::nextafter(t, kMiss<Real>);
  const auto within = [&](Real t_min, Real t_max) {
    return test(Ray<Real>{ray.origin, t_min, ray.direction, t_max});
  };
  EXPECT_EQ(within(before, t), t) << "closed at its end";
  EXPECT_EQ(within(0, before), kMiss<Real>) << "ends before the hit";
  EXPECT_EQ(within(before, after), t);
  EXPECT_NE(within(t, kMiss<Real>), t) << "open at its beginning";
}

template <class Real>
Triangle<Real> triangle() {
  return {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
}

TYPED_TEST(ObjectTest, TriangleIsHitFromBothSides) {
  using Real = TypeParam;
  EXPECT_EQ(hit_distance(triangle<Real>(), ray<Real>({1, 1, 2}, {0, 0, -1})), Real{2});
  EXPECT_EQ(hit_distance(triangle<Real>(), ray<Real>({1, 1, -2}, {0, 0, 1})), Real{2});
  EXPECT_EQ(hit_distance(triangle<Real>(), ray<Real>({1, 1, 2}, {0, 0, -4})), Real{0.5})
      << "direction of any length";
  EXPECT_EQ(hit_distance(triangle<Real>(), ray<Real>({1, 1, 2}, {0, 0, 1})), kMiss<Real>) << "behind";
}

TYPED_TEST(ObjectTest, TriangleEndsAtItsEdges) {
  using Real = TypeParam;
  for (const Vec3d& outside : {Vec3d{-0.01, 1, 0}, Vec3d{1, -0.01, 0}, Vec3d{2.01, 2, 0}, Vec3d{5, 5, 0}})
    EXPECT_EQ(hit_distance(triangle<Real>(), ray<Real>(outside + Vec3d{0, 0, 2}, {0, 0, -1})), kMiss<Real>);
  for (const Vec3d& inside : {Vec3d{0.01, 1, 0}, Vec3d{1, 0.01, 0}, Vec3d{1.99, 2, 0}})
    EXPECT_EQ(hit_distance(triangle<Real>(), ray<Real>(inside + Vec3d{0, 0, 2}, {0, 0, -1})), Real{2});
}

TYPED_TEST(ObjectTest, TriangleIsMissedInItsPlane) {
  using Real = TypeParam;
  EXPECT_EQ(hit_distance(triangle<Real>(), ray<Real>({-1, 1, 0}, {1, 0, 0})), kMiss<Real>);
  EXPECT_EQ(hit_distance(triangle<Real>(), ray<Real>({1, 1, 0}, {1, 1, 0})), kMiss<Real>);
}

TYPED_TEST(ObjectTest, TriangleKeepsTheIntervalRule) {
  const auto test = [](const auto& r) { return hit_distance(triangle<TypeParam>(), r); };
  expect_half_open_interval<TypeParam>(test, ray<TypeParam>({1, 1, 2}, {0, 0, -1}), 2);
}

TYPED_TEST(ObjectTest, SphereIsHitFromOutsideAndFromInside) {
  using Real = TypeParam;
  const Sphere<Real> sphere{{1, 2, 3}, 2};
  EXPECT_EQ(hit_distance(sphere, ray<Real>({1, 2, -2}, {0, 0, 1})), Real{3});
  EXPECT_EQ(hit_distance(sphere, ray<Real>({1, 2, 3}, {0, 0, 1})), Real{2}) << "from the centre";
  EXPECT_EQ(hit_distance(sphere, ray<Real>({1, 2, 4}, {0, 0, -2})), Real{1.5}) << "from inside";
  EXPECT_EQ(hit_distance(sphere, ray<Real>({1, 2, 6}, {0, 0, 1})), kMiss<Real>) << "behind";
  EXPECT_EQ(hit_distance(sphere, ray<Real>({3.1, 2, -2}, {0, 0, 1})), kMiss<Real>) << "past it";
  // Half a radius off the axis the chord is sqrt(3) radii long.
  EXPECT_NEAR(hit_distance(sphere, ray<Real>({2, 2, -2}, {0, 0, 1})), 5 - std::numbers::sqrt3, 1e-6);
}

TYPED_TEST(ObjectTest, SphereKeepsTheIntervalRuleAtBothCrossings) {
  const Sphere<TypeParam> sphere{{0, 0, 0}, 1};
  const auto test = [&](const auto& r) { return hit_distance(sphere, r); };
  auto r = ray<TypeParam>({0, 0, -3}, {0, 0, 1});
  expect_half_open_interval<TypeParam>(test, r, 2);
  r.t_min = 2;
  EXPECT_EQ(test(r), TypeParam{4}) << "the far crossing once the near one is behind";
  expect_half_open_interval<TypeParam>(test, ray<TypeParam>({0, 0, 0}, {0, 0, 1}), 1);
}

TYPED_TEST(ObjectTest, SmallSphereFarAwayIsStillRound) {
  // Seen from 10^4 radii, the middle and a point near the rim differ in depth by nearly a radius.
  using Real = TypeParam;
  const Sphere<Real> sphere{{0, 0, 0}, 1};
  EXPECT_NEAR(hit_distance(sphere, ray<Real>({0, 0, -1e4}, {0, 0, 1})), 9999, 1e-3);
  EXPECT_NEAR(hit_distance(sphere, ray<Real>({0.8, 0, -1e4}, {0, 0, 1})), 1e4 - 0.6, 1e-3);
}

TYPED_TEST(ObjectTest, CylinderIsAnOpenTube) {
  using Real = TypeParam;
  const Cone<Real> tube{{0, 0, 0}, 1, {0, 0, 4}, 1};
  EXPECT_EQ(hit_distance(tube, ray<Real>({-3, 0, 2}, {1, 0, 0})), Real{2});
  EXPECT_EQ(hit_distance(tube, ray<Real>({0, 0, 2}, {1, 0, 0})), Real{1}) << "from inside";
  EXPECT_EQ(hit_distance(tube, ray<Real>({0.5, 0, -1}, {0, 0, 1})), kMiss<Real>) << "through both ends";
  EXPECT_EQ(hit_distance(tube, ray<Real>({-1, 0, -1}, {1, 0, 1})), Real{2})
      << "in at an end, onto the inner wall";
  EXPECT_EQ(hit_distance(tube, ray<Real>({-3, 0, 4.5}, {1, 0, 0})), kMiss<Real>) << "beyond the end";
  EXPECT_EQ(hit_distance(tube, ray<Real>({-3, 1.5, 2}, {1, 0, 0})), kMiss<Real>) << "past it";
}

TYPED_TEST(ObjectTest, ConeNarrowsTowardsItsApex) {
  using Real = TypeParam;
  const Cone<Real> cone{{0, 0, 0}, 2, {0, 0, 4}, 1};
  EXPECT_NEAR(hit_distance(cone, ray<Real>({-5, 0, 2}, {1, 0, 0})), 3.5, 1e-6);
  EXPECT_NEAR(hit_distance(cone, ray<Real>({1.5, 0, 9}, {0, 0, -1})), 7, 1e-5) << "onto the slope";
  EXPECT_EQ(hit_distance(cone, ray<Real>({0.5, 0, 9}, {0, 0, -1})), kMiss<Real>) << "through both ends";

  // A pointed cone has a mirror image beyond its tip that is not part of it.
  const Cone<Real> pointed{{0, 0, 0}, 1, {0, 0, 1}, 0};
  EXPECT_NEAR(hit_distance(pointed, ray<Real>({-5, 0, 0.5}, {1, 0, 0})), 4.5, 1e-6);
  EXPECT_EQ(hit_distance(pointed, ray<Real>({-5, 0, 1.5}, {1, 0, 0})), kMiss<Real>);
  // A ray along the slope on one side meets the other side only.
  EXPECT_NEAR(hit_distance(pointed, ray<Real>({-0.5, 0, -0.5}, {1, 0, 1})), 1, 1e-6);
}

TYPED_TEST(ObjectTest, ConeKeepsTheIntervalRuleAtBothCrossings) {
  const Cone<TypeParam> tube{{0, 0, 0}, 1, {0, 0, 4}, 1};
  const auto test = [&](const auto& r) { return hit_distance(tube, r); };
  auto r = ray<TypeParam>({-3, 0, 2}, {1, 0, 0});
  expect_half_open_interval<TypeParam>(test, r, 2);
  r.t_min = 2;
  EXPECT_EQ(test(r), TypeParam{4});
  expect_half_open_interval<TypeParam>(test, ray<TypeParam>({0, 0, 2}, {1, 0, 0}), 1);
}

TYPED_TEST(ObjectTest, ConeFromOutsideOnlyHidesItsInnerWall) {
  using Real = TypeParam;
  const Cone<Real> tube{{0, 0, 0}, 1, {0, 0, 4}, 1};
  EXPECT_EQ(hit_distance(tube, ray<Real>({-3, 0, 2}, {1, 0, 0}), true), Real{2});
  EXPECT_EQ(hit_distance(tube, ray<Real>({0, 0, 2}, {1, 0, 0}), true), kMiss<Real>) << "from inside";
  EXPECT_EQ(hit_distance(tube, ray<Real>({-1, 0, -1}, {1, 0, 1}), true), kMiss<Real>) << "in at an end";
  // The first crossing lies beyond the end, the second on the wall, seen from within.
  EXPECT_EQ(hit_distance(tube, ray<Real>({-2, 0, -2}, {1, 0, 1}), true), kMiss<Real>);
  EXPECT_EQ(hit_distance(tube, ray<Real>({-2, 0, -2}, {1, 0, 1}), false), Real{3});
}

/// A gear-like star: its outline is at radius 2 at even corners, 1 at odd ones.
template <class Real>
std::vector<Vec3<Real>> star(int teeth, const Vec3d& u, const Vec3d& v) {
  std::vector<Vec3<Real>> vertices;
  for (int k = 0; k < 2 * teeth; ++k) {
    const double angle = std::numbers::pi * k / teeth, radius = k % 2 ? 1 : 2;
    vertices.push_back(Vec3<Real>(u * (radius * std::cos(angle)) + v * (radius * std::sin(angle))));
  }
  return vertices;
}

/// Whether the point at polar coordinates (radius, angle) is in the star, by the line through the two corners
/// on either side; in between, where rounding decides, there is no answer.
std::optional<bool> in_star(int teeth, double radius, double angle) {
  const double step = std::numbers::pi / teeth;
  const double turns = std::floor(angle / step), rest = angle - turns * step;
  const double r0 = static_cast<int>(turns) % 2 ? 1 : 2, r1 = 3 - r0;
  const double outline = r0 * r1 * std::sin(step) / (r0 * std::sin(rest) + r1 * std::sin(step - rest));
  if (std::abs(radius / outline - 1) < 1e-3) return std::nullopt;
  return radius < outline;
}

TYPED_TEST(ObjectTest, NonConvexPolygonIsHitInItsTeethAndMissedBetweenThem) {
  using Real = TypeParam;
  const int teeth = 36;
  // In planes across each axis, and in an oblique one.
  const Vec3d planes[][2] = {
      {{1, 0, 0}, {0, 1, 0}}, {{0, 1, 0}, {0, 0, 1}}, {{0, 0, 1}, {1, 0, 0}}, {{0.8, 0, 0.6}, {0, 1, 0}}};
  for (const auto& [u, v] : planes) {
    const auto vertices = star<Real>(teeth, u, v);
    const auto polygon = make_polygon<Real>(vertices, 0);
    int hits = 0;
    for (int i = 0; i < 5000; ++i) {
      const double radius = 2.2 * std::sqrt((i + 0.5) / 5000),
                   angle = std::fmod(2.399963 * i, 2 * std::numbers::pi);
      const std::optional<bool> inside = in_star(teeth, radius, angle);
      if (!inside) continue;
      const Vec3d target = u * (radius * std::cos(angle)) + v * (radius * std::sin(angle));
      const Vec3d towards = cross(u, v) * (i % 2 ? 1.0 : -1.0) + u * 0.25;
      const Real t = hit_distance<Real>(polygon, vertices, ray<Real>(target - towards * 3, towards));
      ASSERT_EQ(t != kMiss<Real>, *inside) << radius << " " << angle;
      if (*inside) {
        ASSERT_NEAR(t, 3, 1e-5);
      }
      hits += *inside;
    }
    EXPECT_GT(hits, 1000);
  }
}

TYPED_TEST(ObjectTest, PolygonIsMissedInItsPlaneAndKeepsTheIntervalRule) {
  using Real = TypeParam;
  const std::vector<Vec3<Real>> vertices{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  const auto polygon = make_polygon<Real>(vertices, 0);
  const auto test = [&](const Ray<Real>& r) { return hit_distance<Real>(polygon, vertices, r); };
  EXPECT_EQ(test(ray<Real>({-1, 1, 0}, {1, 0, 0})), kMiss<Real>);
  EXPECT_EQ(test(ray<Real>({1, 1, -2}, {0, 0, 1})), Real{2});
  EXPECT_EQ(test(ray<Real>({1, 1, 2}, {0, 0, 1})), kMiss<Real>) << "behind";
  expect_half_open_interval<Real>(test, ray<Real>({1, 1, 2}, {0, 0, -1}), 2);
}

TYPED_TEST(ObjectTest, NeighbouringPolygonsShareAnEdgeWithoutGapOrOverlap) {
  // Rays through the very edge hit exactly one of two squares: edges are closed on one side, open on the
  // other.
  using Real = TypeParam;
  const std::vector<Vec3<Real>> left{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Vec3<Real>> right{{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}};
  for (const double y : {0.0, 0.25, 0.5, 0.875}) {
    const Ray<Real> r = ray<Real>({1, y, 1}, {0, 0, -1});
    const int hits = (hit_distance<Real>(make_polygon<Real>(left, 0), left, r) != kMiss<Real>)+(
        hit_distance<Real>(make_polygon<Real>(right, 0), right, r) != kMiss<Real>);
    EXPECT_EQ(hits, 1) << y;
  }
}

}  // namespace
}  // namespace rayshoot
