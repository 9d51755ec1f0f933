#pragma once

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <vector>

#include "accel/core/engine.h"

namespace rayshoot {

/// Rays a thread takes at a time: enough to make the one virtual call per batch invisible.
inline constexpr std::size_t kRaysPerBatch = 4096;

/// Scratch of every thread for one engine, made once and used for any number of passes.
template <class Real>
class ThreadScratch {
 public:
  explicit ThreadScratch(const Engine<Real>& engine) : scratch_([&engine] { return engine.scratch(); }) {}
  EngineScratch& local() { return *scratch_.local(); }

 private:
  tbb::enumerable_thread_specific<std::unique_ptr<EngineScratch>> scratch_;
};

/// Call `body(first, last)` for batches that cover [0, count), the same for any number of threads; on the calling thread
/// alone, without any scheduler, for one thread.
template <class Body>
void for_batches(std::size_t count, int threads, const Body& body) {
  if (threads == 1) {
    for (std::size_t first = 0; first < count; first += kRaysPerBatch)
      body(first, std::min(count, first + kRaysPerBatch));
    return;
  }
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena(threads).execute([&] {
    tbb::parallel_for(std::size_t{0}, (count + kRaysPerBatch - 1) / kRaysPerBatch, [&](std::size_t batch) {
      body(batch * kRaysPerBatch, std::min(count, (batch + 1) * kRaysPerBatch));
    });
  });
}

/// The nearest hit of every ray.
template <class Real>
void trace_closest(const Engine<Real>& engine, std::span<const Ray<Real>> rays, std::span<Hit<Real>> hits,
                   ThreadScratch<Real>& scratch, int threads) {
  for_batches(rays.size(), threads, [&](std::size_t first, std::size_t last) {
    engine.closest(rays.subspan(first, last - first), hits.subspan(first, last - first), scratch.local());
  });
}

/// Whether each ray meets anything.
template <class Real>
void trace_any(const Engine<Real>& engine, std::span<const Ray<Real>> rays, std::span<std::uint8_t> blocked,
               ThreadScratch<Real>& scratch, int threads) {
  for_batches(rays.size(), threads, [&](std::size_t first, std::size_t last) {
    engine.any(rays.subspan(first, last - first), blocked.subspan(first, last - first), scratch.local());
  });
}

/// Trace and count: the sum over all rays, which is the same for any number of threads.
template <class Real>
CountedWork count_work(const Engine<Real>& engine, Query query, std::span<const Ray<Real>> rays,
                       std::span<Hit<Real>> hits, ThreadScratch<Real>& scratch, int threads) {
  tbb::enumerable_thread_specific<CountedWork> work;
  for_batches(rays.size(), threads, [&](std::size_t first, std::size_t last) {
    work.local() += engine.count(query, rays.subspan(first, last - first), hits.subspan(first, last - first),
                                 scratch.local());
  });
  CountedWork sum;
  for (const CountedWork& part : work) sum += part;
  return sum;
}

}  // namespace rayshoot
