#include <fmt/format.h>

#include <memory>

#include "analysis/tables/comparison.h"
#include "harness/cli/commands.h"
#include "scenes/core/spec.h"

namespace rayshoot::cli {

void add_table(CLI::App& program) {
  struct Options {
    std::vector<std::string> reports;
    std::string format = "text";
    bool regret = false;
  };
  auto* command = program.add_subcommand("table", "Print the comparison tables of reports");
  const auto options = std::make_shared<Options>();
  command->add_option("REPORT", options->reports, "Reports, as `run` writes them")->required();
  std::vector<std::string> formats;
  for (const auto& [name, format] : analysis::kFormats) formats.push_back(name);
  command->add_option("--format", options->format, "text, markdown, csv or latex")
      ->check(CLI::IsMember(formats));
  command->add_flag("--regret", options->regret, "Only what the choices of run auto cost beside the best");
  command->callback([options] {
    std::vector<report::Report> reports;
    for (const std::string& path : options->reports) reports.push_back(report::read_report(path));
    const analysis::Format format = analysis::kFormats.at(options->format);
    const std::string tables = options->regret ? analysis::render_regret(reports, format)
                                               : analysis::render_comparison(reports, format);
    if (options->regret && tables.empty())
      throw InputError("no choice was measured beside its candidates; run auto with --regret does that");
    fmt::print("{}", tables);
  });
}

}  // namespace rayshoot::cli
