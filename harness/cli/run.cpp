#include "harness/measure/run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "analysis/tables/comparison.h"
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
  std::vector<std::string> scenes, techniques, rays, scalars, intersectors;
  std::optional<int> resolution, threads;
  std::optional<std::string> rules;
  std::optional<std::uint64_t> seed, graded_rays;
  std::optional<double> target_m_error;
  bool counts_only = false;
  std::optional<std::string> shard;
  bool resume = false;
  std::string output;
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
  if (options.resolution) suite.resolution = options.resolution;
  if (options.rules) suite.rules = options.rules;
  suite.seed = options.seed.value_or(suite.seed);
  suite.target_m_error = options.target_m_error.value_or(suite.target_m_error);
  suite.graded_rays = options.graded_rays.value_or(suite.graded_rays);
  suite.threads = options.threads.value_or(suite.threads);
  suite.counts_only |= options.counts_only;
  return suite;
}

bool any_failure(const report::Report& report) {
  return std::any_of(report.measurements.begin(), report.measurements.end(), [](const auto& measurement) {
    return measurement.verdict.status == report::Status::wrong ||
           measurement.verdict.status == report::Status::failed;
  });
}

int run_command(const Options& options, const std::string& command_line) {
  Plan plan = make_plan(suite_of(options));
  if (options.shard) keep_shard(plan, parse_shard(*options.shard));
  const report::Run started = started_run(command_line, plan.suite.seed);
  const std::string output = report_path(options.output, started.id);

  std::optional<report::Report> earlier;
  if (options.resume) earlier = earlier_part(output, started);
  if (earlier) skip_done(plan, *earlier);

  stop_on_interrupt();
  report::Report report;
  {
    Progress progress(plan.cells());
    Checkpoints checkpoints(progress, options.output, earlier);
    report = continued(earlier, run(plan, started, checkpoints, interrupted));
    // Written while the checkpoint is still there.
    report::write_report(report, output);
  }
  fmt::print("{}\nReport: {}\n", analysis::render_comparison({report}, analysis::Format::text), output);
  if (!report.run.complete) return kInterrupted;
  return any_failure(report) ? kCheckFailed : 0;
}

}  // namespace

void add_run(CLI::App& program, const std::string& command_line, int& status) {
  auto* command = program.add_subcommand("run", "Run a suite, write a report and print its tables");
  const auto options = std::make_shared<Options>();
  command->add_option("SUITE", options->suite,
                      fmt::format("A suite file, or one of {}", fmt::join(builtin_suites(), ", ")));
  repeatable(command->add_option("--scene", options->scenes, "Scenes in place of the suite's"));
  repeatable(command->add_option("--technique", options->techniques, "Techniques in place of the suite's"));
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
  command->callback([options, command_line, &status] { status = run_command(*options, command_line); });
}

}  // namespace rayshoot::cli
