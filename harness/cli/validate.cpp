#include <fmt/format.h>

#include <memory>
#include <thread>

#include "harness/cli/commands.h"
#include "harness/cli/validate_reports.h"
#include "harness/plan/catalogue.h"
#include "harness/verify/equation3.h"
#include "harness/verify/laws.h"
#include "harness/verify/scene_tracer.h"
#include "scenes/io/load_scene.h"
#include "scenes/rays/load_rays.h"

namespace rayshoot::cli {

namespace {

constexpr int kLawFailed = 1;
constexpr const char* kEquation3 = "equation-3";
/// More lines than a million hit the root volume of most scenes.
constexpr const char* kChords = "chords(rays=3000000)";

/// What the laws of the algebra are checked on.
constexpr const char* kRaysOfLaws[] = {"chords(rays=1000)", "primary@33", "diffuse(rays=500)"};

struct Options {
  std::vector<std::string> laws, scenes, techniques;
  /// Scenes on which all laws of the algebra are checked.
  std::vector<std::string> algebra;
  std::uint64_t seed = 1;
  ReportValidation reports;
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

/// Check the laws of Revelles and Ureña, a line each; returns whether they hold.
bool algebra_holds(const std::string& spec, std::uint64_t seed, int threads) {
  const Scene scene = load_scene(spec).scene;
  const Geometry<double> geometry(scene);
  const SceneTracer tracer(scene, ConeSides::both, threads);
  std::vector<Ray<double>> rays;
  for (const char* distribution : kRaysOfLaws) {
    if (!why_left_out(resolve_rays(distribution), scene).empty()) continue;
    const RaySet set = make_rays(distribution, scene, tracer.tracer(), seed);
    rays.insert(rays.end(), set.rays.begin(), set.rays.end());
  }
  bool all = true;
  check_laws(geometry, rays, [&](const LawCheck& check) {
    fmt::print("{:<20} {:<28} {:>8} {} {}\n", scene.id, check.law, check.rays,
               check.holds() ? "holds" : "FAILS", check.subject);
    if (!check.holds()) fmt::print("  {}\n", check.violation);
    all &= check.holds();
  });
  return all;
}

int validate_algebra(const Options& options, int threads) {
  for (const std::string& scene : options.algebra) scene_id(scene);
  fmt::print("{:<20} {:<28} {:>8} {}\n", "scene", "law of Revelles & Ureña", "rays",
             "it   technique or expression");
  bool all = true;
  for (const std::string& scene : options.algebra) all &= algebra_holds(scene, options.seed, threads);
  return all ? 0 : kLawFailed;
}

int validate_command(const Options& options) {
  const int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  if (!options.reports.reports.empty()) return validate_reports(options.reports) ? 0 : kLawFailed;
  if (!options.algebra.empty()) return validate_algebra(options, threads);
  if (options.laws.empty() || options.scenes.empty())
    throw InputError("give --laws SCENE, or --law and --scene, or REPORT");
  for (const std::string& law : options.laws)
    if (law != kEquation3) throw InputError(unknown_name("law", law, {kEquation3}));
  for (const std::string& scene : options.scenes) scene_id(scene);
  for (const std::string& technique : options.techniques) choose_technique(technique);
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
  auto* command = program.add_subcommand(
      "validate", "Hold cost models against reports, or check a law afresh on given scenes");
  const auto options = std::make_shared<Options>();
  auto* reports = add_report_options(*command, options->reports);
  auto* algebra =
      repeatable(command->add_option("--laws", options->algebra,
                                     "Scenes to check all laws of Revelles and Ureña on, (10) to (20), for "
                                     "every technique and a set of expressions"));
  algebra->excludes(reports);
  repeatable(command->add_option("--law", options->laws, kEquation3))->excludes(algebra)->excludes(reports);
  repeatable(command->add_option("--scene", options->scenes, "Scenes to check it on"))
      ->excludes(algebra)
      ->excludes(reports);
  command->add_option("--technique", options->techniques, "Techniques; all that it applies to if not given")
      ->excludes(algebra)
      ->excludes(reports);
  command->add_option("--seed", options->seed, "Seed of the lines");
  command->callback([options, &status] { status = validate_command(*options); });
}

}  // namespace rayshoot::cli
