#include "harness/torture/torture.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <thread>

#include "analysis/tables/comparison.h"
#include "harness/cli/commands.h"
#include "harness/cli/long_run.h"
#include "harness/cli/progress.h"
#include "harness/measure/environment.h"

namespace rayshoot::cli {

namespace {

struct Options {
  TortureRequest request;
  std::vector<std::string> scalars, intersectors;
  int processes = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  std::string output;
};

std::vector<std::string> case_names() {
  std::vector<std::string> names;
  for (const StiffCase* one : stiff_cases()) names.push_back(one->id);
  return names;
}

int torture_command(const Options& options, const std::string& command_line) {
  TortureRequest request = options.request;
  if (!options.scalars.empty()) request.scalars = options.scalars;
  if (!options.intersectors.empty()) request.intersectors = options.intersectors;
  const TorturePlan plan(request);
  const report::Run started = started_run(command_line, request.seed);
  const std::string output = report_path(options.output, started.id);

  stop_on_interrupt();
  report::Report report;
  {
    Progress progress(plan.cells().size());
    report = torture(plan, options.processes, started, progress, interrupted);
  }
  report::write_report(report, output);
  fmt::print("{}\nReport: {}\n", analysis::render_comparison({report}, analysis::Format::text), output);
  if (!report.run.complete) return kInterrupted;
  return std::any_of(report.gradings.begin(), report.gradings.end(), faulty) ? kCheckFailed : 0;
}

}  // namespace

void add_torture(CLI::App& program, const std::string& command_line, int& status) {
  auto* command =
      program.add_subcommand("torture", "Hold techniques against exact arithmetic on the numerical suite");
  const auto options = std::make_shared<Options>();
  TortureRequest& request = options->request;
  repeatable(command->add_option("--case", request.cases,
                                 fmt::format("Cases: {}; all by default", fmt::join(case_names(), ", "))));
  repeatable(command->add_option("--technique", request.techniques,
                                 "Techniques; by default all, and Embree robust"));
  repeatable(command->add_option("--scalar", options->scalars, "float (default) or double; may be given twice"));
  repeatable(command->add_option("--intersector", options->intersectors,
                                 "fast, watertight, exact, or several; by default the first two"));
  command->add_flag("--flush-to-zero", request.flush_to_zero,
                    "Build and trace with denormal numbers taken as zero");
  command->add_option("--size", request.size, "1 is the short form; larger: more settings, objects and rays")
      ->check(CLI::Range(1, 1000));
  command
      ->add_option("--ray-count", request.rays, "Rays of every setting, in place of what the case asks for")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 48));
  command->add_option("--graded", request.graded_rays, "Rays of a setting that exact arithmetic grades");
  command->add_option("--seed", request.seed, "Seed of everything random");
  command->add_option("--processes", options->processes, "Cells that run at once")
      ->check(CLI::Range(1, 1024));
  command->add_option("-o,--output", options->output, "Where to write the report");
  command->callback([options, command_line, &status] { status = torture_command(*options, command_line); });
}

}  // namespace rayshoot::cli
