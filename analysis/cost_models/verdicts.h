#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/cost_models/model_fit.h"
#include "analysis/tables/table.h"

namespace rayshoot::analysis {

/// Bounds that a model must keep; absent ones are not asked for.
struct ModelBounds {
  std::optional<double> max_median_error, min_spearman;
};

/// How well a model predicts scenes that it was not fitted to.
struct ModelVerdict {
  const ModelFit* fit = nullptr;
  std::size_t predicted = 0;
  /// Of the absolute relative errors of the predicted times; absent without a prediction.
  std::optional<double> median_error, max_error;
  /// Whether cells are put in the right order: all of them, and the techniques of one scene and its rays, four or more,
  /// as the median of those.
  std::optional<double> spearman, kendall, spearman_within;
  /// What it does not keep, in words; empty when it holds.
  std::vector<std::string> failures;

  /// "predicts times" where the median error is at most 10 %, else "orders techniques" where the correlation within
  /// scenes is at least 0.9, else "does neither"; then what fails.
  std::string in_words() const;
};

ModelVerdict verdict_of(const ModelFit& fit, const ModelBounds& bounds);

struct Validation {
  std::vector<ModelFit> fits;
  std::vector<ModelVerdict> verdicts;
  bool holds() const;
};

/// How good fits are.
Validation judged(std::vector<ModelFit> fits, const ModelBounds& bounds);

/// Models, fitted and judged. All pointers lead into the groups, which must outlive it. Throws ReportError when there is
/// nothing to fit to.
Validation validate(const std::vector<Group>& groups, const std::vector<const CostModel*>& models,
                    const ModelBounds& bounds);

/// The verdicts; the bias by scene and by distribution of rays; the constants; which assumptions fail where cells are far
/// off; in CSV, and where asked for, every cell.
std::vector<Table> validation_tables(const Validation& validation, bool with_cells);
Table predictions_table(const Validation& validation);

}  // namespace rayshoot::analysis
