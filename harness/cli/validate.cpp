#include <fmt/format.h>

#include <memory>
#include <thread>

#include "harness/cli/commands.h"
#include "harness/plan/catalogue.h"
#include "harness/verify/equation3.h"
#include "harness/verify/scene_tracer.h"
#include "scenes/io/load_scene.h"
#include "scenes/rays/load_rays.h"

namespace rayshoot::cli {

namespace {

constexpr int kLawFailed = 1;
constexpr const char* kEquation3 = "equation-3";
/// More lines than a million hit the root volume of most scenes.
constexpr const char* kChords = "chords(rays=3000000)";

struct Options {
  std::vector<std::string> laws, scenes, techniques;
  std::uint64_t seed = 1;
};

/// The techniques asked for; without any, all those of which equation (3) says something.
std::vector<TechniqueChoice> techniques_of(const Options& options, const Geometry<double>& geometry) {
  std::vector<TechniqueChoice> choices;
  for (const std::string& spec : options.techniques) choices.push_back(choose_technique(spec));
  if (!choices.empty()) return choices;
  for (const TechniqueEntry* entry : catalogue()) {
    if (!entry->supports<double>() || entry->info.needs_recorded_hits || entry->info.baseline) continue;
    const TechniqueChoice choice = choose_technique(entry->info.id);
    const auto engine = entry->build<double>({geometry, choice.arguments});
    if (engine->predicted() && engine->countable()) choices.push_back(choice);
  }
  return choices;
}

/// Check one technique on one scene, a line a quantity; returns whether the law holds.
bool holds(const std::string& scene, const TechniqueChoice& technique, const Geometry<double>& geometry,
           const RaySet& chords, int threads) {
  if (!technique.entry->supports<double>() || technique.entry->info.needs_recorded_hits)
    throw InputError(fmt::format("{}: {} does not apply to {}", scene, kEquation3, technique.spec));
  const auto engine = technique.entry->build<double>({geometry, technique.arguments});
  bool all = true;
  for (const Equation3Check& check : check_equation_3<double>(*engine, chords.rays, threads)) {
    fmt::print("{:<20} {:<24} {:<12} {:>12.6g} {:>12.6g}  [{:.6g}, {:.6g}] {:>9} {}\n", scene, technique.spec,
               check.quantity, check.predicted, check.measured, check.ci_low, check.ci_high, check.rays,
               check.holds() ? "holds" : "FAILS");
    all &= check.holds();
  }
  return all;
}

int validate_command(const Options& options) {
  for (const std::string& law : options.laws)
    if (law != kEquation3) throw InputError(unknown_name("law", law, {kEquation3}));
  for (const std::string& scene : options.scenes) scene_id(scene);
  for (const std::string& technique : options.techniques) choose_technique(technique);
  const int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  fmt::print("{:<20} {:<24} {:<12} {:>12} {:>12}  {}\n", "scene", "technique", "per line", "predicted",
             "measured", "95 % interval, lines, equation (3)");
  bool all = true;
  for (const std::string& spec : options.scenes) {
    const Scene scene = load_scene(spec).scene;
    const Geometry<double> geometry(scene);
    const RaySet chords =
        make_rays(kChords, scene, SceneTracer(scene, ConeSides::both, threads).tracer(), options.seed);
    for (const TechniqueChoice& technique : techniques_of(options, geometry))
      all &= holds(scene.id, technique, geometry, chords, threads);
  }
  return all ? 0 : kLawFailed;
}

}  // namespace

void add_validate(CLI::App& program, int& status) {
  auto* command = program.add_subcommand("validate", "Check a law afresh on given scenes");
  const auto options = std::make_shared<Options>();
  repeatable(command->add_option("--law", options->laws, kEquation3))->required();
  repeatable(command->add_option("--scene", options->scenes, "Scenes to check it on"))->required();
  command->add_option("--technique", options->techniques, "Techniques; all that it applies to if not given");
  command->add_option("--seed", options->seed, "Seed of the lines");
  command->callback([options, &status] { status = validate_command(*options); });
}

}  // namespace rayshoot::cli
