#include <fmt/format.h>

#include <memory>

#include "harness/cli/commands.h"
#include "harness/cli/writable.h"
#include "harness/report/join.h"

namespace rayshoot::cli {

void add_merge(CLI::App& program) {
  struct Options {
    std::vector<std::string> reports;
    std::string output;
  };
  auto* command =
      program.add_subcommand("merge", "Join reports of different scenes, such as shards of one run");
  const auto options = std::make_shared<Options>();
  command->add_option("REPORT", options->reports, "Reports of one machine, commit and seed, in order")
      ->required();
  command->add_option("-o,--output", options->output, "Where to write the whole")->required();
  command->callback([options] {
    require_writable(options->output);
    std::vector<report::Report> reports;
    for (const std::string& path : options->reports) reports.push_back(report::read_report(path));
    const report::Report whole = report::joined(reports);
    report::write_report(whole, options->output);
    fmt::print("Report: {}, {} scenes, {} cells\n", options->output, whole.scenes.size(),
               whole.measurements.size());
  });
}

}  // namespace rayshoot::cli
