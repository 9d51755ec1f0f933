// M of Revelles and Ureña, its interval, and how many rays it takes.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <random>

#include "accel/core/registry.h"
#include "harness/measure/counting.h"
#include "harness/measure/run.h"
#include "harness/plan/catalogue.h"
#include "harness/verify/scene_tracer.h"
#include "scenes/io/load_scene.h"

namespace rayshoot {
namespace {

class IntervalOfM : public ::testing::TestWithParam<const char*> {
 protected:
  report::Efficiency efficiency(int rays, std::uint64_t seed, double strict_tests = 1e8) const {
    const RaySet set =
        make_rays(fmt::format("{}(rays={})", GetParam(), rays), scene_, tracer_.tracer(), seed);
    return count(*engine_, Batch<double>(set), geometry_.size(), strict_tests, seed, 1).efficiency;
  }

  Scene scene_ = load_scene("balls:2").scene;
  Geometry<double> geometry_{scene_};
  SceneTracer tracer_{scene_, ConeSides::both, 1};
  std::unique_ptr<Engine<double>> engine_ =
      technique_entry("uniform_grid")
          .build<double>({geometry_, Arguments(technique_entry("uniform_grid").info.parameters, {}, "")});
};

double width(const std::array<double, 2>& interval) { return interval[1] - interval[0]; }

/// The true value lies in an interval of 95 % as often as it says, or oftener: chords are more even than independent rays.
TEST_P(IntervalOfM, HoldsTheTrueValue) {
  const report::Efficiency truth = efficiency(400'000, 1000);
  int held = 0, held_strict = 0, held_sampled = 0;
  constexpr int kSeeds = 100;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const auto holds = [](const std::array<double, 2>& interval, double m) {
      return interval[0] <= m && m <= interval[1];
    };
    const report::Efficiency all = efficiency(4000, seed), sampled = efficiency(4000, seed, 8000);
    held += holds(all.m_ci95, truth.m), held_strict += holds(all.m_strict_ci95, truth.m_strict);
    held_sampled += holds(sampled.m_strict_ci95, truth.m_strict);
  }
  EXPECT_GE(held, 88);
  EXPECT_GE(held_strict, 88);
  EXPECT_GE(held_sampled, 88);
}

/// Sixteen times the rays, a quarter of the interval.
TEST_P(IntervalOfM, NarrowsWithTheSquareRootOfTheRays) {
  const report::Efficiency few = efficiency(2000, 1), many = efficiency(32'000, 1);
  EXPECT_NEAR(width(many.m_ci95) / width(few.m_ci95), 0.25, 0.05);
  EXPECT_NEAR(width(many.m_strict_ci95) / width(few.m_strict_ci95), 0.25, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Distributions, IntervalOfM, ::testing::Values("chords", "diffuse", "points"),
                         [](const auto& distribution) { return std::string(distribution.param); });

/// Rays of neighbouring pixels are alike: strata of them tell more than as many rays at random would.
TEST(IntervalOfMOfPixels, GainsFromStrata) {
  const Scene scene = load_scene("balls:2").scene;
  const Geometry<double> geometry(scene);
  const SceneTracer tracer(scene, ConeSides::both, 1);
  const TechniqueEntry& entry = technique_entry("uniform_grid");
  const auto engine = entry.build<double>({geometry, Arguments(entry.info.parameters, {}, "")});
  const Batch<double> in_order(make_rays("primary@129", scene, tracer.tracer(), 1));
  Batch<double> shuffled = in_order;
  std::shuffle(shuffled.rays.begin(), shuffled.rays.end(), std::mt19937(1));
  const auto of = [&](const Batch<double>& batch) {
    return relative_m_error(*engine, batch, geometry.size(), 1);
  };
  EXPECT_LT(of(in_order), 0.7 * of(shuffled));
}

class TargetMError : public ::testing::Test {
 protected:
  class Silent final : public RunObserver {
    void doing(const std::string&) override {}
    void finished(std::size_t) override {}
  };

  report::Report run(const std::string& rays, double target) {
    Suite suite{
        .name = "target", .scenes = {"tetra:4"}, .rays = {rays}, .techniques = {"bvh_sah", "uniform_grid"}};
    suite.counts_only = true, suite.target_m_error = target;
    Silent silent;
    return rayshoot::run(make_plan(suite), {}, silent, [] { return false; });
  }
};

TEST_F(TargetMError, TakesAsManyRaysAsItNeeds) {
  for (const char* rays : {"chords", "diffuse", "primary"}) {
    std::uint64_t before = 0;
    for (const double target : {0.1, 0.02}) {
      const report::Report report = run(rays, target);
      ASSERT_EQ(report.measurements.size(), 2u);
      for (const report::Measurement& measurement : report.measurements)
        EXPECT_LE(width(measurement.efficiency->m_ci95) / 2, target * measurement.efficiency->m)
            << measurement.rays;
      EXPECT_GT(report.ray_sets.at(0).rays, before);
      before = report.ray_sets.at(0).rays;
    }
  }
}

}  // namespace
}  // namespace rayshoot
