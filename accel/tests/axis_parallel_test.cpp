// A ray along an axis meets walls, edges and corners of cells that a tilted one only comes near: it may not cost more.
#include <gtest/gtest.h>

#include "accel/core/batch.h"
#include "accel/core/registry.h"
#include "scenes/io/load_scene.h"

namespace rayshoot {
namespace {

class AxisParallel : public ::testing::TestWithParam<const TechniqueEntry*> {};

/// Rays along every axis from a lattice that meets the walls of regular cells, and the same tilted by `tilt`.
std::vector<Ray<float>> rays_along_axes(const Box<float>& box, float tilt) {
  constexpr int kSteps = 16;
  std::vector<Ray<float>> rays;
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i <= kSteps; ++i)
      for (int k = 0; k <= kSteps; ++k) {
        const int across = (axis + 1) % 3, up = (axis + 2) % 3;
        Ray<float> ray{.origin = box.lo, .direction = {tilt, tilt, tilt}};
        ray.origin[axis] = box.lo[axis] - box.extent()[axis];
        ray.origin[across] += box.extent()[across] * static_cast<float>(i) / kSteps;
        ray.origin[up] += box.extent()[up] * static_cast<float>(k) / kSteps;
        ray.direction[axis] = 1;
        rays.push_back(ray);
      }
  return rays;
}

Work work_of(const Engine<float>& engine, const std::vector<Ray<float>>& rays) {
  std::vector<Hit<float>> hits(rays.size());
  ThreadScratch<float> scratch(engine);
  return count_work<float>(engine, Query::closest, rays, hits, scratch, 1).total;
}

TEST_P(AxisParallel, StepsAreAtMostTwiceThoseOfTiltedRays) {
  for (const char* spec : {"lattice:6/curves", "mount:5", "balls:2/patches", "teapot:4"}) {
    const Scene scene = load_scene(spec).scene;
    const Geometry<float> geometry(scene);
    const Arguments arguments(GetParam()->info.parameters, {}, GetParam()->info.id);
    const auto engine = GetParam()->build<float>({geometry, arguments});
    const Work parallel = work_of(*engine, rays_along_axes(geometry.bounds(), 0));
    const Work tilted = work_of(*engine, rays_along_axes(geometry.bounds(), 1e-3f));
    EXPECT_LE(parallel.steps, 2 * tilted.steps) << spec;
    EXPECT_LE(parallel.volume_tests, 2 * tilted.volume_tests) << spec;
    EXPECT_LE(parallel.object_tests, 2 * tilted.object_tests) << spec;
  }
}

INSTANTIATE_TEST_SUITE_P(Techniques, AxisParallel,
                         ::testing::ValuesIn(technique_entries().begin(), technique_entries().end()),
                         [](const auto& technique) { return technique.param->info.id; });

}  // namespace
}  // namespace rayshoot
