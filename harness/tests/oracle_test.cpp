#include "harness/verify/oracle.h"

#include <gmock/gmock.h>

#include "altered_technique.h"
#include "harness/measure/counting.h"
#include "harness/measure/predicting.h"
#include "harness/verify/scene_tracer.h"
#include "scenes/io/load_scene.h"
#include "scenes/rays/load_rays.h"

namespace rayshoot::test {
namespace {

using report::Status;

constexpr int kThreads = 2;
constexpr double kEverything = 1e18;

class OracleTest : public ::testing::Test {
 protected:
  report::Verdict judge(const Engine<float>& engine, const TechniqueInfo& info, double check_tests) const {
    Answers<float> answers(batch_);
    ThreadScratch<float> scratch(engine);
    trace(engine, batch_, answers, scratch, kThreads);
    References<float> references(geometry_);
    Oracle<float> oracle(references, batch_, check_tests, 1, kThreads);
    return oracle.judge({{&info, &answers}}).at(0);
  }
  report::Verdict judge(const std::string& id, double check_tests) const {
    const TechniqueEntry& entry = technique_entry(id);
    const Arguments arguments(entry.info.parameters, {}, id);
    return judge(*entry.build<float>({geometry_, arguments}), entry.info, check_tests);
  }
  report::Verdict judge(const AlteredEngine<float>::Alter& alter, double check_tests) const {
    return judge(AlteredEngine<float>({geometry_, none_}, alter), {.id = "altered"}, check_tests);
  }

  Arguments none_;
  Scene scene_ = load_scene("balls:2").scene;
  Geometry<float> geometry_{scene_};
  RaySet set_ = make_rays("whitted@17", scene_, SceneTracer(scene_, ConeSides::both, kThreads).tracer(), 1);
  Batch<float> batch_{set_};
};

TEST_F(OracleTest, SearchesAllRaysExhaustivelyWhereItCan) {
  const report::Verdict verdict = judge("bvh_sah", kEverything);
  EXPECT_EQ(verdict.status, Status::ok);
  EXPECT_EQ(verdict.reference, "exhaustive");
  EXPECT_EQ(verdict.checked_rays, set_.rays.size());
}

TEST_F(OracleTest, ChecksTheReferenceOnASampleAndOthersAgainstIt) {
  const double tests_for_20_rays = 20.0 * geometry_.size();
  const report::Verdict reference = judge("bvh_sah", tests_for_20_rays);
  EXPECT_EQ(reference.status, Status::ok);
  EXPECT_EQ(reference.reference, "exhaustive");
  EXPECT_EQ(reference.checked_rays, 20u);
  const report::Verdict other = judge("exhaustive", tests_for_20_rays);
  EXPECT_EQ(other.status, Status::ok);
  EXPECT_EQ(other.reference, "bvh_sah");
  EXPECT_EQ(other.checked_rays, set_.rays.size());
}

TEST_F(OracleTest, FindsOneWrongRayOutsideTheSample) {
  const Ray<float> victim = batch_.rays[40];
  const auto lose_one = [&](const Ray<float>& ray, Hit<float>& hit) {
    if (ray == victim) hit = {hit.t, hit.object + 1};
  };
  for (const double check_tests : {kEverything, 1.0}) {
    const report::Verdict verdict = judge(lose_one, check_tests);
    EXPECT_EQ(verdict.status, Status::wrong);
    EXPECT_EQ(verdict.wrong_rays, 1u);
  }
}

TEST_F(OracleTest, AnyHitIsJudgedByWhetherThereIsOne) {
  const auto other_object = [&](const Ray<float>& ray, Hit<float>& hit) {
    const bool asks_any = std::find(batch_.any().begin(), batch_.any().end(), ray) != batch_.any().end();
    if (asks_any && hit.object != kNoObject) hit = {hit.t / 2, hit.object + 1};
  };
  EXPECT_EQ(judge(other_object, kEverything).status, Status::ok);
  const auto lose_blockers = [&](const Ray<float>& ray, Hit<float>& hit) {
    if (std::find(batch_.any().begin(), batch_.any().end(), ray) != batch_.any().end()) hit = {};
  };
  EXPECT_EQ(judge(lose_blockers, kEverything).status, Status::wrong);
}

TEST_F(OracleTest, RecordedHitsAreThoseOfAllRays) {
  References<float> references(geometry_);
  const Oracle<float> oracle(references, batch_, kEverything, 1, kThreads);
  const RecordedHits<float> recorded = oracle.recorded();
  ASSERT_EQ(recorded.hits.size(), batch_.rays.size());
  std::uint64_t blocked = 0;
  for (std::size_t i = batch_.closest_rays; i < recorded.hits.size(); ++i)
    blocked += recorded.hits[i].object != kNoObject;
  EXPECT_GT(blocked, 0u);
  EXPECT_LT(blocked, batch_.any().size());
}

TEST_F(OracleTest, ReferencesAreBuiltOnceAndOnlyWhereThereAreNone) {
  References<float> references(geometry_);
  EXPECT_EQ(&references.reference(), &references.reference());
  EXPECT_EQ(&references.exhaustive(), &references.exhaustive());
  const auto built = build_default("bvh_sah", geometry_);
  EXPECT_EQ(&References<float>(geometry_, built.get()).reference(), built.get());
}

TEST_F(OracleTest, AReferenceThatIsWrongIsCaughtWhoeverBuiltIt) {
  const AlteredEngine<float> losing({geometry_, none_}, [](const Ray<float>&, Hit<float>& hit) { hit = {}; });
  References<float> references(geometry_, &losing);
  Oracle<float> oracle(references, batch_, 20.0 * geometry_.size(), 1, kThreads);
  const TechniqueEntry& entry = technique_entry("exhaustive");
  Answers<float> answers(batch_);
  ThreadScratch<float> scratch(references.exhaustive());
  trace(references.exhaustive(), batch_, answers, scratch, kThreads);
  const report::Verdict verdict = oracle.judge({{&entry.info, &answers}}).at(0);
  EXPECT_EQ(verdict.status, Status::ok);
  EXPECT_EQ(verdict.reference, "exhaustive");
}

TEST_F(OracleTest, AnswersAndCountsDoNotDependOnTheNumberOfThreads) {
  const TechniqueEntry& entry = technique_entry("bvh_sah");
  const Arguments arguments(entry.info.parameters, {}, "bvh_sah");
  const auto engine = entry.build<float>({geometry_, arguments});
  const RaySet many =
      make_rays("points(rays=20000)", scene_, SceneTracer(scene_, ConeSides::both, 1).tracer(), 1);
  const Batch<float> batch(many);
  const Counts alone = count(*engine, batch, geometry_.size(), 1e5, 1, 1);
  Answers<float> answers_alone(batch);
  ThreadScratch<float> scratch(*engine);
  trace(*engine, batch, answers_alone, scratch, 1);
  for (const int threads : {2, 5}) {
    const Counts together = count(*engine, batch, geometry_.size(), 1e5, 1, threads);
    EXPECT_EQ(together.work.object_tests, alone.work.object_tests);
    EXPECT_EQ(together.work.distinct_objects, alone.work.distinct_objects);
    EXPECT_EQ(together.work.volume_tests, alone.work.volume_tests);
    EXPECT_EQ(together.strict_work.object_tests, alone.strict_work.object_tests);
    EXPECT_EQ(together.strict_work.rays, alone.strict_work.rays);
    EXPECT_EQ(together.efficiency.m_ci95, alone.efficiency.m_ci95);
    Answers<float> answers(batch);
    trace(*engine, batch, answers, scratch, threads);
    EXPECT_EQ(answers.hits, answers_alone.hits);
  }
}

TEST_F(OracleTest, StrictWorkIsCountedOnAStatedSubsetWhereAllWouldBeTooMuch) {
  const TechniqueEntry& entry = technique_entry("exhaustive");
  const auto engine = entry.build<float>({geometry_, none_});
  const Counts some = count(*engine, batch_, geometry_.size(), 300.0 * geometry_.size(), 1, kThreads);
  EXPECT_EQ(some.strict_work.rays, 304u) << "whole runs of 16 neighbours";
  EXPECT_EQ(some.work.rays, batch_.rays.size());
  const Counts all = count(*engine, batch_, geometry_.size(), kEverything, 1, kThreads);
  EXPECT_EQ(all.strict_work.rays, batch_.rays.size());
}

TEST_F(OracleTest, PredictionIsPerRayOfTheSet) {
  const TechniqueEntry& entry = technique_entry("exhaustive");
  const auto exhaustive = entry.build<float>({geometry_, none_});
  const auto predicted = predict(*exhaustive, batch_);
  ASSERT_TRUE(predicted);
  EXPECT_EQ(predicted->object_tests_per_ray, geometry_.size());
  EXPECT_EQ(predicted->volume_tests_per_ray, 0);
}

}  // namespace
}  // namespace rayshoot::test
