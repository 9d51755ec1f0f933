#include "harness/render/render.h"

#include <fmt/format.h>

#include "accel/core/engine_tracer.h"
#include "harness/render/eye_rays.h"
#include "harness/render/heat_map.h"
#include "harness/render/shading.h"

namespace rayshoot {

namespace {

constexpr int kLargestSide = 16384;

/// The size asked for, or that of the view, checked.
RenderOptions with_size(const RenderOptions& asked, const View& view) {
  RenderOptions options = asked;
  if (options.width == 0) options.width = view.width;
  if (options.height == 0) options.height = view.height;
  if (std::min(options.width, options.height) < 1 || std::max(options.width, options.height) > kLargestSide)
    throw InputError(fmt::format("a picture of {} x {} pixels cannot be drawn; each side may have 1 to {}",
                                 options.width, options.height, kLargestSide));
  return options;
}

[[noreturn]] void refuse(const TechniqueEntry& technique, const std::string& why) {
  throw InputError(fmt::format("{} cannot draw this picture: {}; try bvh_sah", technique.info.id, why));
}

Image shaded(const Scene& scene, const TechniqueEntry& technique, const Arguments& arguments,
             const RenderOptions& options) {
  if (!technique.supports<double>())
    refuse(technique, "shading is traced in double precision, which it does not have");
  const Geometry<double> geometry(scene);
  const auto engine = technique.build<double>({geometry, arguments});
  const EngineTracer tracer(*engine, geometry, 1);
  return shaded_picture(scene, tracer, options.width, options.height, options.samples, options.threads);
}

/// Count the work of one eye ray through the middle of each pixel.
template <class Real>
HeatMap work_map(const Scene& scene, const TechniqueEntry& technique, const Arguments& arguments,
                 const RenderOptions& options) {
  const Geometry<Real> geometry(scene);
  const auto engine = technique.build<Real>({geometry, arguments});
  if (!engine->countable()) refuse(technique, "its work cannot be counted");

  std::vector<Ray<Real>> rays;
  for (const Ray<double>& ray : eye_rays(scene.view, options.width, options.height, {0, options.height}, 1))
    rays.push_back({.origin = Vec3<Real>(ray.origin), .direction = Vec3<Real>(ray.direction)});
  HeatMap map{options.width, options.height, std::vector<double>(rays.size()), "", ""};
  ThreadScratch<Real> scratch(*engine);
  for_batches(rays.size(), kRaysPerBatch, options.threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      Hit<Real> hit;
      const Work work = engine->count(Query::closest, {&rays[i], 1}, {&hit, 1}, scratch.local()).total;
      map.values[i] = static_cast<double>(options.show == Show::tests ? work.object_tests : work.steps);
    }
  });
  map.title = options.show == Show::tests ? "object tests per eye ray" : "traversal steps per eye ray";
  map.subject = fmt::format("{} on {}", technique.info.id, scene.id);
  return map;
}

}  // namespace

Show show_named(const std::string& word) {
  if (word == "shaded") return Show::shaded;
  if (word == "tests") return Show::tests;
  if (word == "steps") return Show::steps;
  throw InputError(unknown_name("picture", word, {"shaded", "tests", "steps"}));
}

Image render(const Scene& scene, const TechniqueEntry& technique, const Arguments& arguments,
             const RenderOptions& asked) {
  const RenderOptions options = with_size(asked, scene.view);
  if (technique.info.needs_recorded_hits) refuse(technique, "it replays hits and finds none");
  if (options.show == Show::shaded) return shaded(scene, technique, arguments, options);
  return heat_picture(technique.supports<float>() ? work_map<float>(scene, technique, arguments, options)
                                                  : work_map<double>(scene, technique, arguments, options));
}

}  // namespace rayshoot
