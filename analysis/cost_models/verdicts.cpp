#include "analysis/cost_models/verdicts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "analysis/statistics/rank_correlation.h"
#include "analysis/statistics/sample.h"
#include "analysis/tables/page.h"

namespace rayshoot::analysis {

namespace {

/// What a model is good for: a median error and a rank correlation.
constexpr double kPredicts = 0.1, kOrders = 0.9;
/// Fewer techniques than this have no order worth a correlation.
constexpr std::size_t kLeastOrdered = 4;

/// Predicted and measured times of some cells, those that were predicted.
struct Pairs {
  std::vector<double> predicted, measured;

  void add(const ModelCell& cell) {
    if (!cell.predicted) return;
    predicted.push_back(*cell.predicted);
    measured.push_back(cell.measured);
  }
};

/// The median, over scenes and rays, of the rank correlation among the techniques of each.
std::optional<double> spearman_within(const ModelFit& fit) {
  std::map<const Group*, Pairs> groups;
  for (const ModelCell& cell : fit.cells) groups[cell.group].add(cell);
  std::vector<double> correlations;
  for (const auto& [group, pairs] : groups)
    if (const auto rho = spearman(pairs.predicted, pairs.measured);
        rho && pairs.measured.size() >= kLeastOrdered)
      correlations.push_back(*rho);
  const auto middle = median(correlations);
  return middle ? std::optional(middle->value) : std::nullopt;
}

std::vector<std::string> failures_of(const ModelVerdict& verdict, const ModelBounds& bounds) {
  std::vector<std::string> failures;
  if (bounds.max_median_error && !(verdict.median_error && *verdict.median_error <= *bounds.max_median_error))
    failures.push_back(fmt::format("median error above {} %", significant(100 * *bounds.max_median_error)));
  if (bounds.min_spearman && !(verdict.spearman && *verdict.spearman >= *bounds.min_spearman))
    failures.push_back(fmt::format("Spearman below {}", significant(*bounds.min_spearman)));
  return failures;
}

}  // namespace

ModelVerdict verdict_of(const ModelFit& fit, const ModelBounds& bounds) {
  ModelVerdict verdict{.fit = &fit};
  Pairs pairs;
  for (const ModelCell& cell : fit.cells) pairs.add(cell);
  verdict.predicted = pairs.predicted.size();
  std::vector<double> errors;
  for (std::size_t i = 0; i < pairs.predicted.size(); ++i)
    errors.push_back(std::abs(*relative_error(pairs.predicted[i], pairs.measured[i])));
  if (!errors.empty()) {
    verdict.median_error = median(errors)->value;
    verdict.max_error = *std::max_element(errors.begin(), errors.end());
  }
  verdict.spearman = spearman(pairs.predicted, pairs.measured);
  verdict.kendall = kendall(pairs.predicted, pairs.measured);
  verdict.spearman_within = spearman_within(fit);
  verdict.failures = failures_of(verdict, bounds);
  return verdict;
}

std::string ModelVerdict::in_words() const {
  std::string words = median_error && *median_error <= kPredicts       ? "predicts times"
                      : spearman_within && *spearman_within >= kOrders ? "orders techniques"
                                                                       : "does neither";
  if (!failures.empty()) words += fmt::format("; FAILS: {}", fmt::join(failures, ", "));
  return words;
}

bool Validation::holds() const {
  return std::all_of(verdicts.begin(), verdicts.end(),
                     [](const ModelVerdict& verdict) { return verdict.failures.empty(); });
}

Validation judged(std::vector<ModelFit> fits, const ModelBounds& bounds) {
  Validation validation{.fits = std::move(fits)};
  for (const ModelFit& fit : validation.fits) validation.verdicts.push_back(verdict_of(fit, bounds));
  return validation;
}

Validation validate(const std::vector<Group>& groups, const std::vector<const CostModel*>& models,
                    const ModelBounds& bounds) {
  Validation validation = judged(fit_models(groups, models), bounds);
  if (validation.verdicts.empty())
    throw report::ReportError(
        "no cell was both counted and timed: there is nothing that a cost model could be held against");
  return validation;
}

}  // namespace rayshoot::analysis
