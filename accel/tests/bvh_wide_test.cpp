// What makes bvh_wide that technique.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "accel/parts/ray_order.h"
#include "accel/parts/wide_build.h"
#include "accel/parts/wide_kernels.h"
#include "accel/tests/built_engine.h"
#include "accel/tests/conformance.h"
#include "scenes/io/load_scene.h"

namespace rayshoot {
namespace {

/// A bit of everything, but triangles mostly, so that the kernels serve it.
Scene triangles_and_others(int triangles) {
  SceneBuilder builder;
  nasty::Random random(3);
  for (int i = 0; i < triangles; ++i) {
    const Vec3d p = nasty::uniform_point(random, -4, 4);
    builder.triangle(p, p + nasty::uniform_point(random, -1, 1), p + nasty::uniform_point(random, -1, 1));
  }
  nasty::soup(builder, random, triangles / 12);
  // Ties of several objects of several kinds, the lowest of which is no triangle.
  for (int i = 0; i < 3; ++i) nasty::square(builder, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0});
  for (int i = 0; i < 9; ++i) builder.triangle({-3, -3, 0}, {6, -3, 0}, {-3, 6, 0});
  return std::move(builder).finish();
}

void check_kernels(const Scene& scene, double scale, int rays) {
  const Geometry<float> geometry(nasty::scaled(scene, scale));
  ASSERT_TRUE(geometry.mostly_triangles());
  const auto all = nasty::rays(geometry, scale, rays);
  const auto truths = conformance::truths<float>(geometry, all);
  for (const char* instructions : {"best", "avx2"})
    for (const char* mode : {"single", "batch"})
      for (const char* max_objects : {"8", "1", "5"}) {
        SCOPED_TRACE(fmt::format("{}, {}, {} objects, scaled by {}", instructions, mode, max_objects, scale));
        const Given given{{"instructions", instructions}, {"mode", mode}, {"max_objects", max_objects}};
        conformance::check_engine<float>(*build<float>("bvh_wide", geometry, given), all, truths);
        if (::testing::Test::HasFailure()) return;
      }
}

TEST(BvhWide, KernelsAnswerAsExhaustiveSearch) {
  for (const double scale : nasty::kScales)
    for (const int triangles : {40, 400}) check_kernels(triangles_and_others(triangles), scale, 150);
  for (const char* spec : {"tetra:3", "tree:3/patches", "mount:3", "lattice:1/patches"}) {
    SCOPED_TRACE(spec);
    check_kernels(load_scene(spec).scene, 1, 60);
  }
}

/// Many triangles, and polygons of four corners of all kinds, several in a leaf: convex, concave, crossing themselves, with
/// two corners or all in one place, in planes across every axis and slanted.
Scene triangles_and_quads() {
  SceneBuilder builder;
  nasty::Random random(7);
  for (int i = 0; i < 2000; ++i) {
    const Vec3d p = nasty::uniform_point(random, 5, 6);
    builder.triangle(p, p + nasty::uniform_point(random, -1, 1), p + nasty::uniform_point(random, -1, 1));
  }
  for (int i = 0; i < 90; ++i) {
    const Vec3d p = nasty::uniform_point(random, -1, 1);
    Vec3d a = nasty::uniform_point(random, -1, 1), b = nasty::uniform_point(random, -1, 1);
    if (i % 3 == 0) a[i / 3 % 3] = b[i / 3 % 3] = 0;
    const double far = i % 5 == 0 ? 0.2 : i % 5 == 1 ? -1 : i % 5 == 2 ? 0 : 1;
    builder.polygon(std::array{p, p + a, p + (a + b) * far, p + b});
  }
  for (int i = 0; i < 4; ++i) nasty::square(builder, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  return std::move(builder).finish();
}

TEST(BvhWide, TestsPolygonsOfFourCornersAtOnceAsOneByOne) {
  for (const double scale : nasty::kScales) check_kernels(triangles_and_quads(), scale, 400);
}

/// Rays of a small picture, row by row, of which some look only so far, some start late and some are no rays at all.
std::vector<Ray<float>> coherent_rays(double scale, const Vec3d& eye, const Vec3d& at) {
  std::vector<Ray<float>> rays;
  for (int row = 0; row < 12; ++row)
    for (int column = 0; column < 48; ++column) {
      const Vec3d to = at + Vec3d{column * 0.05, row * 0.13, row * 0.05};
      Ray<float> ray{.origin = Vec3<float>(eye * scale), .direction = Vec3<float>((to - eye) * scale)};
      const int kind = (row * 48 + column) % 37;
      if (row % 3 == 1 && kind == 0) ray.t_max = 1;
      if (row % 3 == 1 && kind == 9) ray.t_min = 0.9f;
      if (row % 3 == 2 && kind == 3) ray.direction.y = std::numeric_limits<float>::quiet_NaN();
      if (row % 3 == 2 && kind == 7) ray.t_max = -1;
      rays.push_back(ray);
    }
  return rays;
}

TEST(BvhWide, PacketsAnswerAsExhaustiveSearch) {
  const Scene scene = triangles_and_others(400);
  for (const double scale : nasty::kScales) {
    const Geometry<float> geometry(nasty::scaled(scene, scale));
    // From afar, from within, and along the axes, where directions change sides within a row.
    for (const auto& [eye, at] : {std::pair<Vec3d, Vec3d>{{9, 7, 8}, {-2, -1, 0}},
                                  {{0.3, 0.2, 0.1}, {1, 2, 3}},
                                  {{0, -9, 0.4}, {-1.2, 0, 0}},
                                  {{300, 200, 100}, {-1, -1, -1}}}) {
      const auto rays = coherent_rays(scale, eye, at);
      const auto truths = conformance::truths<float>(geometry, rays);
      for (const char* instructions : {"best", "avx2"}) {
        SCOPED_TRACE(fmt::format("{}, scaled by {}, from {}", instructions, scale, eye.x));
        const Given given{{"instructions", instructions}, {"mode", "batch"}};
        conformance::check_engine<float>(*build<float>("bvh_wide", geometry, given), rays, truths);
        ASSERT_FALSE(::testing::Test::HasFailure());
      }
    }
  }
}

/// Needles through and through a cube.
Scene needles(int count) {
  SceneBuilder builder;
  nasty::Random random(5);
  for (int i = 0; i < count; ++i) {
    const Vec3d from = nasty::uniform_point(random, -1, 1), to = nasty::uniform_point(random, -1, 1);
    builder.triangle(from, to, to + nasty::uniform_point(random, -1, 1) * 1e-3);
  }
  return std::move(builder).finish();
}

template <class Real>
void check_needles(const Scene& scene) {
  for (const double scale : nasty::kScales) {
    const Geometry<Real> geometry(nasty::scaled(scene, scale));
    auto rays = nasty::rays(geometry, scale, 60);
    // From so far away that hits are rounded to places beside their pieces.
    for (std::size_t i = 0; i < 40; ++i) {
      const Vec3<Real> corner = geometry.triangle(static_cast<std::uint32_t>(i)).b;
      const Vec3<Real> eye = Vec3<Real>(Vec3d{3e5, 2e5, 1e5 * static_cast<double>(i)} * scale);
      rays.push_back({.origin = eye, .direction = corner - eye});
    }
    const auto truths = conformance::truths<Real>(geometry, rays);
    for (const char* mode : {"single", "batch"}) {
      SCOPED_TRACE(fmt::format("{}, scaled by {}", mode, scale));
      conformance::check_engine<Real>(*build<Real>("bvh_wide", geometry, {{"mode", mode}}), rays, truths);
      ASSERT_FALSE(::testing::Test::HasFailure());
    }
  }
}

TEST(BvhWide, CutsNeedlesAndAnswersAsExhaustiveSearch) {
  const Scene scene = needles(3000);
  check_needles<float>(scene);
  check_needles<double>(scene);
}

TEST(BvhWide, CutsWhatIsMostlyVoidWhereRaysMeetMuchOfIt) {
  const Geometry<float> many(needles(3000)), few(needles(200)), mesh(load_scene("mount:4").scene);
  const auto references = [](const Geometry<float>& geometry, const char* budget) {
    return build<float>("bvh_wide", geometry, {{"split_budget", budget}})->structure().references;
  };
  EXPECT_EQ(references(many, "0"), 3000u);
  EXPECT_GT(references(many, "3"), 3000u * 3);
  EXPECT_LE(references(many, "3"), 3000u * 4);
  EXPECT_EQ(references(few, "3"), 200u);
  EXPECT_EQ(references(mesh, "3"), mesh.size());

  const auto rays = coherent_rays(1, {3, 2.5, 2}, {-1.2, -0.8, 0});
  const auto tests = [&](const char* budget) {
    return counted(*build<float>("bvh_wide", many, {{"split_budget", budget}}), Query::closest, rays)
        .work.object_tests;
  };
  EXPECT_LT(2 * tests("5"), tests("0"));
}

TEST(RayOrder, IsAPermutationInWhichNeighboursAreAlike) {
  nasty::Random random(7);
  std::vector<Ray<float>> rays;
  for (int i = 0; i < 5000; ++i)
    rays.push_back({.origin = Vec3<float>(nasty::uniform_point(random, 0, 1)),
                    .direction = Vec3<float>(nasty::uniform_point(random, -1, 1))});
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  rays.push_back({.origin = {nan, 0, 1e30f}, .direction = {0, nan, 0}});
  rays.push_back({.origin = {-5, 1e38f, 0}, .direction = {0, 0, 0}});
  RayOrder order;
  const auto sorted = order.sorted(rays, {{0, 0, 0}, {1, 1, 1}});
  EXPECT_EQ(std::set<std::uint32_t>(sorted.begin(), sorted.end()).size(), rays.size());
  const auto mean_step = [&](const auto& number) {
    double sum = 0;
    for (std::uint32_t i = 1; i < 5000; ++i) {
      const std::uint32_t a = number(i - 1), b = number(i);
      if (std::max(a, b) < 5000) sum += length(Vec3d(rays[a].origin - rays[b].origin));
    }
    return sum / 5000;
  };
  EXPECT_LT(3 * mean_step([&](std::uint32_t i) { return sorted[i]; }),
            mean_step([](std::uint32_t i) { return i; }));
}

TEST(RayOrder, LeavesRaysThatMissToTheEndAndSortsOthersByWhereTheyComeIn) {
  // From afar through the middle of the unit cube's cells, and past it.
  std::vector<Ray<float>> rays;
  for (const float x : {0.9f, 7.0f, 0.1f, -3.0f})
    rays.push_back({.origin = {x, 0.1f, -50}, .direction = {0, 0, 1}});
  for (const float x : {0.9f, 0.1f}) rays.push_back({.origin = {x - 50, 0.1f, 50}, .direction = {1, 0, -1}});
  rays.push_back({.origin = {0.5f, 0.1f, -50}, .direction = {0, 0, 1}, .t_max = 49});
  RayOrder order;
  const auto sorted = order.sorted(rays, {{0, 0, 0}, {1, 1, 1}});
  const std::vector<std::uint32_t> first(sorted.begin(), sorted.begin() + 4);
  EXPECT_THAT(first, ::testing::ElementsAre(2, 5, 0, 4));
  EXPECT_THAT(std::vector(sorted.begin() + 4, sorted.end()), ::testing::UnorderedElementsAre(1, 3, 6));
}

TEST(BvhWide, TakesFewerStepsThanABinaryTree) {
  for (const char* spec : {"balls:2/patches", "tree:4/patches", "mount:5"}) {
    const Geometry<float> geometry(load_scene(spec).scene);
    const auto rays = nasty::rays(geometry, 1, 300);
    const Counted<float> wide = counted(*build<float>("bvh_wide", geometry), Query::closest, rays);
    const Counted<float> binary = counted(*build<float>("bvh_sah", geometry), Query::closest, rays);
    EXPECT_EQ(wide.hits, binary.hits);
    EXPECT_LT(2 * wide.work.steps, binary.work.steps) << spec;
  }
}

TEST(BvhWide, SeeksAnyHitWithoutOrderAndStopsAtTheFirst) {
  const Geometry<float> geometry(load_scene("mount:4").scene);
  const auto rays = nasty::rays(geometry, 1, 300);
  const auto engine = build<float>("bvh_wide", geometry);
  const Work any = counted(*engine, Query::any, rays).work,
             closest = counted(*engine, Query::closest, rays).work,
             strict = counted(*engine, Query::strict, rays).work;
  EXPECT_LT(any.object_tests, closest.object_tests);
  EXPECT_LT(closest.object_tests, strict.object_tests);
  EXPECT_LT(any.steps, strict.steps);
}

/// What the widened tree is expected to cost, in tests of a node's children.
double expected_cost(const Engine<float>& engine, double leaf_cost) {
  const auto figures = engine.structure().figures;
  return figures.at("expected_steps") + leaf_cost * figures.at("expected_leaves");
}

TEST(BvhWide, MoreChoiceNeverCostsMore) {
  const Geometry<float> geometry(load_scene("mount:5/patches").scene);
  double least = std::numeric_limits<double>::infinity();
  for (const char* max_objects : {"1", "2", "3", "4", "5", "6", "7", "8"}) {
    const auto engine =
        build<float>("bvh_wide", geometry, {{"max_objects", max_objects}, {"leaf_cost", "2"}});
    EXPECT_LE(expected_cost(*engine, 2), least * 1.00001);
    least = expected_cost(*engine, 2);
  }
  // Of two trees each is the cheaper one by the costs that it was made for.
  const auto cheap = build<float>("bvh_wide", geometry, {{"leaf_cost", "0.5"}});
  const auto dear = build<float>("bvh_wide", geometry, {{"leaf_cost", "5"}});
  EXPECT_LT(expected_cost(*cheap, 0.5), expected_cost(*dear, 0.5));
  EXPECT_LT(expected_cost(*dear, 5), expected_cost(*cheap, 5));
}

TEST(BvhWide, NoTreeMadeOfASmallBinaryOneIsCheaper) {
  // Eight distant clusters of eight: a root over eight full leaves is the best there is.
  SceneBuilder builder;
  for (int i = 0; i < 64; ++i) {
    const Vec3d corner{(i & 1) * 1000.0 + i / 8 * 0.01, (i >> 1 & 1) * 1000.0, (i >> 2 & 1) * 1000.0};
    builder.triangle(corner, corner + Vec3d{0.01, 0, 0}, corner + Vec3d{0, 0.01, 0.01});
  }
  const Scene scene = std::move(builder).finish();
  const Geometry<float> geometry(scene);
  const StructureStats stats = build<float>("bvh_wide", geometry)->structure();
  EXPECT_EQ(stats.nodes, 9u);
  EXPECT_EQ(stats.leaves, 8u);
  EXPECT_EQ(stats.max_depth, 1u);
}

TEST(BvhWide, DepthStaysBoundedWhereCentresCoincideOrShrinkForEver) {
  SceneBuilder builder;
  for (int i = 0; i < 20'000; ++i) builder.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  for (int i = 0; i < 900; ++i) builder.sphere({std::ldexp(1, -i), 0, 0}, std::ldexp(1, -i - 2));
  const Scene scene = std::move(builder).finish();
  const Geometry<double> geometry(scene);
  EXPECT_LE(build("bvh_wide", geometry)->structure().max_depth, 80u);
}

TEST(BvhWide, MakesKernelsOnlyForWhatTheyServe) {
  // Triangles are stored a second time for the kernels alone.
  const Scene curved = soup_scene(1000), triangles = load_scene("tetra:4").scene;
  const auto bytes_an_object = [](const auto& geometry) {
    const StructureStats stats = build("bvh_wide", geometry)->structure();
    return static_cast<double>(stats.bytes) / static_cast<double>(stats.references);
  };
  const double of_triangles = bytes_an_object(Geometry<float>(triangles));
  EXPECT_GT(of_triangles, 44);
  EXPECT_LT(bytes_an_object(Geometry<float>(triangles, ConeSides::both, Intersector::watertight)),
            of_triangles - 30);
}

}  // namespace
}  // namespace rayshoot
