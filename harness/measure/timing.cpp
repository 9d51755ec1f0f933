#include "harness/measure/timing.h"

#include <benchmark/benchmark.h>

#include <mutex>
#include <string>

namespace rayshoot {

namespace {

/// Name of the counter that marks a repetition in which passes were left out. (An error would not do: Google
/// Benchmark ends the program when only some repetitions have one.)
constexpr const char* kStopped = "stopped";

/// Keeps each repetition's real time a pass, and prints nothing.
class Collector final : public benchmark::BenchmarkReporter {
 public:
  explicit Collector(std::size_t passes) : times_(passes) {}

  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs)
      if (run.run_type == Run::RT_Iteration && !run.counters.contains(kStopped))
        times_[std::stoul(run.run_name.function_name)].push_back(run.GetAdjustedRealTime());
  }
  std::vector<std::vector<double>> times() && { return std::move(times_); }

 private:
  std::vector<std::vector<double>> times_;
};

void run_pass(benchmark::State& state, const TimedPass& timed, const std::function<bool()>& stopped) {
  for ([[maybe_unused]] const auto& iteration : state) {
    if (state.counters.empty() && stopped()) state.counters[kStopped] = 1;
    if (!state.counters.empty()) continue;
    timed.pass();
    if (!timed.tidy_up) continue;
    state.PauseTiming();
    timed.tidy_up();
    state.ResumeTiming();
  }
}

void initialize_once() {
  static std::once_flag once;
  std::call_once(once, [] {
    char program[] = "rayshoot", interleaving[] = "--benchmark_enable_random_interleaving=true";
    char* arguments[] = {program, interleaving, nullptr};
    int count = 2;
    benchmark::Initialize(&count, arguments);
  });
}

}  // namespace

std::vector<std::vector<double>> time_interleaved(const std::vector<TimedPass>& passes,
                                                  const std::function<bool()>& stopped) {
  initialize_once();
  for (std::size_t i = 0; i < passes.size(); ++i) {
    auto* registered = benchmark::RegisterBenchmark(
        std::to_string(i).c_str(), [&, i](benchmark::State& state) { run_pass(state, passes[i], stopped); });
    registered->UseRealTime()->Unit(benchmark::kNanosecond)->Repetitions(passes[i].repetitions);
    if (passes[i].min_seconds > 0)
      registered->MinTime(passes[i].min_seconds)->MinWarmUpTime(passes[i].min_seconds);
    else
      registered->Iterations(1);
  }
  Collector collector(passes.size());
  if (!passes.empty()) benchmark::RunSpecifiedBenchmarks(&collector);
  benchmark::ClearRegisteredBenchmarks();
  return std::move(collector).times();
}

}  // namespace rayshoot
