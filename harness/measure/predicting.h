#pragma once

#include <optional>

#include "harness/report/report.h"
#include "harness/verify/answers.h"

namespace rayshoot {

/// Equation (3) per ray of the batch; absent where the technique does not predict.
template <class Real>
std::optional<report::Predicted> predict(const Engine<Real>& engine, const Batch<Real>& batch);

/// Some rays of a batch, with the hits of all objects on each: what can be known of rays before any technique is.
template <class Real>
class KnownRays {
 public:
  /// One ray in four, or in as many as leave no more than 16384, each chosen at random among so many neighbours.
  KnownRays(const Geometry<Real>& geometry, const Batch<Real>& batch, std::uint64_t seed, int threads);

  /// Equation (3) per ray of the batch, with the chances that these rays have in place of surface areas; absent where the
  /// engine is no hierarchy of volumes.
  std::optional<report::SampledPrediction> predict(const Engine<Real>& engine, int threads) const;

 private:
  /// Rays that ask the same, and how many of the batch do.
  struct Part {
    Query query;
    double of_batch = 0;
    std::vector<Ray<Real>> rays;
    /// The same, none longer than to its nearest hit.
    std::vector<Ray<Real>> to_nearest{};
    /// By increasing number of the object.
    std::vector<std::vector<Hit<Real>>> hits{};
  };

  static Part choose(Query query, std::span<const Ray<Real>> rays, std::size_t one_in, std::uint64_t seed);
  static void find_hits(const Geometry<Real>& geometry, const Engine<Real>& engine, Part& part, int threads);

  Part closest_, any_;
};

extern template class KnownRays<float>;
extern template class KnownRays<double>;

}  // namespace rayshoot
