// The sample of rays that techniques may look at before they build.
#include <gmock/gmock.h>

#include "harness/measure/building.h"

namespace rayshoot {
namespace {

/// Rays that can be told apart by where they start.
RaySet numbered(std::size_t first, std::size_t count) {
  RaySet set;
  for (std::size_t i = first; i < first + count; ++i)
    set.rays.push_back({.origin = {static_cast<double>(i), 0, 0}, .direction = {0, 0, 1}});
  return set;
}

std::vector<float> starts(const std::vector<const RaySet*>& sets) {
  std::vector<float> starts;
  for (const Ray<float>& ray : sampled<float>(sets)) starts.push_back(ray.origin.x);
  return starts;
}

TEST(RaySample, IsEvenlySpacedOverAllSets) {
  const RaySet first = numbered(0, 300), none, second = numbered(300, 700);
  EXPECT_THAT(starts({&first, &none, &second}), ::testing::ElementsAre(128, 384, 640, 896));
}

TEST(RaySample, IsOfThousandsAtMost) {
  const RaySet many = numbered(0, 4'000'000);
  const std::vector<float> sample = starts({&many});
  EXPECT_LE(sample.size(), kMostSampleRays);
  EXPECT_GT(sample.size(), kMostSampleRays * 9 / 10);
  EXPECT_GT(sample.back(), 4'000'000 * 0.999f);
}

TEST(RaySample, KeepsTheEndsOfRays) {
  RaySet set = numbered(0, 200);
  for (Ray<double>& ray : set.rays) ray.t_min = 0.25, ray.t_max = 7;
  EXPECT_EQ(sampled<double>({&set}), (std::vector<Ray<double>>{set.rays[128]}));
}

}  // namespace
}  // namespace rayshoot
