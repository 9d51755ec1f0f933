#include "harness/cli/validate_reports.h"

#include <fmt/format.h>

#include <iterator>

#include "analysis/cost_models/expected_tests.h"
#include "harness/cli/commands.h"
#include "harness/cli/formats.h"
#include "scenes/core/spec.h"

namespace rayshoot::cli {

namespace {

/// A bound that can be kept.
const CLI::Validator kAboveZero(
    [](const std::string& text) {
      double bound = 0;
      const bool above = CLI::detail::lexical_cast(text, bound) && bound > 0;
      return above ? std::string() : fmt::format("{} is not a number above 0", text);
    },
    "ABOVE 0");

/// The models that were asked for, or all.
std::vector<const analysis::CostModel*> models_named(const std::vector<std::string>& names) {
  std::vector<std::string> known;
  std::vector<const analysis::CostModel*> chosen;
  for (const analysis::CostModel* model : cost_models()) known.push_back(model->id);
  require_known("cost model", names, known);
  for (const analysis::CostModel* model : cost_models())
    if (names.empty() || std::find(names.begin(), names.end(), model->id) != names.end())
      chosen.push_back(model);
  return chosen;
}

/// The tests that models expect beside those that were counted; returns whether the bound holds.
bool validate_tests(const ReportValidation& options, const std::vector<analysis::Group>& groups,
                    const std::vector<const analysis::CostModel*>& models) {
  const std::vector<analysis::Table> tables = analysis::tests_tables(groups, models);
  if (tables.empty())
    throw report::ReportError("no cell has expected tests that could be held against counted ones");
  fmt::print("{}", analysis::render(tables, analysis::kFormats.at(options.format)));
  return !options.max_test_error || analysis::tests_hold(groups, models, *options.max_test_error);
}

}  // namespace

CLI::Option* add_report_options(CLI::App& command, ReportValidation& validation) {
  auto* reports = command.add_option("REPORT", validation.reports, "Reports to hold the cost models against");
  repeatable(command.add_option("--model", validation.models, "Cost models; all if not given"))
      ->needs(reports);
  command
      .add_option("--max-median-error", validation.bounds.max_median_error,
                  "Median relative error that no model may exceed: 0.05 for five per cent")
      ->check(kAboveZero)
      ->needs(reports);
  command
      .add_option("--min-spearman", validation.bounds.min_spearman,
                  "Spearman's rank correlation that every model must reach")
      ->check(CLI::Range(-1.0, 1.0))
      ->needs(reports);
  command.add_flag("--cells", validation.with_cells, "Show the predicted time of every cell")->needs(reports);
  auto* tests = command.add_flag("--tests", validation.of_tests,
                                 "Hold the tests that models expect against those counted, not times");
  tests->needs(reports);
  command
      .add_option("--max-test-error", validation.max_test_error,
                  "Relative error of expected tests that no cell of any model may exceed")
      ->check(kAboveZero)
      ->needs(tests);
  add_format(command, validation.format)->needs(reports);
  return reports;
}

bool validate_reports(const ReportValidation& options) {
  const auto models = models_named(options.models);
  std::vector<report::Report> reports;
  for (const std::string& path : options.reports) reports.push_back(report::read_report(path));
  std::vector<analysis::Group> groups;
  for (const report::Report& report : reports) {
    auto more = analysis::groups(report);
    std::move(more.begin(), more.end(), std::back_inserter(groups));
  }
  if (options.of_tests) return validate_tests(options, groups, models);
  const analysis::Validation validation = analysis::validate(groups, models, options.bounds);
  const analysis::Format format = analysis::kFormats.at(options.format);
  fmt::print("{}",
             format == analysis::Format::csv
                 ? analysis::render(analysis::predictions_table(validation), format)
                 : analysis::render(analysis::validation_tables(validation, options.with_cells), format));
  return validation.holds();
}

}  // namespace rayshoot::cli
