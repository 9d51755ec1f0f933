#include "harness/verify/scene_tracer.h"

#include "harness/verify/reference.h"

namespace rayshoot {

SceneTracer::SceneTracer(const Scene& scene, ConeSides cone_sides, int threads)
    : geometry_(scene, cone_sides),
      engine_(build_default(kReferenceTechnique, geometry_)),
      tracer_(*engine_, geometry_, threads) {}

}  // namespace rayshoot
