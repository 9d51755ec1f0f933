#pragma once

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <vector>

#include "accel/core/engine.h"

namespace rayshoot {

/// Scratch of every thread for one engine, made once and used for any number of passes.
template <class Real>
class ThreadScratch {
 public:
  explicit ThreadScratch(const Engine<Real>& engine) : scratch_([&engine] { return engine.scratch(); }) {}
  EngineScratch& local() { return *scratch_.local(); }

 private:
  tbb::enumerable_thread_specific<std::unique_ptr<EngineScratch>> scratch_;
};

/// Call `body(first, last)` for batches of `length` that cover [0, count); on the calling thread alone, without any
/// scheduler, for one thread.
template <class Body>
void for_batches(std::size_t count, std::size_t length, int threads, const Body& body) {
  if (threads == 1) {
    for (std::size_t first = 0; first < count; first += length) body(first, std::min(count, first + length));
    return;
  }
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena(threads).execute([&] {
    tbb::parallel_for(std::size_t{0}, (count + length - 1) / length, [&](std::size_t batch) {
      body(batch * length, std::min(count, (batch + 1) * length));
    });
  });
}

/// The length of batches that an engine asks for, as far as every thread gets some.
template <class Real>
std::size_t batch_length(const Engine<Real>& engine, std::size_t rays, int threads) {
  const std::size_t share = rays / static_cast<std::size_t>(threads) + 1;
  return std::max(kRaysPerBatch, std::min(engine.rays_per_batch(), share));
}

/// The nearest hit of every ray.
template <class Real>
void trace_closest(const Engine<Real>& engine, std::span<const Ray<Real>> rays, std::span<Hit<Real>> hits,
                   ThreadScratch<Real>& scratch, int threads) {
  for_batches(rays.size(), batch_length(engine, rays.size(), threads), threads,
              [&](std::size_t first, std::size_t last) {
                engine.closest(rays.subspan(first, last - first), hits.subspan(first, last - first),
                               scratch.local());
              });
}

/// Whether each ray meets anything.
template <class Real>
void trace_any(const Engine<Real>& engine, std::span<const Ray<Real>> rays, std::span<std::uint8_t> blocked,
               ThreadScratch<Real>& scratch, int threads) {
  for_batches(rays.size(), batch_length(engine, rays.size(), threads), threads,
              [&](std::size_t first, std::size_t last) {
                engine.any(rays.subspan(first, last - first), blocked.subspan(first, last - first),
                           scratch.local());
              });
}

/// Trace and count: the sum over all rays, which is the same for any number of threads.
template <class Real>
CountedWork count_work(const Engine<Real>& engine, Query query, std::span<const Ray<Real>> rays,
                       std::span<Hit<Real>> hits, ThreadScratch<Real>& scratch, int threads) {
  tbb::enumerable_thread_specific<CountedWork> work;
  for_batches(rays.size(), kRaysPerBatch, threads, [&](std::size_t first, std::size_t last) {
    work.local() += engine.count(query, rays.subspan(first, last - first), hits.subspan(first, last - first),
                                 scratch.local());
  });
  CountedWork sum;
  for (const CountedWork& part : work) sum += part;
  return sum;
}

}  // namespace rayshoot
