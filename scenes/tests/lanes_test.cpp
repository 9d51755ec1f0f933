#include "scenes/geometry/lanes.h"

#include <gtest/gtest.h>

#include <random>

#include "scenes/geometry/triangle.h"

namespace rayshoot {
namespace {

template <class Real>
class LanesTest : public ::testing::Test {
 protected:
  /// Numbers of every size, and often one of a few that are awkward.
  Real number() {
    constexpr Real awkward[] = {
        0, -Real{0}, 1, -1, Real(1e-30), Real(-1e30), std::numeric_limits<Real>::denorm_min()};
    if (std::uniform_int_distribution(0, 3)(random_) == 0)
      return awkward[std::uniform_int_distribution(0, 6)(random_)];
    const double magnitude = std::pow(10, std::uniform_real_distribution(-3.0, 3.0)(random_));
    return static_cast<Real>(std::uniform_real_distribution(-magnitude, magnitude)(random_));
  }
  Vec3<Real> point() { return {number(), number(), number()}; }

 private:
  std::mt19937 random_{2};
};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(LanesTest, Scalars);

TYPED_TEST(LanesTest, BoundsOfATriangleAreThoseOfItsCornersPadded) {
  using Real = TypeParam;
  for (int i = 0; i < 20'000; ++i) {
    const Triangle<Real> triangle{this->point(), this->point(), this->point()};
    Box<Real> corners;
    corners.include(triangle.a), corners.include(triangle.b), corners.include(triangle.c);
    EXPECT_EQ(bounds(triangle), padded(corners));
  }
}

/// The interval of a ray in a box must come out as techniques compute it, or they would miss hits.
TYPED_TEST(LanesTest, ConfineToTheIntervalThatCrossingsSee) {
  using Real = TypeParam;
  int confined = 0;
  for (int i = 0; i < 200'000; ++i) {
    const Triangle<Real> triangle{this->point(), this->point(), this->point()};
    const Ray<Real> ray{.origin = this->point(), .direction = this->point()};
    const double t = std::abs(static_cast<double>(this->number()));
    const Real expected = confine(t, bounds(triangle), ray);
    EXPECT_EQ(confine(t, Corners<Real>(triangle).bounds(), ray), expected);
    confined += expected < kMiss<Real>;
  }
  EXPECT_GT(confined, 1000);
}

/// Two triangles with a common edge: a ray past the edge hits one of them, or both in the edge itself.
TYPED_TEST(LanesTest, NoRayPassesBetweenTwoTriangles) {
  using Real = TypeParam;
  int hits = 0, both = 0;
  for (int i = 0; i < 100'000; ++i) {
    const auto place = [&] { return static_cast<Real>(0.1 + 0.8 * std::fmod(std::abs(this->number()), 1)); };
    const Triangle<Real> left{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, right{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const Vec3<Real> from{place(), place(), 2};
    const Real s = place();
    const Ray<Real> ray{.origin = from, .direction = Vec3<Real>{s, 1 - s, 0} - from};
    const bool hits_left = hit_distance(left, ray) < kMiss<Real>,
               hits_right = hit_distance(right, ray) < kMiss<Real>;
    hits += hits_left || hits_right, both += hits_left && hits_right;
  }
  EXPECT_EQ(hits, 100'000);
  EXPECT_LT(both, 100'000);
}

}  // namespace
}  // namespace rayshoot
