#include <gmock/gmock.h>
#include <immintrin.h>

#include "accel/tests/nasty_scenes.h"
#include "accel/tests/scene_conformance.h"
#include "harness/baseline/baselines.h"
#include "harness/baseline/embree_scene.h"
#include "scenes/io/load_scene.h"

namespace rayshoot {
namespace {

using conformance::Variant;

const TechniqueEntry& baseline(const std::string& id) {
  for (const TechniqueEntry* entry : baseline_entries())
    if (entry->info.id == id) return *entry;
  throw InputError("no baseline " + id);
}

/// Lines through the scene, most of which hit something.
template <class Real>
std::vector<Ray<Real>> lines(const Geometry<Real>& geometry, int count) {
  nasty::Random random(5);
  const Vec3d lo(geometry.bounds().lo), extent(geometry.bounds().extent());
  const auto inside = [&] {
    const Vec3d u = nasty::uniform_point(random, 0, 1);
    return lo + Vec3d{u.x * extent.x, u.y * extent.y, u.z * extent.z};
  };
  std::vector<Ray<Real>> rays;
  for (int i = 0; i < count; ++i) {
    const Vec3d from = inside() + extent * (i % 2), to = inside();
    rays.push_back({.origin = Vec3<Real>(from), .direction = Vec3<Real>(to - from)});
  }
  return rays;
}

template <class Real>
std::vector<Hit<Real>> exhaustive_hits(const Geometry<Real>& geometry, std::span<const Ray<Real>> rays) {
  std::vector<Hit<Real>> hits;
  for (const auto& truth : conformance::truths<Real>(geometry, rays)) hits.push_back(truth.nearest);
  return hits;
}

std::unique_ptr<Engine<float>> build(const Variant& variant, const Geometry<float>& geometry) {
  const Arguments arguments = variant.arguments();
  return variant.entry->build<float>({geometry, arguments});
}

// Zero overhead ---------------------------------------------------------------------------------------------

template <class Real>
class ZeroOverhead : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(ZeroOverhead, Scalars);

TYPED_TEST(ZeroOverhead, TestsOneObjectForEachRayThatHits) {
  using Real = TypeParam;
  for (const char* spec : {"balls:1/patches", "balls:2", "rings:1"}) {
    const Geometry<Real> geometry(load_scene(spec).scene);
    const std::vector<Ray<Real>> rays = lines(geometry, 500);
    const std::vector<Hit<Real>> known = exhaustive_hits<Real>(geometry, rays);
    const RecordedHits<Real> recorded{rays, known};
    const Arguments none;
    const auto engine = baseline("zero_overhead").build<Real>({geometry, none, &recorded});
    ThreadScratch<Real> scratch(*engine);

    std::vector<Hit<Real>> hits(rays.size());
    const Work work = count_work<Real>(*engine, Query::closest, rays, hits, scratch, 2).total;
    const auto count = static_cast<std::uint64_t>(
        std::count_if(known.begin(), known.end(), [](const auto& hit) { return hit.object != kNoObject; }));
    EXPECT_EQ(hits, known);
    EXPECT_GT(count, 50u);
    EXPECT_EQ(work, (Work{.rays = rays.size(), .object_tests = count, .distinct_objects = count}));

    // A part of the rays finds its own hits.
    const std::span<const Ray<Real>> part = std::span<const Ray<Real>>(rays).subspan(100, 200);
    std::vector<std::uint8_t> blocked(part.size());
    trace_any<Real>(*engine, part, blocked, scratch, 1);
    for (std::size_t i = 0; i < part.size(); ++i) {
      EXPECT_EQ(blocked[i] != 0, known[100 + i].object != kNoObject);
      EXPECT_EQ(engine->candidates(Query::closest, part[i], scratch.local()).size(), blocked[i]);
    }
  }
}

TYPED_TEST(ZeroOverhead, KnowsOnlyTheRecordedRays) {
  using Real = TypeParam;
  const Geometry<Real> geometry(load_scene("balls:1").scene);
  const std::vector<Ray<Real>> rays = lines(geometry, 10), others = rays;
  const std::vector<Hit<Real>> known = exhaustive_hits<Real>(geometry, rays);
  const RecordedHits<Real> recorded{rays, known};
  const Arguments none;
  EXPECT_THROW(baseline("zero_overhead").build<Real>({geometry, none}), InputError);
  const auto engine = baseline("zero_overhead").build<Real>({geometry, none, &recorded});
  const auto scratch = engine->scratch();
  std::vector<Hit<Real>> hits(rays.size());
  EXPECT_THROW(engine->closest(others, hits, *scratch), std::logic_error);
}

// Embree's tree over our objects ----------------------------------------------------------------------------

void check_embree_user(const Geometry<float>& geometry, std::span<const Ray<float>> rays) {
  const auto truths = conformance::truths<float>(geometry, rays);
  for (const Variant& variant : conformance::variants(baseline("embree_user"))) {
    SCOPED_TRACE(variant.name());
    conformance::check_engine<float>(*build(variant, geometry), rays, truths);
  }
}

TEST(EmbreeUser, EqualsExhaustiveSearchOnNastyScenes) {
  for (const nasty::NamedScene& named : nasty::scenes())
    for (const double scale : nasty::kScales) {
      SCOPED_TRACE(fmt::format("'{}' scaled by {}", named.name, scale));
      const Geometry<float> geometry(nasty::scaled(named.scene, scale));
      check_embree_user(geometry, nasty::rays(geometry, scale, 150));
      if (HasFailure()) return;
    }
}

class EmbreeUserOnScene : public ::testing::TestWithParam<const SceneGenerator*> {};

TEST_P(EmbreeUserOnScene, EqualsExhaustiveSearch) {
  const TechniqueEntry* const entries[] = {&baseline("embree_user")};
  for (const SceneForm form : {SceneForm::curves, SceneForm::patches})
    conformance::check_scene(*GetParam(), form, entries);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EmbreeUserOnScene, conformance::every_scene(), conformance::scene_name);

/// Scenes of coplanar and repeated objects far from the origin and far from 1 in size, seen from near and far
/// along directions of any length with components that vanish: what Embree's culling gets wrong by itself.
TEST(EmbreeUser, EqualsExhaustiveSearchAtEveryScaleAndDistance) {
  nasty::Random random(17);
  const auto magnitude = [&](double lo, double hi) { return std::pow(10, nasty::uniform(random, lo, hi)); };
  for (int round = 0; round < 150; ++round) {
    const double scale = round % 5 == 0 ? magnitude(-30, 15) : magnitude(-6, 6);
    const Vec3d shift = nasty::uniform_point(random, -1, 1) * (round % 3 == 0 ? 0 : scale * magnitude(-2, 5));
    SceneBuilder builder;
    const auto place = [&](const Vec3d& p) { return p * scale + shift; };
    for (int i = 0; i < 60; ++i) {
      const Vec3d p = nasty::lattice_point(random, -4, 4), q = nasty::uniform_point(random, -1, 1);
      nasty::square(builder, place(p), Vec3d{scale, 0, 0}, Vec3d{0, scale, 0});
      builder.triangle(place(p), place(p + q), place(p + Vec3d{0, 1, 0}));
      if (i % 4 == 0) builder.sphere(place(p), scale / 2), builder.sphere(place(p), scale / 2);
      if (i % 4 == 1) builder.cone(place(p), scale / 3, place(p + q), scale / 4);
    }
    const Geometry<float> geometry(std::move(builder).finish());
    std::vector<Ray<float>> rays;
    for (int i = 0; i < 400; ++i) {
      Vec3d from = nasty::lattice_point(random, -6, 6), to = nasty::lattice_point(random, -4, 4);
      if (i % 3 == 0) from = nasty::uniform_point(random, -6, 6), to = nasty::uniform_point(random, -4, 4);
      if (i % 8 == 0) from *= magnitude(0, 8);
      Vec3d direction = (to - from) * magnitude(-3, 3);
      if (i % 5 == 0) direction[i % 3] *= i % 2 ? -0.0 : magnitude(-40, -1);
      if (i % 20 == 0) direction *= magnitude(-30, 30);
      rays.push_back({.origin = Vec3<float>(place(from)), .direction = Vec3<float>(direction)});
    }
    SCOPED_TRACE(fmt::format("round {}: scaled by {} and moved by {}", round, scale, shift.x));
    check_embree_user(geometry, rays);
    if (HasFailure()) return;
  }
}

/// Many objects at the smallest distance there is, side by side in either order: the lowest must win.
TEST(EmbreeUser, RoundsNothingAwayNextToTheOrigin) {
  for (const double step : {0.01, -0.01}) {
    SceneBuilder builder;
    for (int i = 0; i < 40; ++i) {
      const double x = step * i - 1;
      builder.triangle({x, -1, 1e-45}, {x + 4, -1, 1e-45}, {x, 3, 1e-45});
    }
    const Geometry<float> geometry(std::move(builder).finish());
    const std::vector<Ray<float>> rays{{.origin = {0, 0, 0}, .direction = {0, 0, 1}}};
    ASSERT_EQ(geometry.hit_distance(0, rays[0]), 1e-45f);
    check_embree_user(geometry, rays);
  }
}

// Embree ----------------------------------------------------------------------------------------------------

/// Number of rays whose hits differ by more than rounding.
int differing_rays(const Variant& variant, const Geometry<float>& geometry, std::span<const Ray<float>> rays,
                   std::span<const Hit<float>> known) {
  const auto engine = build(variant, geometry);
  const auto scratch = engine->scratch();
  std::vector<Hit<float>> hits(rays.size());
  std::vector<std::uint8_t> blocked(rays.size());
  engine->closest(rays, hits, *scratch);
  engine->any(rays, blocked, *scratch);
  int differing = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool hit = known[i].object != kNoObject;
    const bool same_t =
        hit && hits[i].object != kNoObject && std::abs(hits[i].t - known[i].t) <= 1e-4f * known[i].t;
    const bool same = hit ? same_t && blocked[i] : hits[i].object == kNoObject && !blocked[i];
    differing += !same;
    if (same_t && hits[i].object != known[i].object) {
      // Another object at the same distance is one that the ray does hit there.
      EXPECT_NEAR(geometry.hit_distance(hits[i].object, rays[i]), known[i].t, 1e-4f * known[i].t);
    }
  }
  return differing;
}

double share_of_differing(const Variant& variant, const Geometry<float>& geometry,
                          std::span<const Ray<float>> rays, std::span<const Hit<float>> known) {
  return differing_rays(variant, geometry, rays, known) / static_cast<double>(rays.size());
}

TEST(Embree, AgreesWithExhaustiveSearchButForRounding) {
  for (const char* spec :
       {"balls:2", "balls:1/patches", "gears:1", "tetra:4", "rings:1", "tree:4", "mount:4"}) {
    const Geometry<float> geometry(load_scene(spec).scene);
    const std::vector<Ray<float>> rays = lines(geometry, 2005);
    const std::vector<Hit<float>> known = exhaustive_hits<float>(geometry, rays);
    std::vector<Variant> variants = conformance::variants(baseline("embree"));
    std::erase_if(variants, [](const Variant& variant) { return variant.given.contains("coherent"); });
    for (const char* mode : {"stream", "packet"})
      variants.push_back({&baseline("embree"), {{"mode", mode}, {"coherent", "on"}, {"spheres", "user"}}});
    for (const Variant& variant : variants) {
      SCOPED_TRACE(fmt::format("{} on {}", variant.name(), spec));
      EXPECT_LE(share_of_differing(variant, geometry, rays, known), 0.002);
    }
  }
}

TEST(Embree, LeavesPolygonsThatCrossThemselvesToOurTest) {
  SceneBuilder builder;
  builder.polygon(std::array{Vec3d{0, 0, 0}, Vec3d{4, 4, 0}, Vec3d{4, 0, 0}, Vec3d{0, 3, 0}});
  builder.triangle({0, 0, -1}, {4, 0, -1}, {0, 4, -1});
  const Geometry<float> geometry(std::move(builder).finish());
  std::vector<Ray<float>> rays;
  for (float x = 0.05f; x < 4; x += 0.1f)
    for (float y = 0.07f; y < 4; y += 0.1f) rays.push_back({.origin = {x, y, 5}, .direction = {0, 0, -1}});
  const std::vector<Hit<float>> known = exhaustive_hits<float>(geometry, rays);
  EXPECT_LE(share_of_differing({&baseline("embree"), {}}, geometry, rays, known), 0.002);
}

TEST(Embree, MissesWithNonsenseRays) {
  constexpr float inf = kMiss<float>, nan = std::numeric_limits<float>::quiet_NaN();
  const Geometry<float> geometry(load_scene("balls:1").scene);
  std::vector<Ray<float>> rays;
  for (const float bad : {nan, inf, -inf, 2e18f, -3e38f})
    for (int axis = 0; axis < 3; ++axis) {
      Ray<float> far{.origin = {0, 0, 5}, .direction = {0, 0, -1}}, fast = far;
      far.origin[axis] = bad, fast.direction[axis] = bad;
      rays.insert(rays.end(), {far, fast});
    }
  for (const auto& [first, last] :
       {std::pair{nan, 1.f}, {0.f, nan}, {-1.f, 1.f}, {3.f, 2.f}, {inf, inf}, {0.f, -1.f}})
    rays.push_back({.origin = {0, 0, 5}, .t_min = first, .direction = {0, 0, -1}, .t_max = last});
  for (const char* mode : {"single", "stream", "packet"}) {
    const auto engine = build({&baseline("embree"), {{"mode", mode}}}, geometry);
    const auto scratch = engine->scratch();
    std::vector<Hit<float>> hits(rays.size(), Hit<float>{1, 1});
    std::vector<std::uint8_t> blocked(rays.size(), 1);
    engine->closest(rays, hits, *scratch);
    engine->any(rays, blocked, *scratch);
    EXPECT_THAT(hits, ::testing::Each(Hit<float>{}));
    EXPECT_THAT(blocked, ::testing::Each(0));
  }
}

TEST(Embree, TracesAnyNumberOfRaysWithNonsenseAmongThem) {
  for (const char* spec : {"mount:4", "rings:1"}) {
    const Geometry<float> geometry(load_scene(spec).scene);
    std::vector<Ray<float>> rays = lines(geometry, 35);
    for (std::size_t i = 0; i < rays.size(); i += 3) rays[i].origin.y = kMiss<float>;
    const std::vector<Hit<float>> known = exhaustive_hits<float>(geometry, rays);
    const std::span<const Ray<float>> all = rays;
    for (const char* mode : {"single", "stream", "packet"})
      for (std::size_t count = 0; count <= rays.size(); ++count) {
        SCOPED_TRACE(fmt::format("{} rays, mode={} on {}", count, mode, spec));
        EXPECT_EQ(differing_rays({&baseline("embree"), {{"mode", mode}}}, geometry, all.first(count), known),
                  0);
      }
  }
}

TEST(Embree, IntervalsAreOpenAtTheirStartAndClosedAtTheirEnd) {
  SceneBuilder builder;
  builder.triangle({-1, -1, 0}, {3, -1, 0}, {-1, 3, 0});
  const Geometry<float> geometry(std::move(builder).finish());
  const std::vector<Ray<float>> rays{{.origin = {0, 0, 2}, .t_min = 2, .direction = {0, 0, -1}},
                                     {.origin = {0, 0, 2}, .direction = {0, 0, -1}, .t_max = 2}};
  for (const char* mode : {"single", "stream", "packet"}) {
    const auto engine = build({&baseline("embree"), {{"mode", mode}}}, geometry);
    std::vector<Hit<float>> hits(2);
    engine->closest(rays, hits, *engine->scratch());
    EXPECT_EQ(hits[0], Hit<float>{}) << mode;
    EXPECT_EQ(hits[1], (Hit<float>{2, 0})) << mode;
  }
}

TEST(Embree, FlushesDenormalNumbersOnlyWhenAskedAndOnlyWhileTracing) {
  const Geometry<float> geometry(nasty::scaled(load_scene("tetra:3").scene, 1e-13));
  const std::vector<Ray<float>> rays = lines(geometry, 500);
  const auto hit_count = [&](const char* flush) {
    const auto engine = build({&baseline("embree"), {{"flush_to_zero", flush}, {"robust", "on"}}}, geometry);
    std::vector<Hit<float>> hits(rays.size());
    const unsigned control = _mm_getcsr();
    engine->closest(rays, hits, *engine->scratch());
    EXPECT_EQ(_mm_getcsr() & 0x8040u, control & 0x8040u);
    return std::count_if(hits.begin(), hits.end(), [](const auto& hit) { return hit.object != kNoObject; });
  };
  EXPECT_GT(hit_count("off"), 50);
  EXPECT_EQ(hit_count("on"), 0);
}

TEST(Embree, BuildsAnotherTreeForEveryQuality) {
  const Geometry<float> geometry(load_scene("mount:5").scene);
  std::set<std::uint64_t> bytes;
  for (const char* quality : {"low", "medium", "high"}) {
    const auto engine = build({&baseline("embree"), {{"quality", quality}}}, geometry);
    bytes.insert(engine->structure().bytes);
    EXPECT_GT(engine->structure().bytes, 40u * geometry.size());
    EXPECT_LT(engine->structure().bytes, 200u * geometry.size());
    EXPECT_FALSE(engine->countable());
  }
  EXPECT_EQ(bytes.size(), 3u);
}

TEST(Embree, RefusesCoherenceOfSingleRays) {
  const Geometry<float> geometry(load_scene("balls:1").scene);
  EXPECT_THROW(build({&baseline("embree"), {{"coherent", "on"}}}, geometry), InputError);
}

/// A ray that an assertion of Embree's forbids ends a program that has them.
TEST(EmbreeDeathTest, AbortsWhereItHasAssertions) {
  const auto trace_nonsense = [] {
    EmbreeGeometry mesh(RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = mesh.buffer<Vec3<float>>(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 3);
    vertices[0] = {0, 0, 0}, vertices[1] = {1, 0, 0}, vertices[2] = {0, 1, 0};
    *mesh.buffer<std::array<unsigned, 3>>(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, 1) = {0, 1, 2};
    EmbreeScene scene(RTC_BUILD_QUALITY_MEDIUM, false);
    scene.attach(mesh, 0);
    scene.build();
    RTCRayHit ray{.ray = {.org_x = std::numeric_limits<float>::quiet_NaN(), .dir_x = 1, .tfar = 1},
                  .hit = {}};
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene.get(), &context, &ray);
    std::_Exit(0);
  };
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  if (embree_has_assertions())
    EXPECT_DEATH(trace_nonsense(), "Assertion");
  else
    EXPECT_EXIT(trace_nonsense(), ::testing::ExitedWithCode(0), "");
}

TEST(Baselines, AreListedWithTheVersionOfEmbree) {
  std::vector<std::string> ids;
  for (const TechniqueEntry* entry : baseline_entries()) {
    ids.push_back(entry->info.id);
    EXPECT_TRUE(entry->info.baseline);
  }
  EXPECT_THAT(ids, ::testing::ElementsAre("embree", "embree_user", "zero_overhead"));
  EXPECT_THAT(embree_version(), ::testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
}

}  // namespace
}  // namespace rayshoot
