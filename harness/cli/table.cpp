#include <fmt/format.h>

#include <memory>

#include "analysis/tables/comparison.h"
#include "harness/cli/commands.h"
#include "harness/cli/formats.h"

namespace rayshoot::cli {

void add_table(CLI::App& program) {
  struct Options {
    std::vector<std::string> reports;
    std::string format = "text";
  };
  auto* command = program.add_subcommand("table", "Print the comparison tables of reports");
  const auto options = std::make_shared<Options>();
  command->add_option("REPORT", options->reports, "Reports, as `run` writes them")->required();
  add_format(*command, options->format);
  command->callback([options] {
    std::vector<report::Report> reports;
    for (const std::string& path : options->reports) reports.push_back(report::read_report(path));
    fmt::print("{}", analysis::render_comparison(reports, analysis::kFormats.at(options->format)));
  });
}

}  // namespace rayshoot::cli
