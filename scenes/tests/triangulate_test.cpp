#include "scenes/geometry/triangulate.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "scenes/geometry/polygon.h"
#include "scenes/io/load_scene.h"

namespace rayshoot {
namespace {

using Corners = std::vector<Vec3d>;

double area(const Corners& corners, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles)
    sum += length(cross(corners[b] - corners[a], corners[c] - corners[a])) / 2;
  return sum;
}

std::vector<std::array<std::uint32_t, 3>> cut(const Corners& corners) {
  return triangulate<double>(corners, make_polygon<double>(corners, 0).normal);
}

/// Every triangle faces the way of the polygon and together they have its area, so they are the polygon.
void expect_covers(const Corners& corners) {
  const Vec3d normal = make_polygon<double>(corners, 0).normal;
  const auto triangles = cut(corners);
  EXPECT_EQ(triangles.size(), corners.size() - 2);
  EXPECT_NEAR(area(corners, triangles), length(normal) / 2, 1e-12 * length(normal));
  for (const auto& [a, b, c] : triangles)
    EXPECT_GE(dot(cross(corners[b] - corners[a], corners[c] - corners[a]), normal), 0);
}

TEST(Triangulate, CutsConvexAndConcavePolygonsOfEitherSense) {
  expect_covers({{0, 0, 1}, {2, 0, 1}, {2, 1, 1}});
  expect_covers({{0, 0, 1}, {0, 2, 1}, {2, 2, 1}, {2, 0, 1}});
  expect_covers({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {2, 1, 0}, {0, 3, 0}});
  expect_covers({{1, 0, 0}, {1, 0, 3}, {1, 1, 1}, {1, 3, 3}, {1, 3, 0}});
}

TEST(Triangulate, CutsEveryPolygonOfGears) {
  const Scene scene = load_scene("gears:1").scene;
  ASSERT_FALSE(scene.polygons.empty());
  for (const VertexRange& range : scene.polygons) {
    const auto first = scene.polygon_vertices.begin() + range.first_vertex;
    expect_covers(Corners(first, first + range.vertex_count));
  }
}

TEST(Triangulate, CutsStarsOfRandomSpokes) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> radius(0.05, 1);
  for (int corners = 4; corners < 300; corners += 7) {
    Corners star;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * i / corners, r = radius(random);
      star.push_back({r * std::cos(angle), r * std::sin(angle), 0.3 * r * std::cos(angle)});
    }
    expect_covers(star);
  }
}

TEST(Triangulate, BridgesAndCornersInLineAreNoObstacle) {
  // A square with a square hole, joined to the outside by a bridge that is passed both ways.
  expect_covers({{0, 0, 0},
                 {4, 0, 0},
                 {4, 4, 0},
                 {0, 4, 0},
                 {0, 0, 0},
                 {1, 1, 0},
                 {1, 3, 0},
                 {3, 3, 0},
                 {3, 1, 0},
                 {1, 1, 0}});
  expect_covers({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}});
}

TEST(Triangulate, RepeatedCornersAndSpikesHaveNoArea) {
  expect_covers({{0, 0, 0}, {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {2, 2, 0}, {0, 2, 0}});
  expect_covers({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {3, 2, 0}, {2, 2, 0}, {0, 2, 0}});
}

TEST(Triangulate, LeavesOutWhatIsNotSimpleOrTooLarge) {
  EXPECT_TRUE(cut({{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 1, 0}}).empty());
  EXPECT_TRUE(cut({{0, 0, 0}, {1, 0, 0}}).empty());
  Corners many;
  for (std::size_t i = 0; i <= kLargestTriangulated; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / (kLargestTriangulated + 1);
    many.push_back({std::cos(angle), std::sin(angle), 0});
  }
  EXPECT_TRUE(cut(many).empty());
  many.pop_back();
  expect_covers(many);
}

}  // namespace
}  // namespace rayshoot
