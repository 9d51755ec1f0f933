// The watertight and the exact ray-object test: what they promise beside the fast one.
#include <gtest/gtest.h>

#include <random>

#include "scenes/core/geometry.h"
#include "scenes/core/scene_builder.h"
#include "scenes/geometry/expansion.h"

namespace rayshoot {
namespace {

using Random = std::mt19937_64;

double uniform(Random& random, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(random);
}

template <class Real>
Vec3d random_point(Random& random) {
  return Vec3d(Vec3<Real>(Vec3d{uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)}));
}

template <class Real>
Ray<Real> ray_through(const Vec3d& from, const Vec3d& through) {
  return {.origin = Vec3<Real>(from), .direction = Vec3<Real>(through) - Vec3<Real>(from)};
}

template <class Real>
bool any_hit(const Geometry<Real>& geometry, const Ray<Real>& ray) {
  for (std::uint32_t object = 0; object < geometry.size(); ++object)
    if (geometry.hit_distance(object, ray) < kMiss<Real>) return true;
  return false;
}

template <class Real>
class IntersectorOf : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(IntersectorOf, Scalars);

/// A bumpy closed surface about the origin: a grid of longitudes and latitudes of triangles or of quadrangles, which
/// are given as polygons.
template <class Real>
struct Shell {
  Scene scene;
  std::vector<Vec3d> vertices;

  Shell(Random& random, bool polygons) {
    constexpr int longitudes = 7, latitudes = 6;
    std::vector<std::vector<Vec3d>> rings(latitudes + 1);
    for (int i = 0; i <= latitudes; ++i)
      for (int k = 0; k < longitudes; ++k) {
        const double theta = M_PI * i / latitudes, phi = 2 * M_PI * k / longitudes;
        const bool pole = i == 0 || i == latitudes;
        const double radius = polygons || pole ? 1 : uniform(random, 0.8, 1.2);
        const Vec3d point{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
        rings[i].push_back(pole && k > 0 ? rings[i][0] : Vec3d(Vec3<Real>(point * radius)));
        vertices.push_back(rings[i].back());
      }
    SceneBuilder builder;
    for (int i = 0; i < latitudes; ++i)
      for (int k = 0; k < longitudes; ++k) {
        const int next = (k + 1) % longitudes;
        const Vec3d &a = rings[i][k], &b = rings[i][next], &c = rings[i + 1][next], &d = rings[i + 1][k];
        if (i == 0)
          builder.triangle(a, c, d);
        else if (i == latitudes - 1)
          builder.triangle(a, b, c);
        else if (polygons)
          builder.polygon(std::array{a, b, c, d});
        else
          builder.triangle(a, b, c), builder.triangle(a, c, d);
      }
    scene = std::move(builder).finish();
  }
};

template <class Real>
int leaks(Intersector intersector, bool polygons) {
  Random random(7);
  int missed = 0;
  for (int mesh = 0; mesh < 40; ++mesh) {
    const Shell<Real> shell(random, polygons);
    const Geometry<Real> geometry(shell.scene, ConeSides::both, intersector);
    for (int i = 0; i < 50; ++i)
      for (const Vec3d& vertex : shell.vertices)
        missed += !any_hit(geometry, ray_through<Real>(random_point<Real>(random) * 0.3, vertex));
  }
  return missed;
}

TYPED_TEST(IntersectorOf, NoRayLeavesAClosedSurfaceByAVertex) {
  EXPECT_EQ(leaks<TypeParam>(Intersector::watertight, false), 0);
  EXPECT_EQ(leaks<TypeParam>(Intersector::exact, false), 0);
  EXPECT_GT(leaks<TypeParam>(Intersector::fast, false), 0) << "what the others are for";
}

TYPED_TEST(IntersectorOf, NorBetweenPolygonsAndTriangles) {
  EXPECT_EQ(leaks<TypeParam>(Intersector::watertight, true), 0);
  EXPECT_EQ(leaks<TypeParam>(Intersector::exact, true), 0);
}

TYPED_TEST(IntersectorOf, ARayThroughTheMiddleHitsAsTheFastTestSays) {
  using Real = TypeParam;
  Random random(3);
  for (int i = 0; i < 20'000; ++i) {
    const Triangle<Real> triangle{Vec3<Real>(random_point<Real>(random)),
                                  Vec3<Real>(random_point<Real>(random)),
                                  Vec3<Real>(random_point<Real>(random))};
    const Vec3d middle = (Vec3d(triangle.a) + Vec3d(triangle.b) + Vec3d(triangle.c)) * (1.0 / 3);
    const auto ray = ray_through<Real>(random_point<Real>(random) * 4, middle);
    const Real exact = exact_hit_distance(triangle, ray);
    ASSERT_LT(exact, kMiss<Real>);
    const Real tolerance = std::is_same_v<Real, float> ? Real(2e-7) : Real(1e-10);
    ASSERT_NEAR(watertight_hit_distance(triangle, ray), exact, exact * tolerance);
    ASSERT_NEAR(hit_distance(triangle, ray), exact, exact * tolerance);
  }
}

/// The exact test in integers: corners, origin and direction are small whole numbers.
std::optional<double> distance_in_integers(const std::array<std::array<long, 3>, 5>& p) {
  const auto minus = [](const auto& a, const auto& b) {
    return std::array<long, 3>{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  };
  const auto triple = [](const auto& a, const auto& b, const auto& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  };
  const auto a = minus(p[0], p[3]), b = minus(p[1], p[3]), c = minus(p[2], p[3]), d = p[4];
  const long u = triple(d, b, c), v = triple(d, c, a), w = triple(d, a, b), volume = u + v + w;
  const bool outside = (u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0);
  if (outside || volume == 0) return std::nullopt;
  return static_cast<double>(triple(a, b, c)) / static_cast<double>(volume);
}

TYPED_TEST(IntersectorOf, ExactAndWatertightDecideEveryTouchOfSmallIntegers) {
  using Real = TypeParam;
  Random random(5);
  int touches = 0;
  for (int i = 0; i < 100'000; ++i) {
    std::array<std::array<long, 3>, 5> p;
    for (auto& point : p)
      for (long& coordinate : point) coordinate = std::uniform_int_distribution<long>(-2, 2)(random);
    const auto vector = [&](int k) {
      return Vec3<Real>(Vec3d{double(p[k][0]), double(p[k][1]), double(p[k][2])});
    };
    const Triangle<Real> triangle{vector(0), vector(1), vector(2)};
    const Ray<Real> ray{.origin = vector(3), .direction = vector(4)};
    const std::optional<double> t = distance_in_integers(p);
    const Real expected = t && *t > 0 ? static_cast<Real>(*t) : kMiss<Real>;
    ASSERT_EQ(exact_hit_distance(triangle, ray), expected);
    ASSERT_EQ(watertight_hit_distance(triangle, ray) < kMiss<Real>, expected < kMiss<Real>);
    touches += expected < kMiss<Real>;
  }
  EXPECT_GT(touches, 5000);
}

TEST(Expansion, KeepsWhatADoubleWouldDrop) {
  Expansion sum;
  for (const double term : {1.0, 0x1p-80, 0x1p+90, -1.0, -0x1p+90}) sum += term;
  EXPECT_EQ(sum.rounded(), 0x1p-80);
  Expansion product;
  product.add_product(1 + 0x1p-52, 1 + 0x1p-52, 1 - 0x1p-52);
  product += -1.0;
  EXPECT_EQ(product.rounded(), 0x1p-52 - 0x1p-104) << "and 2^-156 less";
}

/// Every term that is no number leaves an error that is none either, and would be kept.
TEST(Expansion, StaysWithinItsRoom) {
  struct {
    Expansion sum;
    std::array<double, 256> behind{};
  } memory;
  for (int i = 0; i < 200; ++i) memory.sum += std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(memory.sum.rounded()));
  EXPECT_EQ(memory.behind, (std::array<double, 256>{}));
}

TEST(SideOfEdge, IsExactWhereProductsRoundToTheSame) {
  EXPECT_EQ(side_of_edge(3, 7, 6, 14), 0);
  // (1 + 2^-30)^2 and 1 + 2^-29 round to the same double; the first is larger by 2^-60.
  EXPECT_EQ(side_of_edge(1 + 0x1p-30, 1, 1 + 0x1p-29, 1 + 0x1p-30), 0x1p-60);
}

}  // namespace
}  // namespace rayshoot
