#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "scenes/core/geometry.h"
#include "scenes/core/scene_builder.h"
#include "scenes/geometry/overlap.h"

// What the geometry promises to acceleration techniques, tried on random objects and rays: the sizes of
// objects span 1e-6 to 1e6, they lie at the origin or a hundred times their size away from it, and rays start
// among them or a thousand times as far.

namespace rayshoot {
namespace {

using Random = std::mt19937_64;

double uniform(Random& random, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(random);
}
Vec3d uniform_point(Random& random, double half) {
  return {uniform(random, -half, half), uniform(random, -half, half), uniform(random, -half, half)};
}

/// Where a random scene lies and where its rays come from.
struct Setting {
  double scale;
  Vec3d translation;
  double eye_distance;
};

std::vector<Setting> settings() {
  std::vector<Setting> all;
  for (const double scale : {1e-6, 1e-3, 1.0, 1e3, 1e6})
    for (const Vec3d& direction : {Vec3d{0, 0, 0}, Vec3d{100, 0, 0}, Vec3d{-60, 80, 50}})
      for (const double distance : {2.0, 1000.0}) all.push_back({scale, direction * scale, distance * scale});
  return all;
}

Scene random_objects(const Setting& setting, Random& random, int count) {
  SceneBuilder builder;
  for (int i = 0; i < count; ++i) {
    const Vec3d p = setting.translation + uniform_point(random, setting.scale);
    const Vec3d u = uniform_point(random, 0.5 * setting.scale),
                v = uniform_point(random, 0.5 * setting.scale);
    const double r = uniform(random, 0.01, 0.5) * setting.scale;
    if (i % 4 == 0) builder.triangle(p, p + u, p + v);
    if (i % 4 == 1) builder.polygon(std::array{p, p + u, p + u + v, p + v});
    if (i % 4 == 2) builder.sphere(p, r);
    if (i % 4 == 3) builder.cone(p, r, p + u, i % 8 == 3 ? r : 0.5 * r);
  }
  return std::move(builder).finish();
}

/// A ray from about the setting's eye distance towards `target`, with a direction of any length.
template <class Real>
Ray<Real> ray_towards(const Vec3d& target, const Setting& setting, Random& random) {
  const Vec3d eye = setting.translation + normalized(uniform_point(random, 1)) * setting.eye_distance;
  return {.origin = Vec3<Real>(eye),
          .direction = Vec3<Real>(normalized(target - eye) * std::exp(uniform(random, -3, 3)))};
}

template <class Real>
Vec3d random_point_in(const Box<Real>& box, Random& random) {
  const Vec3d lo(box.lo), extent = Vec3d(box.hi) - lo;
  return lo + Vec3d{uniform(random, 0, 1) * extent.x, uniform(random, 0, 1) * extent.y,
                    uniform(random, 0, 1) * extent.z};
}

/// The largest error of a point computed from a ray at distance t: some units in the last place of the way.
template <class Real>
double rounding(const Ray<Real>& ray, Real t, double largest_coordinate, double ulps) {
  const double way =
      static_cast<double>(max_abs(ray.origin)) + static_cast<double>(t) * length(Vec3d(ray.direction));
  return ulps * std::numeric_limits<Real>::epsilon() * (way + largest_coordinate);
}

template <class Real>
class GeometryLaws : public ::testing::Test {};

using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(GeometryLaws, Scalars);

TYPED_TEST(GeometryLaws, CrossingsNeverDecreaseAlongTheDirection) {
  using Real = TypeParam;
  using Limits = std::numeric_limits<Real>;
  Random random(1);
  const Real special[] = {0,          -Real{0},    Limits::denorm_min(), -Limits::min(), Limits::max(),
                          Real{1e30}, Real{-1e-30}};
  for (int i = 0; i < 20'000; ++i) {
    const double magnitude = std::exp(uniform(random, -20, 20));
    Ray<Real> ray{.origin = Vec3<Real>(uniform_point(random, magnitude)),
                  .direction = Vec3<Real>(uniform_point(random, std::exp(uniform(random, -20, 20))))};
    if (i % 2) ray.direction.x = special[i / 2 % std::size(special)];
    std::vector<Real> positions{ray.origin.x, std::nextafter(ray.origin.x, kMiss<Real>), 0};
    for (int k = 0; k < 6; ++k) positions.push_back(static_cast<Real>(uniform(random, -2, 2) * magnitude));
    std::sort(positions.begin(), positions.end());
    if (std::signbit(ray.direction.x)) std::reverse(positions.begin(), positions.end());
    const Crossings<Real> crossings(ray);
    for (std::size_t k = 1; k < positions.size(); ++k) {
      ASSERT_LE(crossings.enter(0, positions[k - 1]), crossings.enter(0, positions[k])) << ray.direction.x;
      ASSERT_LE(crossings.exit(0, positions[k - 1]), crossings.exit(0, positions[k])) << ray.direction.x;
    }
  }
}

TYPED_TEST(GeometryLaws, TheIntervalOfABoxHoldsThatOfEveryBoxInside) {
  using Real = TypeParam;
  Random random(2);
  for (int i = 0; i < 20'000; ++i) {
    const auto point = [&] { return Vec3<Real>(uniform_point(random, 1)); };
    Box<Real> inner, outer;
    inner.include(point()), inner.include(i % 3 ? point() : inner.lo);
    outer.include(inner), outer.include(i % 2 ? point() : inner.hi);
    Ray<Real> ray{.origin = Vec3<Real>(uniform_point(random, 3)), .direction = point()};
    if (i % 5 == 0) ray.direction[i % 3] = 0, ray.origin[i % 3] = inner.lo[i % 3];
    const auto a = Crossings<Real>(ray).inside(inner), b = Crossings<Real>(ray).inside(outer);
    ASSERT_LE(b.enter, a.enter);
    ASSERT_GE(b.exit, a.exit);
  }
}

TYPED_TEST(GeometryLaws, HitsLieInTheIntervalOfTheBounds) {
  using Real = TypeParam;
  Random random(3);
  for (const Setting& setting : settings()) {
    const Geometry<Real> geometry(random_objects(setting, random, 60));
    std::array<int, 4> hits{};
    for (int i = 0; i < 6000; ++i) {
      const std::uint32_t object = i % geometry.size();
      const auto ray = ray_towards<Real>(random_point_in(geometry.bounds(object), random), setting, random);
      const Real t = geometry.hit_distance(object, ray);
      if (t == kMiss<Real>) continue;
      ++hits[static_cast<int>(geometry.kind(object))];
      const Interval<Real> inside = Crossings<Real>(ray).inside(geometry.bounds(object));
      ASSERT_TRUE(inside.enter <= t && t <= inside.exit && ray.t_min < t && t <= ray.t_max);
      ASSERT_TRUE(geometry.bounds().contains(geometry.bounds(object)));
    }
    EXPECT_THAT(hits, testing::Each(testing::Gt(100)));
  }
}

/// A point well within an object's surface and the unit normal there.
std::pair<Vec3d, Vec3d> surface_point(const Scene& scene, std::uint32_t object, Random& random) {
  const auto index = scene.objects[object].index;
  const double s = uniform(random, 0.1, 0.4), t = uniform(random, 0.1, 0.4);
  Vec3d point;
  if (scene.objects[object].kind == ObjectKind::sphere) {
    point = scene.spheres[index].centre + normalized(uniform_point(random, 1)) * scene.spheres[index].radius;
  } else if (scene.objects[object].kind == ObjectKind::cone) {
    const auto& [base, base_radius, apex, apex_radius] = scene.cones[index];
    const Vec3d across = normalized(cross(apex - base, uniform_point(random, 1)));
    point = base + (apex - base) * (2 * s) + across * (base_radius + (apex_radius - base_radius) * 2 * s);
  } else {
    const Vec3d a = scene.vertex(object, 0), u = scene.vertex(object, 1) - a;
    point = a + u * s + (scene.vertex(object, scene.vertex_count(object) - 1) - a) * t;
  }
  return {point, surface_normal(scene, object, point)};
}

TYPED_TEST(GeometryLaws, ARayAimedAtASurfacePointHitsThere) {
  using Real = TypeParam;
  Random random(4);
  std::array<int, 4> aimed{};
  for (const Setting& setting : settings()) {
    const Scene scene = random_objects(setting, random, 60);
    const Geometry<Real> geometry(scene);
    for (int i = 0; i < 6000; ++i) {
      const std::uint32_t object = i % geometry.size();
      const auto [target, normal] = surface_point(scene, object, random);
      Ray<Real> ray = ray_towards<Real>(target, setting, random);
      const double speed = length(Vec3d(ray.direction));
      const double t = length(target - Vec3d(ray.origin)) / speed;
      const double steepness = std::abs(dot(normal, Vec3d(ray.direction))) / speed;
      const double error = rounding(ray, static_cast<Real>(t), max_abs(target), 8) / steepness;
      // Leave out shallow angles and objects too small to be aimed at in this precision.
      if (steepness < 0.1 || error > 1e-3 * length(Vec3d(geometry.bounds(object).extent()))) continue;
      ++aimed[static_cast<int>(geometry.kind(object))];
      // Start just before the point, so that the other side of spheres and cones is not met first.
      ray.t_min = static_cast<Real>(std::max(0.0, t - 2 * error / speed));
      EXPECT_NEAR(geometry.hit_distance(object, ray) * speed, t * speed, error)
          << "object " << object << " at scale " << setting.scale;
    }
  }
  EXPECT_THAT(aimed, testing::Each(testing::Gt(10'000)));
}

TYPED_TEST(GeometryLaws, ABoxAroundAHitPointOverlapsTheSurface) {
  using Real = TypeParam;
  Random random(5);
  for (const Setting& setting : settings()) {
    const Geometry<Real> geometry(random_objects(setting, random, 60));
    const double largest = std::max(max_abs(geometry.bounds().lo), max_abs(geometry.bounds().hi));
    for (int i = 0; i < 6000; ++i) {
      const std::uint32_t object = i % geometry.size();
      const auto ray = ray_towards<Real>(random_point_in(geometry.bounds(object), random), setting, random);
      const Real t = geometry.hit_distance(object, ray);
      if (t == kMiss<Real>) continue;
      const Real margin = static_cast<Real>(rounding(ray, t, largest, 32));
      const Vec3<Real> hit = ray.at(t), around{margin, margin, margin};
      ASSERT_TRUE(geometry.overlaps(object, {hit - around, hit + around})) << "object " << object;
    }
  }
}

TYPED_TEST(GeometryLaws, ABoxBeyondTheTangentPlaneDoesNotOverlap) {
  using Real = TypeParam;
  Random random(6);
  const Scene scene = random_objects({1, {0, 0, 0}, 2}, random, 400);
  const Geometry<Real> geometry(scene);
  for (int i = 0; i < 20'000; ++i) {
    const std::uint32_t object = i % geometry.size();
    const auto [point, normal] = surface_point(scene, object, random);
    const Vec3d half{uniform(random, 0, 0.05), uniform(random, 0, 0.05), uniform(random, 0, 0.05)};
    const auto box_at = [&](const Vec3d& centre) {
      return Box<Real>{Vec3<Real>(centre - half), Vec3<Real>(centre + half)};
    };
    const auto offset = [&](double extent) { return uniform(random, -0.99, 0.99) * extent; };
    ASSERT_TRUE(
        geometry.overlaps(object, box_at(point + Vec3d{offset(half.x), offset(half.y), offset(half.z)})));

    // At this distance the box touches the tangent plane. Cones are judged by their bounds and left out.
    if (geometry.kind(object) == ObjectKind::cone) continue;
    const double reach =
        std::abs(normal.x) * half.x + std::abs(normal.y) * half.y + std::abs(normal.z) * half.z;
    ASSERT_FALSE(geometry.overlaps(object, box_at(point + normal * (reach + 1e-4))));
    if (geometry.kind(object) == ObjectKind::sphere) continue;
    ASSERT_FALSE(geometry.overlaps(object, box_at(point - normal * (reach + 1e-4))));
  }
}

TYPED_TEST(GeometryLaws, BoxesBeyondAnEdgeOrInsideASphereDoNotOverlap) {
  using Real = TypeParam;
  const auto cube = [](const Vec3d& centre, double half) {
    return Box<Real>{Vec3<Real>(centre - Vec3d{half, half, half}),
                     Vec3<Real>(centre + Vec3d{half, half, half})};
  };
  // The diagonal edge x + y = 4 keeps its distance from boxes in the corner of the triangle's bounds.
  const Triangle<Real> triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  EXPECT_FALSE(surface_overlaps(triangle, cube({2.6, 2.6, 0}, 0.59)));
  EXPECT_TRUE(surface_overlaps(triangle, cube({2.6, 2.6, 0}, 0.61)));
  EXPECT_TRUE(surface_overlaps(triangle, cube({1, 1, 0.5}, 0.5))) << "touching";

  const std::vector<Vec3<Real>> square{{4, 0, 0}, {8, 4, 0}, {4, 8, 0}, {0, 4, 0}};
  const auto polygon = make_polygon<Real>(square, 0);
  EXPECT_FALSE(surface_overlaps<Real>(polygon, square, cube({1, 1, 0}, 0.99)));
  EXPECT_TRUE(surface_overlaps<Real>(polygon, square, cube({1, 1, 0}, 1.01)));

  const Sphere<Real> sphere{{0, 0, 0}, 2};
  EXPECT_FALSE(surface_overlaps(sphere, cube({0, 0, 0}, 1.15))) << "within";
  EXPECT_TRUE(surface_overlaps(sphere, cube({0, 0, 0}, 1.16))) << "its corners reach the surface";
  EXPECT_FALSE(surface_overlaps(sphere, cube({2, 2, 2}, 0.84))) << "in the corner of the bounds";
  EXPECT_TRUE(surface_overlaps(sphere, cube({2, 2, 2}, 0.85)));

  const Cone<Real> cone{{0, 0, 0}, 1, {0, 0, 4}, 1};
  EXPECT_FALSE(surface_overlaps(cone, cube({0, 0, 5}, 0.99)));
  EXPECT_TRUE(surface_overlaps(cone, cube({0, 0, 5}, 1.01)));
}

}  // namespace
}  // namespace rayshoot
