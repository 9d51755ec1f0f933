// measure_code_timings: the code timings of grid_1d's cost function (Jevans 1990, §6.2) on this machine, printed as a
// specification of the technique that uses them. Single precision, triangles, data in the cache.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <random>

#include "accel/parts/grid_1d_walk.h"
#include "accel/parts/mailbox.h"
#include "scenes/core/scene_builder.h"

namespace rayshoot {

namespace {

constexpr int kGranularity = 20;
constexpr std::uint32_t kObjects = 1000, kRays = 1 << 14;

/// Where triangles stand and rays run: random, but the same in every run.
class Random {
 public:
  double operator()(double lo, double hi) {
    return lo + (hi - lo) * std::ldexp(static_cast<double>(generator_() >> 11), -53);
  }

 private:
  std::mt19937_64 generator_{7};
};

/// Plates across a unit cube, each in one of the slabs into which the x axis is cut: subdividing along y or z, or
/// once more along x, separates nothing.
Scene plates() {
  Random random;
  SceneBuilder builder;
  for (std::uint32_t i = 0; i < kObjects; ++i) {
    const double slab = i % kGranularity, lo = (slab + 0.01) / kGranularity,
                 hi = (slab + 0.99) / kGranularity;
    builder.triangle({lo, 0, 0}, {hi, 1, random(0, 1)}, {random(lo, hi), random(0, 1), 1});
  }
  return std::move(builder).finish();
}

/// Rays through the unit cube along an axis, forwards or backwards, tilted a little to keep them off planes; so many
/// that the processor does not learn them by heart.
std::vector<Ray<float>> rays_along(int axis) {
  Random random;
  std::vector<Ray<float>> rays(kRays);
  for (Ray<float>& ray : rays) {
    for (int other = 0; other < 3; ++other) {
      ray.origin[other] = static_cast<float>(random(0.1, 0.9));
      ray.direction[other] = static_cast<float>(random(-1e-3, 1e-3));
    }
    const bool forwards = random(0, 1) < 0.5;
    ray.origin[axis] = forwards ? -0.5f : 1.5f;
    ray.direction[axis] = forwards ? 1 : -1;
  }
  return rays;
}

/// Voxels of which the root alone is subdivided, at that granularity; 1 leaves it whole.
std::unique_ptr<Grid1dVoxels<float>> subdivided_once(const Geometry<float>& geometry, int granularity,
                                                     std::span<const Ray<float>> sample) {
  const Grid1dRules rules{
      .timings = {.intcost = 1e6, .repcost = 0, .travcost = 0, .vertcost = 0, .subcost = 0},
      .maximum_granularity = granularity};
  return std::make_unique<Grid1dVoxels<float>>(geometry, RaySample<float>{sample, 1}, rules);
}

/// Trace rays through the voxels without testing any object.
void walk(benchmark::State& state, Grid1dVoxels<float>& voxels, const std::vector<Ray<float>>& rays) {
  TraversalStates<float> states;
  const auto reach = [] { return 10.f; };
  const auto visit = [](std::span<const std::uint32_t> objects) {
    benchmark::DoNotOptimize(objects.data());
    return false;
  };
  for ([[maybe_unused]] const auto& iteration : state)
    for (const Ray<float>& ray : rays) Grid1dWalk(voxels, states, ray, NoCount{}, reach, visit).run();
}

/// Keeps the time of an iteration of each benchmark, in nanoseconds.
class Collector final : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs)
      if (run.run_type == Run::RT_Aggregate && run.aggregate_name == "median")
        times_[run.run_name.function_name] = run.GetAdjustedCPUTime();
  }
  double time(const char* name) const { return times_.at(name); }

 private:
  std::map<std::string, double> times_;
};

template <class Body>
void add(const char* name, const Body& body) {
  benchmark::RegisterBenchmark(name, body)->Unit(benchmark::kNanosecond)->Repetitions(9)->MinTime(0.05);
}

CodeTimings measure() {
  const Geometry<float> geometry(plates());
  const auto across = rays_along(1), along = rays_along(0);
  const auto whole = subdivided_once(geometry, 1, across), halves = subdivided_once(geometry, 2, across),
             slabs = subdivided_once(geometry, kGranularity, across);

  // What each timing is made of.
  add("intersect", [&](benchmark::State& state) {
    for ([[maybe_unused]] const auto& iteration : state)
      for (std::uint32_t i = 0; i < kRays; ++i)
        benchmark::DoNotOptimize(geometry.triangle_hit_distance<Intersector::fast>(
            i % kObjects, i % 3 == 0 ? along[i] : across[i]));
  });
  add("repeat", [](benchmark::State& state) {
    Mailbox mailbox(kObjects);
    mailbox.begin_ray();
    for ([[maybe_unused]] const auto& iteration : state)
      for (std::uint32_t i = 0; i < kRays; ++i) benchmark::DoNotOptimize(mailbox.first_visit(i % kObjects));
  });
  add("along_halves", [&](benchmark::State& state) { walk(state, *halves, along); });
  add("along_slabs", [&](benchmark::State& state) { walk(state, *slabs, along); });
  add("across_whole", [&](benchmark::State& state) { walk(state, *whole, across); });
  add("across_slabs", [&](benchmark::State& state) { walk(state, *slabs, across); });
  const std::span<const Ray<float>> one_ray(across.data(), 1);
  const auto sort = [&geometry, one_ray](int granularity) {
    return [&geometry, one_ray, granularity](benchmark::State& state) {
      for ([[maybe_unused]] const auto& iteration : state)
        benchmark::DoNotOptimize(subdivided_once(geometry, granularity, one_ray));
    };
  };
  add("sort_none", sort(1));
  add("sort_all", sort(kGranularity));

  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector);
  const auto difference = [&](const char* more, const char* less, double parts) {
    return std::max(0.0, collector.time(more) - collector.time(less)) / parts;
  };
  return {.intcost = collector.time("intersect") / kRays,
          .repcost = collector.time("repeat") / kRays,
          .travcost = difference("along_slabs", "along_halves", kRays * (kGranularity - 2)),
          .vertcost = difference("across_slabs", "across_whole", kRays),
          .subcost = difference("sort_all", "sort_none", kObjects)};
}

}  // namespace

}  // namespace rayshoot

int main() {
  using namespace rayshoot;
  char program[] = "measure_code_timings";
  char* arguments[] = {program, nullptr};
  int count = 1;
  benchmark::Initialize(&count, arguments);
  const CodeTimings timings = measure();
  std::string specification;
  for (const NamedTiming& timing : kNamedTimings) {
    fmt::print("{:9} {:7.2f} ns  {}\n", timing.name, timings.*timing.value, timing.what);
    specification +=
        fmt::format("{}{}={:.1f}", specification.empty() ? "" : ",", timing.name, timings.*timing.value);
  }
  fmt::print("grid_1d({})\n", specification);
}
