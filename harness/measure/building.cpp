#include "harness/measure/building.h"

#include <algorithm>
#include <chrono>

#include "harness/measure/timing.h"

namespace rayshoot {

double seconds_of(const std::function<void()>& function) {
  const auto start = std::chrono::steady_clock::now();
  function();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string failure_of(const std::function<void()>& function) try {
  function();
  return {};
} catch (const std::bad_alloc&) {
  return "out of memory";
} catch (const std::exception& error) {
  return error.what();
}

int affordable_repetitions(double budget, double seconds, int wanted) {
  return static_cast<int>(std::clamp(budget / std::max(seconds, 1e-9), 1.0, static_cast<double>(wanted)));
}

namespace {

template <class Real>
std::unique_ptr<Engine<Real>> build(const TechniqueChoice& technique, const Geometry<Real>& geometry,
                                    const RecordedHits<Real>* recorded) {
  return technique.entry->template build<Real>({geometry, technique.arguments, recorded});
}

}  // namespace

template <class Real>
Built<Real> build_once(const TechniqueChoice& technique, const Geometry<Real>& geometry,
                       const RecordedHits<Real>* recorded) {
  Built<Real> built{.choice = &technique};
  const double seconds = seconds_of(
      [&] { built.failure = failure_of([&] { built.engine = build(technique, geometry, recorded); }); });
  if (built.engine) built.build_ns.push_back(seconds * 1e9);
  return built;
}

template <class Real>
void repeat_builds(std::vector<Built<Real>>& built, const Geometry<Real>& geometry,
                   const RecordedHits<Real>* recorded, int repetitions, double seconds,
                   const std::function<bool()>& stopped) {
  std::vector<Built<Real>*> repeated;
  std::vector<TimedPass> builds;
  std::unique_ptr<Engine<Real>> engine;
  for (Built<Real>& one : built) {
    if (!one.engine) continue;
    const int in_all = affordable_repetitions(seconds, one.build_ns.front() * 1e-9, repetitions);
    if (in_all < 2) continue;
    repeated.push_back(&one);
    builds.push_back({.pass = [&] { engine = build(*one.choice, geometry, recorded); },
                      .tidy_up = [&] { engine.reset(); },
                      .repetitions = in_all - 1});
  }
  const auto times = time_interleaved(builds, stopped);
  for (std::size_t i = 0; i < repeated.size(); ++i)
    repeated[i]->build_ns.insert(repeated[i]->build_ns.end(), times[i].begin(), times[i].end());
}

template Built<float> build_once(const TechniqueChoice&, const Geometry<float>&, const RecordedHits<float>*);
template Built<double> build_once(const TechniqueChoice&, const Geometry<double>&,
                                  const RecordedHits<double>*);
template void repeat_builds(std::vector<Built<float>>&, const Geometry<float>&, const RecordedHits<float>*,
                            int, double, const std::function<bool()>&);
template void repeat_builds(std::vector<Built<double>>&, const Geometry<double>&, const RecordedHits<double>*,
                            int, double, const std::function<bool()>&);

}  // namespace rayshoot
