#pragma once

#include <CLI/CLI.hpp>

#include "analysis/cost_models/verdicts.h"

namespace rayshoot::cli {

/// Holding the cost models against the times in reports.
struct ReportValidation {
  std::vector<std::string> reports, models;
  analysis::ModelBounds bounds;
  bool with_cells = false;
  /// Tests that are expected instead of times; and the error that none may exceed.
  bool of_tests = false;
  std::optional<double> max_test_error;
  std::string format = "text";
};

/// Declares its options, each of which needs a report, and returns the one that takes the reports.
CLI::Option* add_report_options(CLI::App& command, ReportValidation& validation);

/// Prints the verdicts; returns whether all bounds that were given hold.
bool validate_reports(const ReportValidation& validation);

}  // namespace rayshoot::cli
