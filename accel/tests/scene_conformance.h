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

/// All ray sets that a scene can have among those that see its cones from the same sides.
inline std::vector<RaySet> small_ray_sets(const Scene& scene, ConeSides cone_sides) {
  const Geometry<double> geometry(scene, cone_sides);
  const Arguments none;
  const auto exhaustive = technique_entry("exhaustive").build<double>({geometry, none});
  std::vector<RaySet> sets;
  for (const RaySpec& spec : small_ray_specs())
    if (spec.cone_sides() == cone_sides && why_left_out(spec, scene).empty())
      sets.push_back(make_rays(spec, scene, EngineTracer(*exhaustive, geometry, 2), 1));
  return sets;
}

/// Build every variant of the techniques once and check it on the rays of all sets.
template <class Real>
void check_sets(std::span<const TechniqueEntry* const> entries, const Geometry<Real>& geometry,
                const std::vector<RaySet>& sets) {
  std::vector<Ray<Real>> rays;
  for (const RaySet& set : sets) {
    const std::vector<Ray<Real>> of_set = rays_in<Real>(set);
    rays.insert(rays.end(), of_set.begin(), of_set.end());
  }
  const auto expected = truths<Real>(geometry, rays);
  for (const TechniqueEntry* entry : entries) {
    if (!entry->supports<Real>() || (geometry.has_placed() && !entry->searches_parts())) continue;
    std::vector<Variant> of_entry = variants(*entry);
    // What goes through all objects takes its time: where they are many, one configuration does.
    if (entry->info.max_practical_objects < UINT64_MAX && geometry.numbers() > kSmallScene) of_entry.resize(1);
    for (const Variant& variant : of_entry) {
      SCOPED_TRACE(fmt::format("{}, {} bytes a number", variant.name(), sizeof(Real)));
      const Arguments arguments = variant.arguments();
      check_engine<Real>(*entry->build<Real>({geometry, arguments}), rays, expected);
      if (::testing::Test::HasFailure()) return;
    }
  }
}

/// Check `entries` on a scene in one form, in every precision that a technique supports.
inline void check_scene(const SceneGenerator& generator, SceneForm form,
                        std::span<const TechniqueEntry* const> entries) {
  const Arguments arguments(generator.parameters, {}, generator.id);
  const SceneOptions options = small_options(generator, arguments, form);
  SceneBuilder builder(options);
  generator.generate(options, arguments, builder);
  const Scene scene = std::move(builder).finish();
  SCOPED_TRACE(
      fmt::format("{}:{}/{}", generator.id, options.size, form == SceneForm::curves ? "curves" : "patches"));
  for (const ConeSides cone_sides : {ConeSides::both, ConeSides::outside}) {
    const std::vector<RaySet> sets = small_ray_sets(scene, cone_sides);
    check_sets<float>(entries, Geometry<float>(scene, cone_sides), sets);
    check_sets<double>(entries, Geometry<double>(scene, cone_sides), sets);
    if (::testing::Test::HasFailure()) return;
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
