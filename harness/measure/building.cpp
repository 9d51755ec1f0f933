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
                                    const RecordedHits<Real>* recorded, const RaySample<Real>& sample) {
  return technique.entry->template build<Real>({geometry, technique.arguments, recorded, sample});
}

}  // namespace

template <class Real>
Built<Real> build_once(const TechniqueChoice& technique, const Geometry<Real>& geometry,
                       const RecordedHits<Real>* recorded, const RaySample<Real>& sample) {
  Built<Real> built{.choice = &technique};
  const double seconds = seconds_of([&] {
    built.failure = failure_of([&] { built.engine = build(technique, geometry, recorded, sample); });
  });
  if (built.engine) built.build_ns.push_back(seconds * 1e9);
  return built;
}

template <class Real>
void repeat_builds(std::vector<Built<Real>>& built, const Geometry<Real>& geometry,
                   const RecordedHits<Real>* recorded, const RaySample<Real>& sample, int repetitions,
                   double seconds, const std::function<bool()>& stopped) {
  std::vector<Built<Real>*> repeated;
  std::vector<TimedPass> builds;
  std::unique_ptr<Engine<Real>> engine;
  for (Built<Real>& one : built) {
    if (!one.engine) continue;
    const int in_all = affordable_repetitions(seconds, one.build_ns.front() * 1e-9, repetitions);
    if (in_all < 2) continue;
    repeated.push_back(&one);
    builds.push_back({.pass = [&] { engine = build(*one.choice, geometry, recorded, sample); },
                      .tidy_up = [&] { engine.reset(); },
                      .repetitions = in_all - 1});
  }
  const auto times = time_interleaved(builds, stopped);
  for (std::size_t i = 0; i < repeated.size(); ++i)
    repeated[i]->build_ns.insert(repeated[i]->build_ns.end(), times[i].begin(), times[i].end());
}

template <class Real>
std::vector<Ray<Real>> sampled(const std::vector<const RaySet*>& sets) {
  std::size_t rays = 0;
  for (const RaySet* set : sets) rays += set->rays.size();
  const std::size_t stride = std::max(kRaysPerSampleRay, rays / kMostSampleRays + 1);

  std::vector<Ray<Real>> sample;
  std::size_t skip = stride / 2;
  for (const RaySet* set : sets) {
    for (; skip < set->rays.size(); skip += stride) {
      const Ray<double>& ray = set->rays[skip];
      sample.push_back({Vec3<Real>(ray.origin), static_cast<Real>(ray.t_min), Vec3<Real>(ray.direction),
                        static_cast<Real>(std::min<double>(ray.t_max, std::numeric_limits<Real>::max())),
                        static_cast<Real>(ray.time)});
    }
    skip -= set->rays.size();
  }
  return sample;
}

#define RAYSHOOT_BUILDING(REAL)                                                                             \
  template Built<REAL> build_once(const TechniqueChoice&, const Geometry<REAL>&, const RecordedHits<REAL>*, \
                                  const RaySample<REAL>&);                                                  \
  template void repeat_builds(std::vector<Built<REAL>>&, const Geometry<REAL>&, const RecordedHits<REAL>*,  \
                              const RaySample<REAL>&, int, double, const std::function<bool()>&);           \
  template std::vector<Ray<REAL>> sampled(const std::vector<const RaySet*>&);
RAYSHOOT_BUILDING(float)
RAYSHOOT_BUILDING(double)

}  // namespace rayshoot
