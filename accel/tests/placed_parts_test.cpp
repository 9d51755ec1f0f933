#include <gmock/gmock.h>

#include "accel/core/engine_tracer.h"
#include "accel/tests/conformance.h"
#include "scenes/io/load_scene.h"
#include "scenes/rays/load_rays.h"

/// What is characteristic of techniques in scenes of placed and moving parts; that their answers are right is checked on
/// `grass` and `swarm` with all other scenes (scene_conformance_test.cpp).
namespace rayshoot {
namespace {

struct Traced {
  explicit Traced(const std::string& id, const std::string& rays = "points(rays=400)")
      : scene(load_scene(id).scene) {
    const Geometry<double> precise(scene);
    const auto engine = build("bvh_sah", precise);
    set = make_rays(rays, scene, EngineTracer(*engine, precise, 1), 7);
  }

  template <class Real>
  static std::unique_ptr<Engine<Real>> build(const std::string& id, const Geometry<Real>& geometry,
                                             const std::map<std::string, std::string>& given = {}) {
    const TechniqueEntry& entry = technique_entry(id);
    return entry.build<Real>({geometry, Arguments(entry.info.parameters, given, id)});
  }

  Work work(const std::string& id, const std::map<std::string, std::string>& given = {}) const {
    const Geometry<float> geometry(scene);
    const auto engine = build<float>(id, geometry, given);
    const std::vector<Ray<float>> rays = rays_in<float>(set);
    std::vector<Hit<float>> hits(rays.size());
    return engine->count(Query::closest, rays, hits, *engine->scratch()).total;
  }

  std::vector<Hit<float>> hits(const std::string& id,
                               const std::map<std::string, std::string>& given = {}) const {
    const Geometry<float> geometry(scene);
    const std::vector<Ray<float>> rays = rays_in<float>(set);
    std::vector<Hit<float>> hits(rays.size());
    const auto engine = build<float>(id, geometry, given);
    engine->closest(rays, hits, *engine->scratch());
    return hits;
  }

  Scene scene;
  RaySet set;
};

TEST(PlacedParts, BillionsOfObjectsAreSearched) {
  const Traced traced("grass:4", "primary@65");
  const std::vector<Hit<float>> hits = traced.hits("snyder_barr");
  EXPECT_EQ(hits, traced.hits("bvh_sah"));
  EXPECT_EQ(hits, traced.hits("octree_revelles"));
  // Blades are hit, and more than one row of them.
  std::uint32_t last = 0;
  for (const Hit<float>& hit : hits)
    if (hit.object != kNoObject) last = std::max(last, hit.object);
  EXPECT_GT(last, 1'000'000u);
  const Geometry<float> geometry(traced.scene);
  EXPECT_LT(Traced::build<float>("snyder_barr", geometry)->structure().bytes, 10'000'000u);
}

TEST(PlacedParts, ObjectsArePlacedOnceAndListedOnce) {
  const Geometry<float> geometry(load_scene("grass:3").scene);
  // Four levels: the scene, two of rows, the tuft; no reference is stored for a placement of a placement.
  const StructureStats stats = Traced::build<float>("bvh_sah", geometry)->structure();
  EXPECT_EQ(stats.figures.at("parts"), 4);
  EXPECT_EQ(stats.references, 2u + 3 * 100 + 25);
}

/// The scene as it is at a time, and stays.
Scene frozen(Scene scene, double time) {
  for (Placement& placement : scene.placements) {
    placement.scene_from_part = compose(translation(placement.velocity * time), placement.scene_from_part);
    placement.velocity = {};
  }
  return scene;
}

TEST(Motion, HitsAreThoseOfTheSceneAtTheTimeOfTheRay) {
  const Traced traced("swarm:4");
  const Geometry<double> moving(traced.scene);
  const auto spacetime = Traced::build("spacetime", moving);
  const auto scratch = spacetime->scratch();
  int hits = 0;
  for (const Ray<double>& ray : traced.set.rays) {
    Hit<double> found;
    spacetime->closest({&ray, 1}, {&found, 1}, *scratch);
    const Geometry<double> still(frozen(traced.scene, ray.time));
    const Hit<double> expected = conformance::truth(still, ray).nearest;
    EXPECT_EQ(found.object, expected.object) << conformance::describe(ray);
    if (found.object == kNoObject) continue;
    ++hits;
    EXPECT_NEAR(found.t, expected.t, 1e-9) << conformance::describe(ray);
  }
  EXPECT_GT(hits, 40);
}

TEST(Motion, TimesBeyondTheEndsAreTheEnds) {
  const Traced traced("swarm:3");
  const Geometry<float> geometry(traced.scene);
  const auto engine = Traced::build<float>("spacetime", geometry);
  const auto scratch = engine->scratch();
  const auto at = [&](float time) {
    std::vector<Ray<float>> rays = rays_in<float>(traced.set);
    for (Ray<float>& ray : rays) ray.time = time;
    std::vector<Hit<float>> hits(rays.size());
    engine->closest(rays, hits, *scratch);
    return hits;
  };
  EXPECT_EQ(at(-3), at(0));
  EXPECT_EQ(at(7), at(1));
  EXPECT_EQ(at(std::numeric_limits<float>::quiet_NaN()), at(0));
  EXPECT_NE(at(0), at(1));
}

TEST(Spacetime, DivisionsOfTimeSaveTests) {
  const Traced traced("swarm:8(speed=12)", "chords(rays=2000)");
  const auto volumes = [&](const std::string& divisions) {
    return traced.work("spacetime", {{"max_time_divisions", divisions}}).volume_tests;
  };
  EXPECT_LT(2 * volumes("6"), volumes("0"));
  EXPECT_LT(2 * volumes("6"), traced.work("bvh_sah").volume_tests);
}

TEST(Spacetime, TimeIsNotDividedWhereNothingMoves) {
  const Geometry<float> still(load_scene("balls:2").scene), moving(load_scene("swarm:4").scene);
  EXPECT_EQ(Traced::build<float>("spacetime", still)->structure().figures.at("forks"), 0);
  // In a scene of parts, figures are those of the parts; its nodes tell.
  const auto nodes = [&](const std::string& divisions) {
    return Traced::build<float>("spacetime", moving, {{"max_time_divisions", divisions}})->structure().nodes;
  };
  EXPECT_GT(nodes("4"), 2 * nodes("0"));
}

TEST(MetaHierarchy, SearchesThePartsByOneTechniqueAndTheSceneByAnother) {
  const Traced traced("grass:1", "primary@33");
  const std::vector<Hit<float>> hits = traced.hits("exhaustive");
  EXPECT_EQ(traced.hits("meta_hierarchy"), hits);
  EXPECT_EQ(
      traced.hits("meta_hierarchy", {{"outer", "uniform_grid|bvh_sah"}, {"inner", "kd_tree||exhaustive"}}),
      hits);
  const auto tests = [&](const char* outer, const char* inner) {
    return traced.work("meta_hierarchy", {{"outer", outer}, {"inner", inner}}).object_tests;
  };
  // A list of what is placed finds parts in any order; a list of each tuft tests every blade of it.
  EXPECT_LT(tests("exhaustive", "bvh_sah"), 2 * tests("bvh_sah", "bvh_sah"));
  EXPECT_GT(tests("bvh_sah", "exhaustive"), 2 * tests("bvh_sah", "bvh_sah"));
}

TEST(MetaHierarchy, RefusesWhatIsNoTechnique) {
  const Geometry<float> geometry(load_scene("balls:1").scene);
  EXPECT_THROW(Traced::build<float>("meta_hierarchy", geometry, {{"outer", "bvh_sa"}}), InputError);
  EXPECT_THROW(Traced::build<float>("meta_hierarchy", geometry, {{"inner", "uniform_grid|"}}), InputError);
}

TEST(SnyderBarr, FewObjectsAreAList) {
  const Geometry<float> geometry(load_scene("balls:1").scene);
  EXPECT_EQ(Traced::build<float>("snyder_barr", geometry, {{"lists", "11"}})->structure().nodes, 1u);
  EXPECT_GT(Traced::build<float>("snyder_barr", geometry, {{"lists", "10"}})->structure().nodes, 10u);
}

}  // namespace
}  // namespace rayshoot
