#include <gmock/gmock.h>

#include "harness/plan/plan.h"

namespace rayshoot::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string refusal(const std::string& text) {
  try {
    make_plan(parse_suite(text, "test"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SuiteTest, ReadsEverythingThatMayBeSet) {
  const Suite suite = parse_suite(R"(
    // a comment
    {"scenes": "balls:2", "rays": ["primary"], "techniques": ["exhaustive"], "scalars": ["float", "double"],
     "exclude": [{"technique": "exh*", "objects_over": 100, "why": "slow"}],
     "seed": 7, "resolution": 33, "rules": "haines", "tessellation": 4, "threads": 2, "thread_scaling": [1, 2],
     "counts_only": true, "repetitions": 21, "build_seconds": 0.5, "trace_seconds": 3, "check_tests": 1e6,
     "strict_tests": 1e5, "work_maps": "exhaustive"} /* another */)",
                                  "test");
  EXPECT_THAT(suite.scenes, ElementsAre("balls:2"));
  EXPECT_THAT(suite.rays, ElementsAre("primary"));
  EXPECT_THAT(suite.techniques, ElementsAre("exhaustive"));
  EXPECT_THAT(suite.scalars, ElementsAre("float", "double"));
  ASSERT_EQ(suite.exclude.size(), 1u);
  EXPECT_EQ(suite.exclude[0].technique, "exh*");
  EXPECT_EQ(suite.exclude[0].objects_over, 100u);
  EXPECT_EQ(suite.exclude[0].why, "slow");
  EXPECT_EQ(suite.seed, 7u);
  EXPECT_EQ(suite.resolution, 33);
  EXPECT_EQ(suite.rules, "haines");
  EXPECT_EQ(suite.tessellation, 4);
  EXPECT_EQ(suite.threads, 2);
  EXPECT_THAT(suite.thread_scaling, ElementsAre(1, 2));
  EXPECT_TRUE(suite.counts_only);
  EXPECT_EQ(suite.repetitions, 21);
  EXPECT_EQ(suite.build_seconds, 0.5);
  EXPECT_EQ(suite.trace_seconds, 3);
  EXPECT_EQ(suite.check_tests, 1e6);
  EXPECT_EQ(suite.strict_tests, 1e5);
  EXPECT_THAT(suite.work_maps, ElementsAre("exhaustive"));
}

TEST(SuiteTest, ListsOfValuesMeanEveryCombination) {
  const Suite suite = parse_suite(
      R"({"scenes": [{"name": "balls", "size": [2, 3], "form": ["curves", "patches"]}],
          "techniques": [{"name": "grid", "density": [1, 2.5], "mailbox": true}]})",
      "test");
  EXPECT_THAT(suite.scenes,
              ElementsAre("balls:2/curves", "balls:3/curves", "balls:2/patches", "balls:3/patches"));
  EXPECT_THAT(suite.techniques, ElementsAre("grid(density=1,mailbox=on)", "grid(density=2.5,mailbox=on)"));
}

TEST(SuiteTest, RefusesWhatItDoesNotKnow) {
  EXPECT_THAT(refusal(R"({"scenes": ["balls"], "sed": 1})"),
              HasSubstr("unknown member 'sed'; did you mean 'seed'?"));
  EXPECT_THAT(refusal(R"({"scenes": ["balls"], "exclude": [{"tech": "x"}]})"),
              HasSubstr("exclude[0]: unknown member 'tech'"));
  EXPECT_THAT(refusal(R"({"scenes": ["balls"], "scalars": ["half"]})"), HasSubstr("unknown scalar 'half'"));
  EXPECT_THAT(refusal(R"({"scenes": ["balls"], "intersectors": ["tight"]})"),
              HasSubstr("unknown intersector 'tight'"));
  EXPECT_THAT(refusal(R"({"scenes": ["balls"], "rays": ["primry"]})"), HasSubstr("did you mean 'primary'?"));
  EXPECT_THAT(refusal(R"({"scenes": ["balls"], "techniques": ["exhaustiv"]})"),
              HasSubstr("did you mean 'exhaustive'?"));
  EXPECT_THAT(refusal(R"x({"scenes": ["balls"], "techniques": ["exhaustive(depth=3)"]})x"),
              HasSubstr("unknown parameter 'depth'"));
}

TEST(SuiteTest, RefusesTechniquesWhoseArgumentsCannotBeBuilt) {
  EXPECT_THAT(refusal(R"({"scenes": ["balls:2"], "rays": ["primary"],
                          "techniques": [{"name": "meta_hierarchy", "inner": "bvh_sa"}]})"),
              HasSubstr("did you mean 'bvh_sah'?"));
}

TEST(SuiteTest, RefusesValuesOutOfRangeOrOfAnotherType) {
  EXPECT_THAT(refusal(R"({"scenes": ["balls"], "repetitions": 0})"),
              HasSubstr("it takes an integer 1 to 1000"));
  EXPECT_THAT(refusal(R"({"scenes": ["balls"], "repetitions": 2.5})"), HasSubstr("it takes an integer"));
  EXPECT_THAT(refusal(R"({"scenes": ["balls"], "counts_only": 1})"), HasSubstr("it takes true or false"));
  EXPECT_THAT(refusal(R"({"scenes": 3})"), HasSubstr("scenes: 3 is not accepted; it takes text"));
  EXPECT_THAT(refusal(R"({"scenes": []})"), HasSubstr("the list is empty"));
  EXPECT_THAT(refusal(R"({})"), HasSubstr("has no scenes"));
}

TEST(SuiteTest, RefusesWhatIsNotJson) {
  EXPECT_THAT(refusal(R"({"scenes": ["balls")"), HasSubstr("suite test: not JSON"));
  EXPECT_THAT(refusal(R"({"scenes": ["balls"], "seed": 1, "seed": 2})"),
              HasSubstr("member 'seed' is given twice"));
}

TEST(SuiteTest, RefusesSettingsThatNoRaysTake) {
  EXPECT_THAT(refusal(R"({"scenes": ["balls"], "rays": ["chords"], "rules": "haines"})"),
              HasSubstr("no ray distribution of this run has a parameter 'rules'"));
}

TEST(SuiteTest, RefusesMapsOfWhatDoesNotRun) {
  EXPECT_THAT(
      refusal(
          R"({"scenes": ["balls"], "rays": ["primary"], "techniques": ["bvh_sah"], "work_maps": ["bvh_sa"]})"),
      HasSubstr("unknown technique of this run 'bvh_sa'; did you mean 'bvh_sah'?"));
  EXPECT_THAT(
      refusal(
          R"({"scenes": ["balls"], "rays": ["chords"], "techniques": ["bvh_sah"], "work_maps": ["bvh_sah"]})"),
      HasSubstr("rays that begin with them: primary, whitted"));
}

TEST(SuiteTest, BuiltInSuitesAreAccepted) {
  EXPECT_FALSE(builtin_suites().empty());
  for (const std::string& name : builtin_suites()) EXPECT_GT(make_plan(load_suite(name)).cells(), 0u) << name;
}

TEST(SuiteTest, PublishedTechniquesRunOnTheirScenesAlone) {
  const Plan plan = make_plan(load_suite("havran-1999"));
  const auto choice = std::find_if(plan.techniques.begin(), plan.techniques.end(), [](const auto& technique) {
    return technique.spec == "uniform_grid(resolution=46x46x3,mailbox=off)";
  });
  ASSERT_NE(choice, plan.techniques.end());
  EXPECT_TRUE(is_planned(*choice, "balls:4/curves"));
  EXPECT_FALSE(is_planned(*choice, "tetra:6/curves"));
  EXPECT_EQ(plan.cells(), plan.published.rows.size());
}

TEST(SuiteTest, PublishedFiguresAreRefusedUnlessTheyAreKnown) {
  EXPECT_THROW(load_published("havran"), InputError);
  EXPECT_THROW(parse_published(R"({"rows": [{"scene": "balls", "figures": {"nodes": 1}}]})", "test"),
               InputError);
  EXPECT_THROW(parse_published(R"({"claims": [{"relation": "slower"}]})", "test"), InputError);
  EXPECT_THAT(refusal(R"({"scenes": ["balls"], "bounds": "wide"})"), HasSubstr("known: tight, havran"));
}

TEST(SuiteTest, AnUnknownSuiteIsAnErrorThatNamesTheKnownOnes) {
  EXPECT_THROW(load_suite("quik"), InputError);
  try {
    load_suite("quik");
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean 'quick'?"));
  }
}

/// A cell of a scene of 11 objects.
class LeavingOutTest : public ::testing::Test {
 protected:
  std::string why(const std::string& suite, std::uint64_t rays, const std::string& scalar = "float",
                  const std::string& intersector = "fast") {
    const Plan plan = make_plan(parse_suite(suite, "test"));
    return why_left_out(plan.suite,
                        {scene_, plan.rays.at(0), rays, plan.techniques.at(0), scalar, intersector});
  }
  Scene scene_ = [] {
    Scene scene;
    scene.id = "balls:1";
    scene.objects.resize(11);
    return scene;
  }();
};

TEST_F(LeavingOutTest, AnEngineWithItsOwnObjectTestRunsForOneIntersector) {
  const std::string suite =
      R"({"scenes": "balls:1", "rays": "primary", "techniques": "embree", "intersectors": ["fast", "exact"]})";
  EXPECT_EQ(why(suite, 100, "float", "fast"), "");
  EXPECT_THAT(why(suite, 100, "float", "exact"), HasSubstr("object test of its own"));
}

TEST_F(LeavingOutTest, RunsWhatNothingForbids) {
  EXPECT_EQ(why(R"({"scenes": "balls:1", "rays": "primary", "techniques": "exhaustive"})", 100), "");
}

TEST_F(LeavingOutTest, RaysThatTheSceneCannotHave) {
  EXPECT_EQ(why(R"({"scenes": "balls:1", "rays": "light", "techniques": "exhaustive"})", 0),
            "the scene has no point light");
}

TEST_F(LeavingOutTest, SearchThatWouldNotEnd) {
  EXPECT_THAT(why(R"({"scenes": "balls:1", "rays": "primary", "techniques": "exhaustive"})", 1'000'000'000),
              HasSubstr("pairs of ray and object"));
  scene_.objects.resize(30'000);
  EXPECT_THAT(why(R"({"scenes": "balls:1", "rays": "primary", "techniques": "exhaustive"})", 1),
              HasSubstr("30000 objects; 20000 are practical"));
}

TEST_F(LeavingOutTest, WhatTheSuiteExcludes) {
  const auto excluding = [&](const std::string& exclusion) {
    return why(R"({"scenes": "balls:1", "rays": "primary", "techniques": "exhaustive", "exclude": )" +
                   exclusion + "}",
               100);
  };
  EXPECT_EQ(excluding(R"({"scene": "balls*", "why": "a reason"})"), "a reason");
  EXPECT_EQ(excluding(R"({"technique": "exh*", "scene": "tetra*"})"), "");
  EXPECT_EQ(excluding(R"({"objects_over": 10, "why": "large"})"), "large");
  EXPECT_EQ(excluding(R"({"objects_over": 11})"), "");
  EXPECT_EQ(excluding(R"({"rays_over": 99, "why": "many"})"), "many");
  EXPECT_EQ(excluding(R"({"rays_over": 100})"), "");
  EXPECT_EQ(excluding(R"({"scalar": "double"})"), "");
}

}  // namespace
}  // namespace rayshoot::test
