#pragma once

#include "accel/core/batch.h"
#include "scenes/rays/distribution.h"

namespace rayshoot {

/// Lets ray distributions trace with an engine. Hits are renumbered from the geometry to the scene it came
/// from; both engine and geometry outlive the tracer.
class EngineTracer final : public Tracer {
 public:
  EngineTracer(const Engine<double>& engine, const Geometry<double>& geometry, int threads)
      : engine_(engine), geometry_(geometry), threads_(threads), scratch_(engine) {}

  void closest(std::span<const Ray<double>> rays, std::span<Hit<double>> hits) const override {
    trace_closest(engine_, rays, hits, scratch_, threads_);
    for (Hit<double>& hit : hits)
      if (hit.object != kNoObject) hit.object = geometry_.scene_number(hit.object);
  }
  void any(std::span<const Ray<double>> rays, std::span<std::uint8_t> blocked) const override {
    trace_any(engine_, rays, blocked, scratch_, threads_);
  }

 private:
  const Engine<double>& engine_;
  const Geometry<double>& geometry_;
  int threads_;
  mutable ThreadScratch<double> scratch_;
};

}  // namespace rayshoot
