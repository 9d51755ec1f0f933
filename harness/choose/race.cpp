#include "harness/choose/race.h"

#include <deque>

#include "harness/measure/timing.h"

namespace rayshoot {

namespace {

constexpr int kRounds = 11;
/// A round repeats shorter passes up to this length.
constexpr double kRoundSeconds = 0.01;

/// What an engine needs to trace, kept off the clock.
template <class Real>
struct Runner {
  const Engine<Real>& engine;
  ThreadScratch<Real> scratch;
  Answers<Real> answers;

  Runner(const Engine<Real>& own, const Batch<Real>& sample) : engine(own), scratch(own), answers(sample) {}
};

}  // namespace

template <class Real>
std::vector<std::vector<double>> race(const std::vector<const Engine<Real>*>& engines,
                                      const Batch<Real>& sample, int threads,
                                      const std::function<bool()>& stopped) {
  std::deque<Runner<Real>> runners;
  std::vector<TimedPass> passes;
  for (const Engine<Real>* engine : engines) {
    Runner<Real>& runner = runners.emplace_back(*engine, sample);
    passes.push_back(
        {.pass = [&runner, &sample,
                  threads] { trace(runner.engine, sample, runner.answers, runner.scratch, threads); },
         .repetitions = kRounds,
         .min_seconds = kRoundSeconds});
  }
  auto times = time_interleaved(passes, stopped);
  for (std::vector<double>& rounds : times)
    for (double& ns : rounds) ns /= static_cast<double>(sample.rays.size());
  return times;
}

template std::vector<std::vector<double>> race(const std::vector<const Engine<float>*>&, const Batch<float>&,
                                               int, const std::function<bool()>&);
template std::vector<std::vector<double>> race(const std::vector<const Engine<double>*>&,
                                               const Batch<double>&, int, const std::function<bool()>&);

}  // namespace rayshoot
