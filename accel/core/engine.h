#pragma once

#include <memory>
#include <string>

#include "accel/core/optimizer.h"

namespace rayshoot {

enum class Query { closest, any, strict };

/// Rays a thread takes at a time: enough to make the one virtual call per batch invisible.
inline constexpr std::size_t kRaysPerBatch = 4096;

/// What a counted batch found out, beyond the sum of its work: the moments of the number of distinct
/// candidates per ray, from which M and its interval follow, and of the tests, for the intervals of equation
/// (3).
struct CountedWork {
  Work total;
  double distinct_squares = 0;  ///< sum over rays of (distinct candidates)^2
  /// Sum over pairs of neighbours of (difference of their distinct candidates)^2: the rays 0 and 1 of a batch, 2 and 3 ...
  double distinct_differences = 0;
  double object_test_squares = 0;  ///< sum over rays of (object tests)^2
  double volume_test_squares = 0;  ///< sum over rays of (volume tests)^2
  double cell_squares = 0;         ///< sum over rays of (cells)^2

  CountedWork& operator+=(const CountedWork& other);
};

/// The tests that a ray costs which enters all volumes that an object is in, and no others.
struct PathTests {
  std::uint64_t volume_tests = 0, object_tests = 0;
};

/// A built technique behind the one virtual call per batch of rays. Objects in hits are those of the geometry
/// it was built from. Const: threads share it, each with a scratch of its own.
template <class Real>
class Engine {
 public:
  virtual ~Engine() = default;

  virtual std::unique_ptr<EngineScratch> scratch() const = 0;
  virtual void closest(std::span<const Ray<Real>> rays, std::span<Hit<Real>> hits,
                       EngineScratch& scratch) const = 0;
  virtual void any(std::span<const Ray<Real>> rays, std::span<std::uint8_t> blocked,
                   EngineScratch& scratch) const = 0;

  /// Whether the two functions below are available: engines that cannot be watched return false.
  virtual bool countable() const { return true; }
  /// Trace and count. Answers go to `hits`; for Query::any a hit's object says only whether there is one.
  virtual CountedWork count(Query query, std::span<const Ray<Real>> rays, std::span<Hit<Real>> hits,
                            EngineScratch& scratch) const = 0;
  /// The distinct candidates of one ray in increasing order.
  virtual std::vector<std::uint32_t> candidates(Query query, const Ray<Real>& ray,
                                                EngineScratch& scratch) const = 0;

  /// The work of searches for the closest hit or for any without a single object test: `known` are the hits of all objects
  /// on each ray, by increasing number. Nothing for engines that do not derive it; distinct objects are not counted.
  virtual std::optional<Work> count_known(Query, std::span<const Ray<Real>> /*rays*/,
                                          std::span<const std::vector<Hit<Real>>> /*known*/,
                                          EngineScratch&) const {
    return std::nullopt;
  }

  /// Rays that it had best be given at a time, where there are so many.
  virtual std::size_t rays_per_batch() const { return kRaysPerBatch; }
  virtual StructureStats structure() const = 0;
  virtual std::optional<Prediction<Real>> predicted() const { return std::nullopt; }
  /// Of every object, by its number; none where the technique is no hierarchy.
  virtual std::vector<PathTests> path_tests() const { return {}; }
};

/// A ray set with its verified nearest hits, for techniques that replay instead of search. The nearest hit of
/// a ray that asks for any hit is a hit as well.
template <class Real>
struct RecordedHits {
  std::span<const Ray<Real>> rays;
  std::span<const Hit<Real>> hits;
};

/// What an engine is built from. Geometry and recorded hits outlive the engine.
template <class Real>
struct EngineInput {
  const Geometry<Real>& geometry;
  const Arguments& arguments;
  /// Given to techniques with `needs_recorded_hits` alone.
  const RecordedHits<Real>* recorded = nullptr;
  RaySample<Real> sample{};
};

/// A technique in the registry. One file accel/<family>/<id>.cpp defines one, as `technique_<id>()`.
struct TechniqueEntry {
  TechniqueInfo info;
  template <class Real>
  using BuildEngine = std::function<std::unique_ptr<Engine<Real>>(const EngineInput<Real>&)>;
  template <class Real>
  using BuildOptimizer =
      std::function<std::unique_ptr<Optimizer<Real>>(const OptimizerInput<Real>&, const Arguments&)>;

  /// Build; throws InputError when the arguments contradict one another. Empty where a scalar is not supported.
  BuildEngine<float> build_float{};
  BuildEngine<double> build_double{};
  /// The same as part of a composition; empty for what is no optimizer in the sense of Revelles and Ureña.
  BuildOptimizer<float> optimizer_float{};
  BuildOptimizer<double> optimizer_double{};

  /// Whether it is based on spatial indexing, so that what is in its voxels can be divided again.
  bool indexes_space = false;
  /// Whether its optimizers are compositions, whose events are those of levels.
  bool composed = false;
  /// Whether it builds engines for scenes of placed parts itself.
  bool builds_parts = false;

  bool composable() const { return optimizer_float && optimizer_double; }
  bool searches_parts() const { return builds_parts || composable(); }
  template <class Real>
  bool supports() const {
    if constexpr (std::same_as<Real, float>)
      return static_cast<bool>(build_float);
    else
      return static_cast<bool>(build_double);
  }
  /// In a scene of placed parts with an optimizer for each part.
  template <class Real>
  std::unique_ptr<Engine<Real>> build(const EngineInput<Real>& input) const {
    if (input.geometry.has_placed() && !builds_parts) return build_in_parts(input);
    if constexpr (std::same_as<Real, float>)
      return build_float(input);
    else
      return build_double(input);
  }
  template <class Real>
  std::unique_ptr<Optimizer<Real>> build_optimizer(const OptimizerInput<Real>& input,
                                                   const Arguments& arguments) const {
    if constexpr (std::same_as<Real, float>)
      return optimizer_float(input, arguments);
    else
      return optimizer_double(input, arguments);
  }

 private:
  template <class Real>
  std::unique_ptr<Engine<Real>> build_in_parts(const EngineInput<Real>& input) const;
};

}  // namespace rayshoot
