#include "harness/choose/choose.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "accel/core/registry.h"
#include "harness/choose/candidates.h"
#include "harness/choose/fit.h"
#include "harness/choose/prune.h"
#include "harness/choose/sample.h"
#include "harness/choose/terms.h"
#include "harness/verify/scene_tracer.h"
#include "scenes/io/load_scene.h"

namespace rayshoot::test {
namespace {

using ::testing::Each;
using ::testing::Gt;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::Pair;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;

class SilentObserver final : public RunObserver {
 public:
  void doing(const std::string&) override {}
  void finished(std::size_t) override {}
};

SceneStatistics statistics(const std::string& scene) {
  return statistics_of(Geometry<double>(load_scene(scene).scene));
}

RaySet rays(const std::string& spec, const std::string& scene_spec) {
  const Scene scene = load_scene(scene_spec).scene;
  return make_rays(spec, scene, SceneTracer(scene, ConeSides::both, 1).tracer(), 1);
}

TEST(SceneStatistics, TellClustersFromEvenScenes) {
  const SceneStatistics even = statistics("lattice:6"), clustered = statistics("stadium(objects=2000)");
  EXPECT_EQ(even.objects, 7u * 7 * 7 + 3 * 6 * 7 * 7);
  EXPECT_LT(even.crowding, 3);
  EXPECT_LT(even.spread, 4);
  EXPECT_GT(clustered.crowding, 500);
  EXPECT_GT(clustered.spread, 100);
}

TEST(SceneStatistics, OfOneObjectAreOne) {
  const SceneStatistics one = statistics("tetra:1"), few = statistics("balls:1");
  EXPECT_GE(one.crowding, 1);
  EXPECT_GE(few.spread, 1);
}

TEST(Stratified, KeepsTheSharesOfQueriesAndSpreadsOverTheSet) {
  const RaySet set = rays("whitted@33", "balls:2");
  const RaySet sample = stratified(set, 200, 1, 1);
  const double share = static_cast<double>(sample.closest_rays) / static_cast<double>(sample.rays.size());
  EXPECT_NEAR(share, static_cast<double>(set.closest_rays) / static_cast<double>(set.rays.size()), 0.01);
  EXPECT_GE(sample.rays.size(), 200u * 9 / 10);
  EXPECT_LE(sample.rays.size(), 202u);
  EXPECT_EQ(sample.origins.size(), sample.rays.size());
  EXPECT_EQ(sample.hash(), stratified(set, 200, 1, 1).hash());
  EXPECT_NE(sample.hash(), stratified(set, 200, 1, 2).hash());
}

TEST(Stratified, TakesRunsOfNeighbours) {
  const RaySet set = rays("primary@33", "balls:2");
  const RaySet sample = stratified(set, 64, 8, 1);
  ASSERT_GE(sample.rays.size(), 56u);
  const auto place = [&](const Ray<double>& ray) {
    for (std::size_t i = 0; i < set.rays.size(); ++i)
      if (set.rays[i].direction == ray.direction) return i;
    return set.rays.size();
  };
  for (std::size_t i = 0; i < 56; i += 8) EXPECT_EQ(place(sample.rays[i]) + 7, place(sample.rays[i + 7]));
}

TEST(Stratified, IsTheSetWhereThatIsSmall) {
  const RaySet set = rays("whitted@5", "balls:1");
  EXPECT_EQ(stratified(set, 100'000, 1, 1).hash(), set.hash());
}

TEST(Terms, OfExhaustiveSearchAreTheObjectsByKind) {
  const Geometry<float> geometry(load_scene("balls:1").scene);
  const Arguments none;
  const auto engine = technique_entry("exhaustive").build<float>({geometry, none});
  const auto terms = terms_of(*engine, geometry, Batch<float>(rays("chords(rays=50)", "balls:1")));
  EXPECT_THAT(terms, UnorderedElementsAre(Pair("ray", 1), Pair("object_test", 11), Pair("sphere_test", 10),
                                          Pair("polygon_test", 1), Pair("polygon_vertex", 4)));
}

TEST(Terms, OfPlacedObjectsAreOfTheKindsInTheirParts) {
  const Scene scene = load_scene("swarm:2").scene;
  const Geometry<float> geometry(scene);
  const TechniqueEntry& exhaustive = technique_entry("exhaustive");
  const auto engine = exhaustive.build<float>({geometry, Arguments(exhaustive.info.parameters, {}, "")});
  const auto terms = terms_of(*engine, geometry, Batch<float>(rays("primary@33", "swarm:2")));
  for (const char* kind : {"triangle_test", "polygon_test", "sphere_test", "cone_test"})
    EXPECT_GT(terms.at(kind), 0) << kind;
  EXPECT_NEAR(
      terms.at("triangle_test") + terms.at("polygon_test") + terms.at("sphere_test") + terms.at("cone_test"),
      terms.at("object_test"), 1e-9);
}

TEST(Constants, AreWrittenAndReadBack) {
  const std::string text = to_json(builtin_constants());
  EXPECT_EQ(to_json(parse_constants(text, "again")), text);
}

TEST(Constants, ThatComeWithTheProgramAreOfKnownTechniques) {
  ASSERT_THAT(builtin_constants().techniques, SizeIs(Gt(10u)));
  for (const auto& [technique, known] : builtin_constants().techniques)
    EXPECT_EQ(choose_technique(technique).entry->info.id, technique);
}

std::string objection(const std::string& text) try {
  parse_constants(text, "c.json");
  return {};
} catch (const InputError& error) {
  return error.what();
}

TEST(Constants, RefuseWhatTheyDoNotKnow) {
  EXPECT_THAT(objection(R"({"mashine": "x"})"), HasSubstr("did you mean 'machine'?"));
  EXPECT_THAT(objection(R"({"techniques": {"bvh_sah": {"terms_ns": {"stop": 1}}}})"),
              HasSubstr("did you mean 'step'?"));
  EXPECT_THAT(objection(R"({"object_terms_ns": {"sphere_test": -1}})"), HasSubstr("it takes a number 0 to"));
  EXPECT_THAT(objection("{"), HasSubstr("c.json: not JSON"));
}

/// Constants by which every technique costs what its tests and steps do, at one price for all.
Constants plain_constants() {
  Constants constants{.machine = "a machine", .date = "2026-01-01", .cells = 4, .scenes = {"tetra:5/curves"}};
  for (const char* term : {"triangle_test", "sphere_test", "cone_test", "polygon_test"})
    constants.object_terms_ns[term] = 3;
  for (const TechniqueEntry* entry : technique_entries())
    constants.techniques[entry->info.id] = {.terms_ns = {{"ray", 10}, {"volume_test", 3}, {"step", 3}}};
  constants.techniques["uniform_grid(density=0.1)|kd_tree"] = {.terms_ns = {{"ray", 10}, {"step", 3}}};
  return constants;
}

std::string why(const std::string& technique, const std::string& scene) {
  return why_not_weighed(choose_technique(technique), statistics(scene), plain_constants());
}

TEST(Pruning, HasAReasonForEachTechniqueThatASceneDoesNotNeed) {
  EXPECT_THAT(why("exhaustive", "tetra:5"), HasSubstr("each of 1024 objects"));
  EXPECT_THAT(why("bounding_volumes", "tetra:5"), HasSubstr("each of 1024 objects"));
  EXPECT_THAT(why("exhaustive", "balls:1"), IsEmpty());
  EXPECT_THAT(why("uniform_grid", "stadium(objects=2000)"), HasSubstr("cells are of one size"));
  EXPECT_THAT(why("uniform_grid", "lattice:6"), IsEmpty());
  EXPECT_THAT(why("uniform_grid(density=0.1)|kd_tree", "lattice:6"), HasSubstr("objects are spread evenly"));
  EXPECT_THAT(why("uniform_grid(density=0.1)|kd_tree", "stadium(objects=2000)"), IsEmpty());
  EXPECT_THAT(why("octree_revelles|kd_tree", "stadium(objects=2000)"), HasSubstr("no constants"));
}

TEST(Pruning, LeavesOutWhatWasNeverNearTheFastest) {
  Constants constants = plain_constants();
  constants.techniques["kd_tree"].at_least = 2.5;
  const std::string reason = why_not_weighed(choose_technique("kd_tree"), statistics("lattice:6"), constants);
  EXPECT_EQ(reason, "it took 2.5 times as long as the fastest or longer on all 4 cells that were measured");
}

class ChooseTest : public ::testing::Test {
 protected:
  ChooseTest() { options_.race = false; }

  std::vector<report::Choice> choose_all() {
    SilentObserver observer;
    const Suite suite{.scenes = scenes_, .rays = {"chords(rays=500)"}, .techniques = {"bvh_sah"}};
    plan_ = make_plan(suite);
    return choose_techniques(plan_, options_, constants_, observer, [] { return false; });
  }
  report::Choice choose() { return choose_all().at(0); }

  std::vector<std::string> scenes_{"tetra:5"};
  ChooserOptions options_;
  Constants constants_ = plain_constants();
  Plan plan_;
};

/// What of a choice must not depend on when it is made.
std::string lasting(report::Choice choice) {
  choice.seconds = 0;
  for (report::Candidate& candidate : choice.candidates) candidate.build_ns = 0;
  report::Report report;
  report.choices = {std::move(choice)};
  return to_json(report);
}

TEST_F(ChooseTest, WithoutARaceIsTheSameEveryTime) { EXPECT_EQ(lasting(choose()), lasting(choose())); }

TEST_F(ChooseTest, PicksTheLeastExpectedCostAndSaysWhatItLeftOut) {
  const report::Choice choice = choose();
  ASSERT_THAT(choice.candidates, SizeIs(Gt(5u)));
  for (const report::Candidate& candidate : choice.candidates)
    EXPECT_GE(*candidate.predicted_ns_per_ray, *choice.candidates[0].predicted_ns_per_ray);
  EXPECT_EQ(choice.pick, choice.candidates[0].spec);
  EXPECT_EQ(choice.predicted, choice.pick);
  EXPECT_THAT(choice.why, HasSubstr(choice.pick + " is expected to cost"));
  std::vector<std::string> left_out;
  for (const report::LeftOut& line : choice.left_out) left_out.push_back(line.what);
  EXPECT_THAT(left_out, IsSupersetOf({"exhaustive", "bounding_volumes"}));
  EXPECT_TRUE(choice.fitted);
  EXPECT_EQ(choice.constants, "a machine, 2026-01-01, 4 cells");
}

TEST_F(ChooseTest, APlantedConstantChangesThePick) {
  const std::string first = choose().pick;
  constants_.techniques[first].terms_ns["ray"] = 1e6;
  const std::string second = choose().pick;
  EXPECT_NE(second, first);
  constants_.techniques["octree_samet"].terms_ns = {{"ray", 1}};
  constants_.object_terms_ns.clear();
  EXPECT_EQ(choose().pick, "octree_samet");
}

TEST_F(ChooseTest, NamedCandidatesAreNotLeftOutForTheirLooks) {
  options_.candidates = {"exhaustive", "uniform_grid(density=2)"};
  const report::Choice choice = choose();
  EXPECT_THAT(choice.left_out, IsEmpty());
  EXPECT_THAT(choice.candidates, SizeIs(2));
  EXPECT_EQ(choice.pick, "uniform_grid(density=2)");
}

TEST_F(ChooseTest, NamesEachCandidateOnce) {
  options_.candidates = {"bvh_sah", "all", "bvh_sah"};
  std::vector<std::string> specs;
  for (const TechniqueChoice& candidate : candidates_of(options_.candidates, constants_).techniques)
    specs.push_back(candidate.spec);
  EXPECT_EQ(std::count(specs.begin(), specs.end(), "bvh_sah"), 1);
  EXPECT_THAT(specs, IsSupersetOf({"exhaustive", "kd_tree", "uniform_grid(density=0.1)|kd_tree"}));
  EXPECT_EQ(std::count(specs.begin(), specs.end(), "embree"), 0);
}

TEST_F(ChooseTest, RefusesWhatCannotBeChosen) {
  options_.candidates = {"embree"};
  EXPECT_THROW(choose(), InputError);
  options_.candidates = {"octree_revelles|kd_tree"};
  EXPECT_THROW(choose(), InputError) << "no constants and no race";
}

TEST_F(ChooseTest, ARaceDecidesBetweenNearTies) {
  options_.race = true;
  options_.candidates = {"exhaustive", "bvh_sah"};
  // Exhaustive search is expected to cost a little less; it takes a hundred times as long.
  constants_.object_terms_ns.clear();
  constants_.techniques["exhaustive"].terms_ns = {{"ray", 10}};
  constants_.techniques["bvh_sah"].terms_ns = {{"ray", 11}};
  const report::Choice choice = choose();
  EXPECT_EQ(choice.predicted, "exhaustive");
  EXPECT_EQ(choice.pick, "bvh_sah");
  for (const report::Candidate& candidate : choice.candidates)
    EXPECT_THAT(candidate.race_ns_per_ray, Each(Gt(0)));
  EXPECT_THAT(choice.why, HasSubstr("in a race of near ties"));
}

TEST_F(ChooseTest, ACandidateFarBehindDoesNotRace) {
  options_.race = true;
  options_.candidates = {"exhaustive", "bvh_sah"};
  constants_.techniques["bvh_sah"].terms_ns["ray"] = 1e6;
  const report::Choice choice = choose();
  EXPECT_EQ(choice.pick, "exhaustive");
  for (const report::Candidate& candidate : choice.candidates)
    EXPECT_THAT(candidate.race_ns_per_ray, IsEmpty());
}

TEST_F(ChooseTest, FewExpectedRaysDoNotPayForABuild) {
  options_.candidates = {"exhaustive", "bvh_sah"};
  EXPECT_EQ(choose().pick, "bvh_sah");
  options_.expected_rays = 1;
  const report::Choice choice = choose();
  EXPECT_EQ(choice.pick, "exhaustive");
  EXPECT_EQ(choice.expected_rays, 1);
}

TEST_F(ChooseTest, ChoicesArePlannedForTheirScenes) {
  scenes_ = {"tetra:3", "balls:1"};
  options_.candidates = {"bvh_sah", "kd_tree"};
  std::vector<report::Choice> choices = choose_all();
  ASSERT_THAT(choices, SizeIs(2));
  choices[0].pick = "kd_tree", choices[1].pick = "hug";
  Plan plan = plan_;
  plan.techniques.clear();
  plan_choices(plan, choices, false);
  ASSERT_THAT(plan.techniques, SizeIs(2));
  EXPECT_TRUE(is_planned(plan.techniques[0], choices[0].scene));
  EXPECT_FALSE(is_planned(plan.techniques[0], choices[1].scene));
  plan_choices(plan, choices, true);
  EXPECT_THAT(plan.techniques, SizeIs(3));
  EXPECT_TRUE(is_planned(plan.techniques[0], choices[1].scene));
}

/// A report in which two techniques were counted on two scenes and took what planted constants say.
report::Report measured_report() {
  report::Report report;
  report.run.started_utc = "2026-02-03T00:00:00Z";
  report.environment.cpu = "a processor";
  for (const double tests : {4.0, 10.0}) {
    const std::string scene = tests == 4 ? "a" : "b", set = scene + "/rays";
    report.scenes.push_back({.id = scene});
    report.ray_sets.push_back({.id = set, .scene = scene, .rays = 10});
    report::Choice choice{.scene = scene, .rays = set, .scalar = "float"};
    for (const auto& [technique, step_ns] : {std::pair("one", 2.0), std::pair("two", 5.0)}) {
      const double steps = tests * tests;
      choice.candidates.push_back({.spec = technique,
                                   .technique = technique,
                                   .counts = {{"ray", 1}, {"triangle_test", tests}, {"step", steps}}});
      report.measurements.push_back({.scene = scene,
                                     .rays = set,
                                     .technique = technique,
                                     .scalar = "float",
                                     .trace_ns = {10 * (3 * tests + step_ns * steps)}});
    }
    report.choices.push_back(std::move(choice));
  }
  return report;
}

TEST(Fit, FindsPlantedConstants) {
  const report::Report report = measured_report();
  const Constants constants = fit_constants({{report}});
  EXPECT_NEAR(constants.object_terms_ns.at("triangle_test"), 3, 1e-6);
  EXPECT_NEAR(constants.techniques.at("one").terms_ns.at("step"), 2, 1e-6);
  EXPECT_NEAR(constants.techniques.at("two").terms_ns.at("step"), 5, 1e-6);
  EXPECT_NEAR(constants.techniques.at("two").error, 0, 1e-6);
  EXPECT_DOUBLE_EQ(constants.techniques.at("one").at_least, 1);
  EXPECT_NEAR(constants.techniques.at("two").at_least, (3 * 4 + 5 * 16) / (3 * 4 + 2 * 16.0), 1e-9);
  EXPECT_EQ(constants.origin(), "a processor, 2026-02-03, 2 cells");
  EXPECT_THAT(constants.scenes, UnorderedElementsAre("a", "b"));
}

TEST(Fit, OfThePublishedReportIsWhatComesWithTheProgram) {
  const report::Report report = report::read_report(RAYSHOOT_SOURCE "/results/reports/chooser-fit.json");
  EXPECT_EQ(to_json(fit_constants({{report}})), to_json(builtin_constants()));
}

TEST(Fit, RefusesReportsWithoutCandidates) { EXPECT_THROW(fit_constants({{report::Report{}}}), InputError); }

}  // namespace
}  // namespace rayshoot::test
