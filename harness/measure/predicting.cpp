#include "harness/measure/predicting.h"

#include <algorithm>
#include <random>

#include "accel/core/queries.h"
#include "harness/verify/reference.h"

namespace rayshoot {

namespace {

constexpr std::size_t kLeastOneIn = 4, kMostKnownRays = 16'384;

/// The fraction of rays whose interval meets a box.
template <class Real>
double fraction_hitting(const Box<Real>& box, const Batch<Real>& batch) {
  const auto hits = [&](const Ray<Real>& ray) {
    const Interval<Real> inside = Crossings<Real>(ray).inside(box);
    return inside.enter <= inside.exit && inside.exit > ray.t_min && inside.enter <= ray.t_max;
  };
  const auto count = std::count_if(batch.rays.begin(), batch.rays.end(), hits);
  return batch.rays.empty() ? 0 : static_cast<double>(count) / static_cast<double>(batch.rays.size());
}

/// Adds what rays that stand for `of_batch` of a batch cost on average.
void add(const Work& work, double of_batch, report::Predicted& sum) {
  if (work.rays == 0) return;
  const double weight = of_batch / static_cast<double>(work.rays);
  sum.object_tests_per_ray += weight * static_cast<double>(work.object_tests);
  sum.volume_tests_per_ray += weight * static_cast<double>(work.volume_tests);
}

template <class Real>
Work strict_work(const Engine<Real>& engine, const std::vector<Ray<Real>>& rays, ThreadScratch<Real>& scratch,
                 int threads) {
  std::vector<Hit<Real>> hits(rays.size());
  return count_work<Real>(engine, Query::strict, rays, hits, scratch, threads).total;
}

}  // namespace

template <class Real>
std::optional<report::Predicted> predict(const Engine<Real>& engine, const Batch<Real>& batch) {
  const auto prediction = engine.predicted();
  if (!prediction) return std::nullopt;
  // A technique that tests no volume is not shielded by its root: every ray costs it the same.
  if (prediction->volume_tests == 0) return report::Predicted{prediction->object_tests, 0};
  const double fraction = fraction_hitting(prediction->root, batch);
  return report::Predicted{fraction * prediction->object_tests,
                           fraction * prediction->volume_tests + (1 - fraction)};
}

template <class Real>
KnownRays<Real>::KnownRays(const Geometry<Real>& geometry, const Batch<Real>& batch, std::uint64_t seed,
                           int threads) {
  const std::size_t one_in = std::max(kLeastOneIn, batch.rays.size() / kMostKnownRays + 1);
  const auto all = static_cast<double>(std::max<std::size_t>(1, batch.rays.size()));
  closest_ = choose(Query::closest, batch.closest(), one_in, seed);
  any_ = choose(Query::any, batch.any(), one_in, seed + 1);
  const auto reference = build_default(kReferenceTechnique, geometry);
  for (Part* part : {&closest_, &any_}) {
    part->of_batch /= all;
    find_hits(geometry, *reference, *part, threads);
  }
}

template <class Real>
auto KnownRays<Real>::choose(Query query, std::span<const Ray<Real>> rays, std::size_t one_in,
                             std::uint64_t seed) -> Part {
  Part part{.query = query, .of_batch = static_cast<double>(rays.size()), .rays = {}};
  std::mt19937_64 generator(seed);
  for (std::size_t first = 0; first < rays.size(); first += one_in) {
    const std::size_t last = std::min(rays.size(), first + one_in) - 1;
    part.rays.push_back(rays[std::uniform_int_distribution(first, last)(generator)]);
  }
  return part;
}

/// Test every object of which the strict optimizer does not know that the ray misses it.
template <class Real>
void KnownRays<Real>::find_hits(const Geometry<Real>& geometry, const Engine<Real>& engine, Part& part,
                                int threads) {
  part.hits.resize(part.rays.size());
  part.to_nearest.resize(part.rays.size());
  ThreadScratch<Real> scratch(engine);
  for_batches(part.rays.size(), kRaysPerBatch, threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      Ray<Real> ray = begun(part.rays[i]);
      for (const std::uint32_t object : engine.candidates(Query::strict, ray, scratch.local()))
        if (const Real t = geometry.hit_distance(object, ray); t <= ray.t_max)
          part.hits[i].push_back({t, object});
      for (const Hit<Real>& hit : part.hits[i]) ray.t_max = std::min(ray.t_max, hit.t);
      part.to_nearest[i] = ray;
    }
  });
}

template <class Real>
std::optional<report::SampledPrediction> KnownRays<Real>::predict(const Engine<Real>& engine,
                                                                  int threads) const {
  if (!engine.countable() || engine.path_tests().empty()) return std::nullopt;
  ThreadScratch<Real> scratch(engine);
  report::SampledPrediction prediction;
  for (const Part* part : {&closest_, &any_}) {
    const auto known = engine.count_known(part->query, part->rays, part->hits, scratch.local());
    if (!known) return std::nullopt;
    prediction.sampled_rays += part->rays.size();
    add(strict_work(engine, part->rays, scratch, threads), part->of_batch, prediction.unoccluded);
    add(strict_work(engine, part->to_nearest, scratch, threads), part->of_batch, prediction.occluded);
    add(*known, part->of_batch, prediction.ordered);
  }
  return prediction;
}

template std::optional<report::Predicted> predict<float>(const Engine<float>&, const Batch<float>&);
template std::optional<report::Predicted> predict<double>(const Engine<double>&, const Batch<double>&);
template class KnownRays<float>;
template class KnownRays<double>;

}  // namespace rayshoot
