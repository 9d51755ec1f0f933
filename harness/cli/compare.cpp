#include "analysis/compare/compare.h"

#include <fmt/format.h>

#include <memory>

#include "analysis/compare/compare_tables.h"
#include "harness/cli/commands.h"
#include "harness/cli/formats.h"
#include "harness/cli/long_run.h"

namespace rayshoot::cli {

void add_compare(CLI::App& program, int& status) {
  struct Options {
    std::string before, after, format = "text";
    analysis::CompareOptions compare;
    bool all_cells = false;
  };
  auto* command = program.add_subcommand("compare", "Compare two reports of the same cells, as a gate");
  const auto options = std::make_shared<Options>();
  command->add_option("OLD", options->before, "Report from before a change")->required();
  command->add_option("NEW", options->after, "Report from after it")->required();
  command
      ->add_option("--tolerance", options->compare.tolerance,
                   "Part by which a time may grow and not be slower: 0.05 for five per cent")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command->add_option("--relative-to", options->compare.relative_to,
                      "A technique to divide times by before they are compared, such as embree");
  command->add_flag("--all", options->all_cells, "Show all cells, not only those that changed");
  add_format(*command, options->format);
  command->callback([options, &status] {
    const report::Report before = report::read_report(options->before),
                         after = report::read_report(options->after);
    const analysis::Comparison comparison = analysis::compare(before, after, options->compare);
    fmt::print("{}", analysis::render_compare(comparison, analysis::kFormats.at(options->format),
                                              options->all_cells));
    status = comparison.failed() ? kCheckFailed : 0;
  });
}

}  // namespace rayshoot::cli
