#pragma once

#include "accel/core/batch.h"
#include "scenes/rays/ray_set.h"

namespace rayshoot {

/// The rays of a set in the precision in which they are traced. The first `closest_rays` ask for the nearest
/// hit, those behind them for any.
template <class Real>
struct Batch {
  std::vector<Ray<Real>> rays;
  std::size_t closest_rays = 0;

  explicit Batch(const RaySet& set) : rays(rays_in<Real>(set)), closest_rays(set.closest_rays) {}

  std::span<const Ray<Real>> all() const { return rays; }
  std::span<const Ray<Real>> closest() const { return all().first(closest_rays); }
  std::span<const Ray<Real>> any() const { return all().subspan(closest_rays); }
};

/// What a technique answers to a batch.
template <class Real>
struct Answers {
  std::vector<Hit<Real>> hits;
  std::vector<std::uint8_t> blocked;

  explicit Answers(const Batch<Real>& batch) : hits(batch.closest().size()), blocked(batch.any().size()) {}
};

/// Answer a whole batch once: what the harness verifies, and what it times.
template <class Real>
void trace(const Engine<Real>& engine, const Batch<Real>& batch, Answers<Real>& answers,
           ThreadScratch<Real>& scratch, int threads) {
  trace_closest(engine, batch.closest(), std::span(answers.hits), scratch, threads);
  trace_any(engine, batch.any(), std::span(answers.blocked), scratch, threads);
}

}  // namespace rayshoot
