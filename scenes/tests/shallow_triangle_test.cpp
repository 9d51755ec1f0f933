#include <gtest/gtest.h>

#include <random>

#include "scenes/geometry/triangle.h"

namespace rayshoot {
namespace {

/// How far a point is from a triangle, by its barycentric coordinates times the longest edge.
double distance_beyond_edges(const Triangle<double>& triangle, const Vec3d& point) {
  const Vec3d normal = double_area_vector(triangle);
  const Vec3d ab = triangle.b - triangle.a, ac = triangle.c - triangle.a, from_a = point - triangle.a;
  const double b = dot(cross(from_a, ac), normal) / dot(normal, normal);
  const double c = dot(cross(ab, from_a), normal) / dot(normal, normal);
  return -std::min({b, c, 1 - b - c}) * std::max(length(ab), length(ac));
}

TEST(ShallowTriangle, IsNotHitWhereItsPlaneIsMetBehindTheOrigin) {
  const Ray<float> ray{.origin = {-0x1.055368p+1f, -0x1.95f966p+2f, -0x1.485644p+3f},
                       .direction = {-0x1.3a927p-1f, 0x1.df456ep+2f, 0x1.3d5462p+3f}};
  const Triangle<float> triangle{{-0x1.4a13bep+2f, -0x1.4a13bep+0f, -0x1.ef1d9ep+1f},
                                 {-0x1.4a13bep+0f, 0x1.4a13bep+0f, 0},
                                 {-0x1.4a13bep+2f, 0x1.375846p+1f, 0x1.181fd2p+0f}};
  EXPECT_EQ(hit_distance(triangle, ray), kMiss<float>);
}

TEST(ShallowTriangle, HitsLieAtTheTriangle) {
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto point = [&] {
    return Vec3<float>(Vec3d{uniform(generator), uniform(generator), uniform(generator)});
  };
  int hits = 0;
  for (int i = 0; i < 200'000; ++i) {
    const Triangle<float> triangle{point(), point(), point()};
    const Vec3<float> ab = triangle.b - triangle.a, ac = triangle.c - triangle.a;
    const auto in_plane = [&] {
      return triangle.a + ab * static_cast<float>(2 * uniform(generator)) +
             ac * static_cast<float>(2 * uniform(generator));
    };
    const Vec3<float> from = in_plane(), to = in_plane();
    const Ray<float> ray{.origin = from, .direction = to - from};
    const float t = hit_distance(triangle, ray);
    if (t == kMiss<float>) continue;
    ++hits;
    const Triangle<double> exact{Vec3d(triangle.a), Vec3d(triangle.b), Vec3d(triangle.c)};
    const Vec3d at = Vec3d(ray.origin) + Vec3d(ray.direction) * static_cast<double>(t);
    EXPECT_LT(distance_beyond_edges(exact, at), 1e-5) << i;
  }
  EXPECT_GT(hits, 1000);
}

}  // namespace
}  // namespace rayshoot
