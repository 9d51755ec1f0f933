#include "harness/measure/run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "analysis/tables/comparison.h"
#include "analysis/tables/wall_time.h"
#include "harness/choose/choose.h"
#include "harness/cli/commands.h"
#include "harness/cli/long_run.h"
#include "harness/cli/progress.h"
#include "harness/cli/resume.h"
#include "harness/measure/environment.h"
#include "harness/plan/shard.h"

namespace rayshoot::cli {

namespace {

constexpr const char* kDefaultSuite = "quick";

/// What is given on the command line; what is not leaves the suite as it is.
struct Options {
  std::string suite;
  std::vector<std::string> scenes, techniques, rays, scalars, intersectors, work_maps;
  std::optional<int> resolution, threads;
  std::optional<std::string> rules;
  std::optional<std::uint64_t> seed, graded_rays;
  std::optional<double> target_m_error;
  bool counts_only = false;
  std::optional<std::string> shard;
  bool resume = false;
  std::string output;
  /// Of `run auto`, and of what is chosen.
  std::vector<std::string> scenes_of_auto, candidates;
  bool regret = false, no_race = false;
  std::optional<double> expected_rays;
};

template <class Value>
void replace(Value& target, const Value& given) {
  if (!given.empty()) target = given;
}

/// The suite that was asked for, by name or by its parts.
Suite suite_of(const Options& options) {
  Suite suite{.name = "command line"};
  if (!options.suite.empty() || options.scenes.empty())
    suite = load_suite(options.suite.empty() ? kDefaultSuite : options.suite);
  replace(suite.scenes, options.scenes);
  replace(suite.techniques, options.techniques);
  replace(suite.rays, options.rays);
  replace(suite.scalars, options.scalars);
  replace(suite.intersectors, options.intersectors);
  replace(suite.work_maps, options.work_maps);
  if (options.resolution) suite.resolution = options.resolution;
  if (options.rules) suite.rules = options.rules;
  suite.seed = options.seed.value_or(suite.seed);
  suite.target_m_error = options.target_m_error.value_or(suite.target_m_error);
  suite.graded_rays = options.graded_rays.value_or(suite.graded_rays);
  suite.threads = options.threads.value_or(suite.threads);
  suite.counts_only |= options.counts_only;
  return suite;
}

/// `run auto SCENE...` is short for the scenes, the technique that is chosen for each, and the baselines.
Options expanded(Options options) {
  if (options.suite != kAuto) {
    if (options.scenes_of_auto.empty()) return options;
    throw InputError(
        fmt::format("'{}' is one argument too many for rayshoot run", options.scenes_of_auto.front()));
  }
  options.suite.clear();
  options.scenes.insert(options.scenes.end(), options.scenes_of_auto.begin(), options.scenes_of_auto.end());
  if (options.scenes.empty())
    throw InputError("run auto: which scenes? Give them as in: run auto balls:4 tree:8");
  if (options.techniques.empty()) options.techniques = {"baselines"};
  options.techniques.emplace_back(kAuto);
  return options;
}

/// Whether a technique is to be chosen; the suite is left with its other techniques.
bool take_auto(Suite& suite, const Options& options) {
  const bool automatic = std::erase(suite.techniques, kAuto) > 0;
  if (!automatic &&
      (!options.candidates.empty() || options.regret || options.no_race || options.expected_rays))
    throw InputError(
        "--candidate, --regret, --no-race and --expected-rays go with run auto, or --technique auto");
  return automatic;
}

/// Choose techniques and add them to the plan.
std::vector<report::Choice> choose(Plan& plan, const Options& options) {
  const ChooserOptions chooser{options.candidates, !options.no_race && !plan.suite.counts_only,
                               options.expected_rays};
  Progress progress(plan.suite.scenes.size() * plan.rays.size() * plan.suite.scalars.size() *
                    plan.suite.intersectors.size());
  const auto choices = choose_techniques(plan, chooser, builtin_constants(), progress, interrupted);
  plan_choices(plan, choices, options.regret);
  return choices;
}

bool any_failure(const report::Report& report) {
  return std::any_of(report.measurements.begin(), report.measurements.end(), [](const auto& measurement) {
    return measurement.verdict.status == report::Status::wrong ||
           measurement.verdict.status == report::Status::failed;
  });
}

int run_command(const Options& given, const std::string& command_line) {
  const Options options = expanded(given);
  Suite suite = suite_of(options);
  const bool automatic = take_auto(suite, options);
  if (automatic && options.resume)
    throw InputError("--resume does not go with run auto: what is chosen may differ from what was");
  Plan plan = make_plan(std::move(suite));
  if (options.shard) keep_shard(plan, parse_shard(*options.shard));
  const report::Run started = started_run(command_line, plan.suite.seed);
  const std::string output = report_path(options.output, started.id);

  std::optional<report::Report> earlier;
  if (options.resume) earlier = earlier_part(output, started);
  if (earlier) skip_done(plan, *earlier);

  stop_on_interrupt();
  keep_freed_memory();
  std::vector<report::Choice> choices;
  if (automatic) choices = choose(plan, options);
  report::Report report;
  {
    Progress progress(plan.cells());
    Checkpoints checkpoints(progress, options.output, earlier);
    report = continued(earlier, run(plan, started, checkpoints, interrupted));
    report.choices = std::move(choices);
    // Written while the checkpoint is still there.
    report::write_report(report, output);
  }
  fmt::print("{}\nRun: {}\nReport: {}\n", analysis::render_comparison({report}, analysis::Format::text),
             analysis::wall_time(report.run), output);
  if (!report.run.complete) return kInterrupted;
  return any_failure(report) ? kCheckFailed : 0;
}

}  // namespace

void add_run(CLI::App& program, const std::string& command_line, int& status) {
  auto* command = program.add_subcommand("run", "Run a suite, write a report and print its tables");
  const auto options = std::make_shared<Options>();
  command->add_option("SUITE", options->suite,
                      fmt::format("A suite file, one of {}, or auto: choose a technique for each SCENE",
                                  fmt::join(builtin_suites(), ", ")));
  command->add_option("SCENE", options->scenes_of_auto, "Scenes of run auto");
  repeatable(command->add_option("--scene", options->scenes, "Scenes in place of the suite's"));
  repeatable(command->add_option("--technique", options->techniques,
                                 "Techniques in place of the suite's; auto for the one that is chosen"));
  repeatable(command->add_option("--rays", options->rays, "Ray distributions in place of the suite's"));
  repeatable(command->add_option("--scalar", options->scalars, "float or double; may be given twice"));
  repeatable(
      command->add_option("--intersector", options->intersectors,
                          "Ray-object test of triangles and polygons: fast, watertight, exact, or several"));
  command->add_option("--resolution", options->resolution, "Resolution of camera rays")
      ->check(CLI::Range(1, 16384));
  command->add_option("--rules", options->rules, "Rules of the ray tree");
  command->add_option(
      "--graded", options->graded_rays,
      "Nearest hits of every ray set that exact arithmetic grades: adds error against run time");
  command
      ->add_option(
          "--target-m-error", options->target_m_error,
          "Take as many rays as it needs until half the 95 % interval of every technique's M is at most so "
          "large a part of M: 0.01 for one per cent")
      ->check(CLI::Range(1e-4, 1.0));
  repeatable(command->add_option(
      "--work-map", options->work_maps,
      "A technique of this run whose work on eye rays is mapped pixel by pixel: `report` draws it"));
  command->add_option("--seed", options->seed, "Seed of everything random");
  command->add_option("--threads", options->threads, "Threads that trace while timed")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--counts-only", options->counts_only, "Verify and count, but take no time");
  command->add_option("--shard", options->shard,
                      "Only the I-th of N parts of the scenes, I/N; `merge` joins their reports");
  auto* output = command->add_option("-o,--output", options->output, "Where to write the report");
  command
      ->add_flag(
          "--resume", options->resume,
          "Go on where the same command was killed or interrupted: scenes that are done stay as they are")
      ->needs(output);
  repeatable(
      command->add_option("--candidate", options->candidates,
                          "What auto chooses among, in place of what the scene does not rule out; all"));
  command->add_flag("--regret", options->regret,
                    "Measure all candidates, and say how much was lost by the choice");
  command->add_flag("--no-race", options->no_race, "Choose by prediction alone");
  command
      ->add_option("--expected-rays", options->expected_rays,
                   "Rays that a build is to serve: its time is then part of what auto minimises")
      ->check(CLI::Range(1.0, 1e15));
  command->callback([options, command_line, &status] { status = run_command(*options, command_line); });
}

}  // namespace rayshoot::cli
