#include "harness/measure/run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <csignal>
#include <filesystem>
#include <memory>

#include "analysis/tables/comparison.h"
#include "harness/cli/commands.h"
#include "harness/cli/progress.h"
#include "harness/cli/writable.h"
#include "harness/measure/environment.h"

namespace rayshoot::cli {

namespace {

constexpr int kCheckFailed = 1;
constexpr int kInterrupted = 130;
constexpr const char* kDefaultSuite = "quick";

/// What is given on the command line; what is not leaves the suite as it is.
struct Options {
  std::string suite;
  std::vector<std::string> scenes, techniques, rays, scalars, intersectors;
  std::optional<int> resolution, threads;
  std::optional<std::string> rules;
  std::optional<std::uint64_t> seed;
  bool counts_only = false;
  std::string output;
};

volatile std::sig_atomic_t interrupts = 0;

/// The first interrupt asks the run to stop after the step in hand; a second one ends the program at once.
void interrupt(int signal) {
  interrupts = interrupts + 1;
  std::signal(signal, SIG_DFL);
}

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
  suite.threads = options.threads.value_or(suite.threads);
  suite.counts_only |= options.counts_only;
  return suite;
}

/// Reports of one's own go to results/local of the project the program was built in, or of the current
/// folder.
std::filesystem::path default_output(const std::string& run_id) {
  const std::filesystem::path project = RAYSHOOT_SOURCE;
  const auto folder =
      (std::filesystem::exists(project) ? project : std::filesystem::current_path()) / "results" / "local";
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed)
    throw InputError(fmt::format("{}: {}; say where to write with -o", folder.string(), failed.message()));
  return folder / (run_id + ".json");
}

bool any_failure(const report::Report& report) {
  return std::any_of(report.measurements.begin(), report.measurements.end(), [](const auto& measurement) {
    return measurement.verdict.status == report::Status::wrong ||
           measurement.verdict.status == report::Status::failed;
  });
}

int run_command(const Options& options, const std::string& command_line) {
  const Plan plan = make_plan(suite_of(options));
  const report::Run started = started_run(command_line, plan.suite.seed);
  const std::string output = options.output.empty() ? default_output(started.id).string() : options.output;
  require_writable(output);

  std::signal(SIGINT, interrupt);
  report::Report report;
  {
    Progress progress(plan.cells());
    report = run(plan, started, progress, [] { return interrupts > 0; });
  }
  report::write_report(report, output);
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
  repeatable(command->add_option("--scalar", options->scalars, "float, double or both"));
  repeatable(
      command->add_option("--intersector", options->intersectors,
                          "Ray-object test of triangles and polygons: fast, watertight, exact, or several"));
  command->add_option("--resolution", options->resolution, "Resolution of camera rays")
      ->check(CLI::Range(1, 16384));
  command->add_option("--rules", options->rules, "Rules of the ray tree");
  command->add_option("--seed", options->seed, "Seed of everything random");
  command->add_option("--threads", options->threads, "Threads that trace while timed")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--counts-only", options->counts_only, "Verify and count, but take no time");
  command->add_option("-o,--output", options->output, "Where to write the report");
  command->callback([options, command_line, &status] { status = run_command(*options, command_line); });
}

}  // namespace rayshoot::cli
