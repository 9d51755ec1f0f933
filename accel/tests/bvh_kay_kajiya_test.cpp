// What makes bvh_kay_kajiya that technique.
#include <gtest/gtest.h>

#include "accel/parts/plane_sets.h"
#include "accel/tests/built_engine.h"
#include "accel/tests/conformance.h"
#include "scenes/io/load_scene.h"

namespace rayshoot {
namespace {

constexpr const char* kPlaneSets[] = {"3", "5", "7", "9", "13"};

std::unique_ptr<Engine<double>> kay_kajiya(const Geometry<double>& geometry, const char* plane_sets,
                                           const char* hierarchy = "modeller") {
  return build("bvh_kay_kajiya", geometry, {{"plane_sets", plane_sets}, {"hierarchy", hierarchy}});
}

TEST(BvhKayKajiya, AnswersAsExhaustiveSearchWithAnyPlanesAndHierarchy) {
  for (const char* spec : {"balls:2", "gears:1", "tree:4/patches", "drum:1"}) {
    SCOPED_TRACE(spec);
    const Geometry<double> geometry(load_scene(spec).scene);
    const auto rays = nasty::rays(geometry, 1, spec[0] == 'd' ? 4 : 20);
    const auto truths = conformance::truths<double>(geometry, rays);
    for (const char* planes : kPlaneSets)
      for (const char* hierarchy : {"modeller", "automatic", "median"})
        conformance::check_engine<double>(*kay_kajiya(geometry, planes, hierarchy), rays, truths);
  }
}

TEST(BvhKayKajiya, MoreSlabsNeverTestMoreForAnyRay) {
  for (const char* spec : {"tree:5", "gears:1", "teapot:3"}) {
    const Geometry<double> geometry(load_scene(spec).scene);
    const auto rays = nasty::rays(geometry, 1, 60);
    for (const Query query : {Query::closest, Query::strict}) {
      std::vector<std::vector<std::uint32_t>> fewer(rays.size());
      std::size_t saved = 0;
      for (const char* planes : kPlaneSets) {
        const auto engine = kay_kajiya(geometry, planes);
        for (std::size_t i = 0; i < rays.size(); ++i) {
          const auto tested = candidates(*engine, query, rays[i]);
          if (planes != kPlaneSets[0]) {
            ASSERT_TRUE(std::includes(fewer[i].begin(), fewer[i].end(), tested.begin(), tested.end()))
                << spec << " ray " << i << ", " << planes << " plane sets";
            saved += fewer[i].size() - tested.size();
          }
          fewer[i] = tested;
        }
      }
      EXPECT_GT(saved, rays.size() / 10) << spec;
    }
  }
}

TEST(BvhKayKajiya, MakesItsDotProductsOnceARay) {
  const Geometry<double> geometry(load_scene("tree:5").scene);
  const auto rays = nasty::rays(geometry, 1, 30);
  for (const char* planes : kPlaneSets) {
    const Work work = counted(*kay_kajiya(geometry, planes), Query::closest, rays).work;
    EXPECT_GT(work.volume_tests, 3 * rays.size());
    EXPECT_EQ(work.events[0], rays.size() * 2 * static_cast<unsigned>(std::stoi(planes) - 3));
  }
}

/// The heap's promise: of the objects that a ray would test without stopping, it tests those alone whose volumes begin
/// no farther than the hit.
TEST(BvhKayKajiya, TestsNothingThatTheNearestHitHides) {
  for (const char* spec : {"balls:2", "tree:5", "teapot:3"}) {
    const Geometry<double> geometry(load_scene(spec).scene);
    const auto engine = kay_kajiya(geometry, "7");
    std::size_t hidden = 0;
    for (Ray<double> ray : nasty::rays(geometry, 1, 60)) {
      Hit<double> hit;
      engine->closest(std::span(&ray, 1), std::span(&hit, 1), *engine->scratch());
      if (hit.object == kNoObject) continue;
      const auto tested = candidates(*engine, Query::closest, ray);
      hidden += candidates(*engine, Query::strict, ray).size() - tested.size();
      ray.t_max = hit.t;
      ASSERT_EQ(tested, candidates(*engine, Query::strict, ray)) << spec;
    }
    EXPECT_GT(hidden, 20u) << spec;
  }
}

TEST(PlaneSets, TheSurfaceOfCutOffBoxesIsExact) {
  // A cube of side 2 cut to an octahedron by |±x ± y ± z| <= 1, and one whose corners alone are cut off.
  const Box<double> cube{{-1, -1, -1}, {1, 1, 1}};
  SlopeExtents cuts;
  cuts.lo.fill(-1), cuts.hi.fill(1);
  EXPECT_NEAR(surface_area(cube, cuts, 0), 24, 1e-9);
  EXPECT_NEAR(surface_area(cube, cuts, 4), 4 * std::sqrt(3.0), 1e-9);
  cuts.lo.fill(-2), cuts.hi.fill(2);
  const double corner = std::sqrt(3.0) / 4 * 2 - 1.5;  // the triangle that appears less those that go
  EXPECT_NEAR(surface_area(cube, cuts, 4), 24 + 8 * corner, 1e-9);
  const Box<double> flat{{0, 0, 0}, {3, 2, 0}};
  SlopeExtents around;
  for (const Vec3d corner_of : {Vec3d{0, 0, 0}, Vec3d{3, 0, 0}, Vec3d{0, 2, 0}, Vec3d{3, 2, 0}})
    around.include(SurfaceBall{corner_of});
  EXPECT_NEAR(surface_area(flat, around, kMostSlopes), 12, 1e-9);
}

TEST(PlaneSets, SlabsLoseNoHit) {
  for (const nasty::NamedScene& named : nasty::scenes())
    for (const double scale : nasty::kScales) {
      SCOPED_TRACE(named.name);
      const Geometry<float> geometry(nasty::scaled(named.scene, scale));
      for (const Ray<float>& ray : nasty::rays(geometry, scale, 20)) {
        const SlopeCrossings<float, kMostSlopes> crossings(ray, geometry.bounds());
        for (std::uint32_t object = 0; object < geometry.size(); ++object) {
          const float t = geometry.hit_distance(object, ray);
          if (t == kMiss<float>) continue;
          std::vector<SurfaceBall> balls;
          append_surface(geometry, object, balls);
          SlopeExtents extents;
          for (const SurfaceBall& ball : balls) extents.include(ball);
          std::array<float, kMostSlopes> lo, hi;
          for (int k = 0; k < kMostSlopes; ++k)
            lo[k] = static_cast<float>(extents.lo[k]), hi[k] = static_cast<float>(extents.hi[k]);
          const Interval<float> inside =
              crossings.inside({-Box<float>::infinity(), Box<float>::infinity()}, lo.data(), hi.data());
          ASSERT_TRUE(inside.enter <= t && t <= inside.exit) << object;
        }
      }
    }
}

}  // namespace
}  // namespace rayshoot
