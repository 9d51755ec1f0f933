#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "harness/plan/plan.h"

namespace rayshoot {

/// A technique, built; or the reason why it could not be.
template <class Real>
struct Built {
  const TechniqueChoice* choice = nullptr;
  std::unique_ptr<Engine<Real>> engine;
  std::vector<double> build_ns;
  std::string failure;
};

/// Of the rays of a group every 256th is shown to techniques that look at a sample before they build, and no more
/// than so many.
inline constexpr std::size_t kRaysPerSampleRay = 256;
inline constexpr std::size_t kMostSampleRays = 8192;

/// That sample, evenly spaced over all sets, the same whenever it is taken.
template <class Real>
std::vector<Ray<Real>> sampled(const std::vector<const RaySet*>& sets);

/// Build a technique once. `recorded` and `sample` are for techniques that use them.
template <class Real>
Built<Real> build_once(const TechniqueChoice& technique, const Geometry<Real>& geometry,
                       const RecordedHits<Real>* recorded, const RaySample<Real>& sample);

/// Build techniques that have been built again and again, in turns, until there are `repetitions` times of
/// each or `seconds` are spent on it. What is built is thrown away.
template <class Real>
void repeat_builds(std::vector<Built<Real>>& built, const Geometry<Real>& geometry,
                   const RecordedHits<Real>* recorded, const RaySample<Real>& sample, int repetitions,
                   double seconds, const std::function<bool()>& stopped);

/// How often something that takes `seconds` fits into a budget: 1 to `wanted` times.
int affordable_repetitions(double budget, double seconds, int wanted);

/// Wall time of a call.
double seconds_of(const std::function<void()>& function);

/// Call `function`; returns what went wrong, in words, or nothing.
std::string failure_of(const std::function<void()>& function);

}  // namespace rayshoot
