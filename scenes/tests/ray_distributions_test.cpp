#include <gmock/gmock.h>

#include "scenes/core/scene_builder.h"
#include "scenes/rays/load_rays.h"
#include "scenes/tests/exhaustive_tracer.h"

namespace rayshoot {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A ball and a cone over a floor far from the origin, two lights, one of them below the floor.
Scene small_scene() {
  SceneBuilder builder;
  builder.view({.from = {104, 101, 103}, .at = {100, 100, 100.5}, .up = {0, 0, 1}, .angle = 45});
  builder.light({103, 99, 105}), builder.light({100, 100, 98});
  builder.material({.diffuse = 0.5, .specular = 0.5});
  builder.polygon(
      std::array{Vec3d{98, 98, 99.5}, Vec3d{102, 98, 99.5}, Vec3d{102, 102, 99.5}, Vec3d{98, 102, 99.5}});
  builder.sphere({100.3, 100.1, 100}, 0.4);
  builder.material({.diffuse = 0.1, .transmittance = 0.9, .index_of_refraction = 1.3});
  builder.cone({99.5, 100.2, 99.7}, 0.4, {99.4, 100, 101}, 0.2);
  return std::move(builder).finish();
}

RaySet rays_of(const std::string& spec, std::uint64_t seed = 1, const Scene& scene = small_scene()) {
  const RaySpec rays = resolve_rays(spec);
  return make_rays(rays, scene, ExhaustiveTracer(scene, rays.cone_sides()), seed);
}

std::string error_of(const auto& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

class EveryDistribution : public testing::TestWithParam<const char*> {};

TEST_P(EveryDistribution, HoldsTogether) {
  const RaySet set = rays_of(GetParam());
  ASSERT_GT(set.rays.size(), 0u);
  EXPECT_EQ(set.origins.size(), set.rays.size());
  EXPECT_LE(set.closest_rays, set.rays.size());
  for (std::size_t i = 0; i < set.rays.size(); ++i) {
    const Ray<double>& ray = set.rays[i];
    EXPECT_NEAR(length(ray.direction), 1, 1e-12);
    EXPECT_GE(ray.t_min, 0);
    EXPECT_LT(ray.t_min, ray.t_max);
    const RayKind kind = set.origins[i].kind;
    EXPECT_EQ(i >= set.closest_rays, kind == RayKind::shadow || kind == RayKind::light);
    const bool starts_on_surface = kind == RayKind::shadow || kind == RayKind::reflected ||
                                   kind == RayKind::refracted || kind == RayKind::diffuse;
    EXPECT_EQ(set.origins[i].source_object != kNoObject, starts_on_surface);
  }
}

TEST_P(EveryDistribution, DependsOnItsSeedAlone) {
  EXPECT_EQ(rays_of(GetParam(), 7).hash(), rays_of(GetParam(), 7).hash());
  const std::string name = GetParam();
  const bool random = !name.starts_with("whitted") && name != "primary@9" && name != "light@9";
  EXPECT_EQ(rays_of(name, 7).hash() != rays_of(name, 8).hash(), random);
}

TEST_P(EveryDistribution, CopesWithAnEmptyScene) {
  const Scene empty{.lights = {{{1, 2, 3}, {}}}};
  for (const Ray<double>& ray : rays_of(GetParam(), 1, empty).rays) {
    EXPECT_TRUE(is_finite(ray.origin));
    EXPECT_TRUE(is_finite(ray.direction));
  }
}

TEST_P(EveryDistribution, HasACanonicalNameThatMeansItself) {
  const RaySpec spec = resolve_rays(GetParam());
  EXPECT_EQ(resolve_rays(spec.id).id, spec.id);
  EXPECT_EQ(rays_of(spec.id).id, spec.id);
}

INSTANTIATE_TEST_SUITE_P(Rays, EveryDistribution,
                         testing::Values("whitted@9", "whitted(rules=havran,resolution=9)", "primary@9",
                                         "chords(rays=50)", "points(rays=50)", "diffuse(rays=500)@9",
                                         "light@9", "light(rays=20)@9"));

TEST(Whitted, SecondaryAndShadowRaysStartWhereTheirParentsHit) {
  const Scene scene = small_scene();
  const RaySet set = rays_of("whitted@9");
  std::size_t on_source = 0, started = 0;
  const Geometry<double> geometry(scene);
  for (std::size_t i = 0; i < set.rays.size(); ++i) {
    if (set.origins[i].source_object == kNoObject) continue;
    ++started;
    // Aim at the start from outside of the source object, along its normal.
    const Vec3d normal = surface_normal(scene, set.origins[i].source_object, set.rays[i].origin);
    const Ray<double> back{.origin = set.rays[i].origin + normal * 1e-3, .direction = -normal};
    on_source += std::abs(geometry.hit_distance(set.origins[i].source_object, back) - 1e-3) < 1e-9;
  }
  EXPECT_GT(started, 100u);
  EXPECT_EQ(on_source, started);
}

TEST(Whitted, ShadowRaysEndAtTheirLight) {
  const Scene scene = small_scene();
  const RaySet set = rays_of("whitted@9");
  for (std::size_t i = set.closest_rays; i < set.rays.size(); ++i)
    EXPECT_NEAR(length(set.rays[i].at(set.rays[i].t_max) - scene.lights.at(set.origins[i].light).position), 0,
                1e-9);
}

TEST(Whitted, FirstGenerationIsPrimary) {
  const RaySet tree = rays_of("whitted@9"), primary = rays_of("primary@9");
  ASSERT_EQ(primary.rays.size(), 81u);
  EXPECT_TRUE(std::equal(primary.rays.begin(), primary.rays.end(), tree.rays.begin()));
  EXPECT_EQ(primary.counts.primary_hits, tree.counts.primary_hits);
  EXPECT_EQ(tree.origins[80].generation, 1);
  EXPECT_EQ(tree.origins[81].generation, 2);
}

TEST(Points, AreUniformInTheBoxOfTheScene) {
  const Box<double> box = small_scene().bounds();
  const RaySet set = rays_of("points(rays=20000)");
  Vec3d mean{}, direction{};
  for (const Ray<double>& ray : set.rays) {
    EXPECT_TRUE(box.contains({ray.origin, ray.origin}));
    mean += (ray.origin - box.lo) * (1.0 / 20000), direction += ray.direction * (1.0 / 20000);
  }
  // Six standard errors of the mean of a uniform number, and of a component of a unit vector.
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(mean[axis] / box.extent()[axis], 0.5, 6 * std::sqrt(1.0 / 12 / 20000));
    EXPECT_NEAR(direction[axis], 0, 6 / std::sqrt(20000.0));
  }
}

TEST(Diffuse, DirectionsFollowTheCosineAndNoRayStartsIntoItsSurface) {
  const Scene scene = small_scene();
  const RaySet set = rays_of("diffuse(rays=20000)@65");
  ASSERT_EQ(set.rays.size(), 20000u);
  double sum = 0;
  for (std::size_t i = 0; i < set.rays.size(); ++i) {
    const Vec3d normal = surface_normal(scene, set.origins[i].source_object, set.rays[i].origin);
    const double cosine = dot(normal, set.rays[i].direction);
    const double seen_from = dot(normal, scene.view.from - set.rays[i].origin);
    EXPECT_GT(cosine * seen_from, 0);
    EXPECT_NEAR(set.origins[i].cosine, std::abs(cosine), 1e-6);
    sum += std::abs(cosine);
  }
  // The mean of the cosine is 2/3, its variance 1/18.
  EXPECT_NEAR(sum / 20000, 2.0 / 3, 6 * std::sqrt(1.0 / 18 / 20000));
}

TEST(Diffuse, NeighboursStartFarApart) {
  const auto mean_step = [](const RaySet& set) {
    double sum = 0;
    for (std::size_t i = 1; i < set.rays.size(); ++i)
      sum += length(set.rays[i].origin - set.rays[i - 1].origin);
    return sum / static_cast<double>(set.rays.size());
  };
  RaySet shuffled = rays_of("diffuse(rays=1000)@65");
  const double before = mean_step(shuffled);
  std::sort(shuffled.rays.begin(), shuffled.rays.end(),
            [](const auto& a, const auto& b) { return a.origin.x < b.origin.x; });
  EXPECT_GT(before, 1.2 * mean_step(shuffled));
}

TEST(Light, RaysLeadToVisiblePointsThatFaceTheLightAndStopShort) {
  const Scene scene = small_scene();
  const RaySet set = rays_of("light@33");
  EXPECT_EQ(set.closest_rays, 0u);
  const ExhaustiveTracer tracer(scene);
  std::vector<std::uint8_t> blocked(set.rays.size());
  tracer.any(set.rays, blocked);
  std::size_t free = 0, ends_on_surface = 0;
  for (std::size_t i = 0; i < set.rays.size(); ++i) {
    EXPECT_EQ(set.rays[i].origin, scene.lights.at(set.origins[i].light).position);
    if (blocked[i]) continue;
    ++free;
    Ray<double> longer = set.rays[i];
    longer.t_max += 2e-7;
    std::uint8_t meets = 0;
    tracer.any({&longer, 1}, {&meets, 1});
    ends_on_surface += meets;
  }
  EXPECT_GT(free, 100u);
  EXPECT_EQ(ends_on_surface, free);
}

TEST(Light, TakesAsManyRaysAsAskedForEvenlyFromAll) {
  const RaySet all = rays_of("light@33"), some = rays_of("light(rays=50)@33");
  EXPECT_EQ(some.rays.size(), 50u);
  for (const Ray<double>& ray : some.rays) EXPECT_THAT(all.rays, testing::Contains(ray));
  EXPECT_EQ(some.origins.front().light, 0);
}

TEST(Light, IsLeftOutWhereThereIsNone) {
  Scene dark = small_scene();
  dark.lights.clear(), dark.id = "cellar";
  EXPECT_EQ(why_left_out(resolve_rays("light"), dark), "the scene has no point light");
  EXPECT_EQ(why_left_out(resolve_rays("whitted"), dark), "");
  EXPECT_EQ(why_left_out(resolve_rays("light"), small_scene()), "");
  EXPECT_THAT(error_of([&] { rays_of("light", 1, dark); }),
              AllOf(HasSubstr("cellar"), HasSubstr("no point light")));
}

TEST(RaySpecs, AreNamedByWhatDistinguishesThem) {
  EXPECT_EQ(resolve_rays("whitted").id, "whitted@513");
  EXPECT_EQ(resolve_rays("whitted(rules=havran)").id, "whitted(rules=havran)@513");
  EXPECT_EQ(resolve_rays("whitted(rules=clean,resolution=65)").id, "whitted@65");
  EXPECT_EQ(resolve_rays("chords").id, "chords(rays=100000)");
  EXPECT_EQ(resolve_rays("diffuse(rays=5)@65").id, "diffuse(rays=5)@65");
}

TEST(RaySpecs, TakeTheCallersDefaultsWhereTheyHaveTheKey) {
  const std::map<std::string, std::string> defaults = {{"resolution", "65"}, {"rules", "havran"}};
  EXPECT_EQ(resolve_rays("whitted", defaults).id, "whitted(rules=havran)@65");
  EXPECT_EQ(resolve_rays("whitted(rules=haines)@9", defaults).id, "whitted(rules=haines)@9");
  EXPECT_EQ(resolve_rays("primary", defaults).id, "primary@65");
  EXPECT_EQ(resolve_rays("chords", defaults).id, "chords(rays=100000)");
}

TEST(RaySpecs, RefuseWhatTheyDoNotKnow) {
  const auto refusal = [](const char* spec) { return error_of([&] { resolve_rays(spec); }); };
  EXPECT_THAT(refusal("whited"), AllOf(HasSubstr("did you mean 'whitted'"), HasSubstr("chords")));
  EXPECT_THAT(refusal("whitted(rule=clean)"), HasSubstr("did you mean 'rules'"));
  EXPECT_THAT(refusal("whitted(rules=golem)"), HasSubstr("clean|haines|havran"));
  EXPECT_THAT(refusal("whitted@many"), HasSubstr("3 to 16384"));
  EXPECT_THAT(refusal("whitted@2"), HasSubstr("3 to 16384"));
  EXPECT_THAT(refusal("whitted(resolution=9)@9"), HasSubstr("twice"));
  EXPECT_THAT(refusal("chords@65"), HasSubstr("unknown parameter 'resolution'"));
  EXPECT_THAT(refusal("whitted:65"), HasSubstr("name(key=value,...)@resolution"));
  EXPECT_THAT(refusal("chords(rays=0)"), HasSubstr("1 to 1e+09"));
}

TEST(RaysInFloat, LeaveAndReachSurfacesWithoutMeetingThem) {
  const Scene scene = small_scene();
  const Geometry<float> geometry(scene);
  const auto own_hits = [&](const std::string& spec) {
    const RaySet set = rays_of(spec);
    const auto rays = rays_in<float>(set);
    const ExhaustiveTracer exact(scene);
    std::vector<Hit<double>> hits(set.rays.size());
    exact.closest(set.rays, hits);
    // Rays that meet nothing in double must meet nothing in float.
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < rays.size(); ++i)
      for (std::uint32_t object = 0; object < geometry.size() && hits[i].object == kNoObject; ++object)
        wrong += geometry.hit_distance(object, rays[i]) < kMiss<float>;
    return wrong;
  };
  EXPECT_EQ(own_hits("whitted@65"), 0u);
  EXPECT_EQ(own_hits("diffuse(rays=20000)@65"), 0u);
  EXPECT_EQ(own_hits("light@65"), 0u);
}

}  // namespace
}  // namespace rayshoot
