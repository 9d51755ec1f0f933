#include "harness/measure/enough_rays.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "harness/measure/building.h"
#include "harness/measure/counting.h"

namespace rayshoot {

namespace {

/// Rays, or pixels along an edge, to begin with.
constexpr long long kFirstRays = 1024, kFirstResolution = 32;
constexpr long long kMostRays = 100'000'000, kMostResolution = 8192;

/// The parameter by which a distribution's rays are counted, and how their number depends on it.
struct Size {
  const char* parameter;
  double power;
  long long first, most;
};

Size size_of(const RaySpec& spec) {
  const auto& parameters = spec.distribution->parameters;
  const bool counted = std::any_of(parameters.begin(), parameters.end(),
                                   [](const Parameter& parameter) { return parameter.name == "rays"; });
  return counted ? Size{"rays", 1, kFirstRays, kMostRays}
                 : Size{"resolution", 2, kFirstResolution, kMostResolution};
}

RaySpec resized(const RaySpec& spec, const Size& size, long long value) {
  std::vector<std::string> list{fmt::format("{}={}", size.parameter, value)};
  for (const auto& [name, given] : spec.arguments.values())
    if (name != size.parameter) list.push_back(name + "=" + text_of(given));
  return resolve_rays(fmt::format("{}({})", spec.distribution->id, fmt::join(list, ",")));
}

/// The techniques of a plan that can be counted, built over a scene.
template <class Real>
class CountedTechniques {
 public:
  CountedTechniques(const Plan& plan, const RaySpec& spec, const Scene& scene)
      : geometry_(scene, spec.cone_sides(), intersector_named(plan.suite.intersectors.front()),
                  plan.suite.bounds) {
    for (const TechniqueChoice& technique : plan.techniques) {
      if (technique.entry->info.needs_recorded_hits || !is_planned(technique, scene.id)) continue;
      if (!technique.entry->supports<Real>() ||
          geometry_.numbers() > technique.entry->info.max_practical_objects)
        continue;
      Built<Real> built = build_once<Real>(technique, geometry_, nullptr, {});
      if (built.engine && built.engine->countable()) techniques_.push_back(std::move(built));
    }
  }

  double worst_error(const RaySet& set, int threads) const {
    const Batch<Real> batch(set);
    double worst = 0;
    for (const Built<Real>& built : techniques_)
      worst = std::max(worst, relative_m_error(*built.engine, batch, geometry_.numbers(), threads));
    return worst;
  }

 private:
  Geometry<Real> geometry_;
  std::vector<Built<Real>> techniques_;
};

template <class Real>
RaySpec search(const Plan& plan, const RaySpec& spec, const Scene& scene, const Tracer& tracer, int threads,
               const std::function<bool()>& stopped) {
  const CountedTechniques<Real> techniques(plan, spec, scene);
  const Size size = size_of(spec);
  long long value = size.first;
  for (;;) {
    const RaySpec tried = resized(spec, size, value);
    const double error = techniques.worst_error(make_rays(tried, scene, tracer, plan.suite.seed), threads) /
                         plan.suite.target_m_error;
    if (error <= 1 || value == size.most || stopped()) return tried;
    // The error of a mean falls with the square root of the number of rays.
    const double rays = std::clamp(1.1 * error * error, 1.5, 16.0);
    value = std::min(size.most, static_cast<long long>(
                                    std::ceil(static_cast<double>(value) * std::pow(rays, 1 / size.power))));
  }
}

}  // namespace

RaySpec enough_rays(const Plan& plan, const RaySpec& spec, const Scene& scene, const Tracer& tracer,
                    int threads, const std::function<bool()>& stopped) {
  return plan.suite.scalars.front() == "float" ? search<float>(plan, spec, scene, tracer, threads, stopped)
                                               : search<double>(plan, spec, scene, tracer, threads, stopped);
}

}  // namespace rayshoot
