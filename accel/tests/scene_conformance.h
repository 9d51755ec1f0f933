#pragma once

#include "accel/core/engine_tracer.h"
#include "accel/tests/conformance.h"
#include "scenes/core/registry.h"
#include "scenes/rays/load_rays.h"

/// Conformance on every scene of the registry at a small size, in both forms, with rays of every
/// distribution.
namespace rayshoot::conformance {

inline constexpr double kSmallScene = 800;  // objects

/// The largest size with a small number of objects, or the smallest size there is.
inline SceneOptions small_options(const SceneGenerator& generator, const Arguments& arguments,
                                  SceneForm form) {
  SceneOptions options{.size = generator.min_size, .form = form, .tessellation = 1};
  while (options.size < generator.default_size) {
    SceneOptions larger = options;
    ++larger.size;
    if (generator.object_count(larger, arguments) > kSmallScene) break;
    options = larger;
  }
  return options;
}

/// Rays of every distribution that the scene can have, the ray trees by all three rule sets.
inline std::vector<RaySpec> small_ray_specs() {
  std::vector<RaySpec> specs;
  for (const RayDistribution* distribution : ray_distributions())
    specs.push_back(resolve_rays(distribution->id, {{"resolution", "9"}, {"rays", "150"}}));
  for (const char* rules : {"haines", "havran"})
    specs.push_back(resolve_rays("whitted", {{"resolution", "9"}, {"rules", rules}}));
  return specs;
}

template <class Real>
void check_rays(const TechniqueEntry& entry, const Scene& scene, const RaySpec& spec, const RaySet& set) {
  const Geometry<Real> geometry(scene, spec.cone_sides());
  const std::vector<Ray<Real>> rays = rays_in<Real>(set);
  const auto expected = truths<Real>(geometry, rays);
  for (const Variant& variant : variants(entry)) {
    SCOPED_TRACE(
        fmt::format("{} on {} with {}, {} bytes a number", variant.name(), scene.id, spec.id, sizeof(Real)));
    const Arguments arguments = variant.arguments();
    check_engine<Real>(*entry.build<Real>({geometry, arguments}), rays, expected);
    if (::testing::Test::HasFailure()) return;
  }
}

/// Check `entries` on a scene in one form, in every precision that a technique supports.
inline void check_scene(const SceneGenerator& generator, SceneForm form,
                        std::span<const TechniqueEntry* const> entries) {
  const Arguments arguments(generator.parameters, {}, generator.id);
  const SceneOptions options = small_options(generator, arguments, form);
  SceneBuilder builder(options);
  generator.generate(options, arguments, builder);
  Scene scene = std::move(builder).finish();
  scene.id =
      fmt::format("{}:{}/{}", generator.id, options.size, form == SceneForm::curves ? "curves" : "patches");
  for (const RaySpec& spec : small_ray_specs()) {
    if (!why_left_out(spec, scene).empty()) continue;
    const Geometry<double> geometry(scene, spec.cone_sides());
    const Arguments none;
    const auto exhaustive = technique_entry("exhaustive").build<double>({geometry, none});
    const RaySet set = make_rays(spec, scene, EngineTracer(*exhaustive, geometry, 2), 1);
    for (const TechniqueEntry* entry : entries) {
      if (entry->supports<float>()) check_rays<float>(*entry, scene, spec, set);
      if (entry->supports<double>()) check_rays<double>(*entry, scene, spec, set);
      if (::testing::Test::HasFailure()) return;
    }
  }
}

/// For tests with one parameter: every scene.
inline auto every_scene() {
  return ::testing::ValuesIn(scene_generators().begin(), scene_generators().end());
}

inline constexpr auto scene_name = [](const ::testing::TestParamInfo<const SceneGenerator*>& scene) {
  return scene.param->id;
};

}  // namespace rayshoot::conformance
