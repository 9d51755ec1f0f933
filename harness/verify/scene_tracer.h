#pragma once

#include "accel/core/engine_tracer.h"

namespace rayshoot {

/// Finds nearest hits in a scene for those who generate rays: a fast technique in double precision, on all
/// threads. Stays where it was made.
class SceneTracer {
 public:
  SceneTracer(const Scene& scene, ConeSides cone_sides, int threads);
  SceneTracer(const SceneTracer&) = delete;

  const Tracer& tracer() const { return tracer_; }

 private:
  Geometry<double> geometry_;
  std::unique_ptr<Engine<double>> engine_;
  EngineTracer tracer_;
};

}  // namespace rayshoot
