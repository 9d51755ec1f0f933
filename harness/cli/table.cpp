#include <fmt/format.h>

#include <memory>

#include "analysis/tables/comparison.h"
#include "analysis/tables/pivot.h"
#include "harness/cli/commands.h"
#include "harness/cli/formats.h"
#include "scenes/core/spec.h"

namespace rayshoot::cli {

namespace {

struct Options {
  std::vector<std::string> reports;
  std::string format = "text";
  analysis::PivotOptions pivot;
  bool regret = false, growth = false;
};

/// Options that choose what is shown; each one asks for tables of one's own.
std::vector<CLI::Option*> add_choices(CLI::App& command, analysis::PivotOptions& pivot) {
  const auto dimensions = [&](const char* name, std::vector<std::string>& target, const char* meaning) {
    return repeatable(command.add_option(name, target, meaning))
        ->delimiter(',')
        ->check(CLI::IsMember(analysis::kDimensions));
  };
  const auto only = [&](const char* name, const char* dimension) {
    return repeatable(command.add_option(
        name, pivot.only[dimension], fmt::format("Only what matches in '{}'; may hold * and ?", dimension)));
  };
  return {
      repeatable(
          command.add_option("--metric", pivot.metrics, "What to show, by the names of the columns in CSV"))
          ->delimiter(','),
      dimensions("--rows", pivot.rows, "What stands in rows: run, scene, rays, precision, technique, metric"),
      dimensions("--columns", pivot.columns,
                 "What stands in columns; there is a table for each value of the rest"),
      only("--scene", "scene"),
      only("--rays", "rays"),
      only("--precision", "precision"),
      only("--technique", "technique"),
      command.add_flag("--mean", pivot.mean, "Geometric means over the columns, and rows sorted by them")};
}

/// What was asked for, rendered.
std::string tables_of(const std::vector<report::Report>& reports, const Options& options,
                      const std::vector<CLI::Option*>& choices) {
  const analysis::Format format = analysis::kFormats.at(options.format);
  if (options.regret) {
    if (std::string tables = analysis::render_regret(reports, format); !tables.empty()) return tables;
    throw InputError("no choice was measured beside its candidates; run auto with --regret does that");
  }
  if (options.growth) {
    if (std::string tables = analysis::render_growth(reports, format); !tables.empty()) return tables;
    throw InputError(
        "no scene was measured in 3 sizes or more with rays of one kind; the suite scale does that");
  }
  const bool own =
      std::any_of(choices.begin(), choices.end(), [](const CLI::Option* o) { return o->count() > 0; });
  return own ? analysis::render(analysis::pivot_tables(reports, options.pivot), format)
             : analysis::render_comparison(reports, format);
}

}  // namespace

void add_table(CLI::App& program) {
  auto* command =
      program.add_subcommand("table", "Print the comparison tables of reports, or tables of your own");
  const auto options = std::make_shared<Options>();
  command->add_option("REPORT", options->reports, "Reports, as `run` writes them")->required();
  add_format(*command, options->format);
  const std::vector<CLI::Option*> choices = add_choices(*command, options->pivot);
  auto* regret = command->add_flag("--regret", options->regret,
                                   "Only what the choices of run auto cost beside the best");
  auto* growth = command->add_flag("--growth", options->growth,
                                   "Only how time, tests, build and memory grow with the number of objects, "
                                   "where a scene has several sizes");
  for (CLI::Option* choice : choices) regret->excludes(choice), growth->excludes(choice);
  regret->excludes(growth);
  command->callback([options, choices] {
    require_known("metric", options->pivot.metrics, analysis::metric_keys());
    std::vector<report::Report> reports;
    for (const std::string& path : options->reports) reports.push_back(report::read_report(path));
    fmt::print("{}", tables_of(reports, *options, choices));
  });
}

}  // namespace rayshoot::cli
