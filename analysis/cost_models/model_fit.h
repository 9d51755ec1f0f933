#pragma once

#include <map>
#include <string>
#include <vector>

#include "analysis/cost_models/cost_model.h"

namespace rayshoot::analysis {

/// A cell of which a model speaks.
struct ModelCell {
  const Group* group = nullptr;
  const Entry* entry = nullptr;
  /// Nanoseconds a ray; predicted by constants that were fitted without any cell of this scene. Absent where those
  /// say nothing of it.
  double measured = 0;
  std::optional<double> predicted;
};

/// A model, fitted to all cells of a precision.
struct ModelFit {
  const CostModel* model = nullptr;
  std::string precision;
  std::vector<ModelCell> cells;
  /// Cells that were timed and counted, of which the model does not speak or that it could not predict.
  std::size_t silent = 0;
  /// In nanoseconds, fitted to all scenes, in the order of the model: those of every technique, absent where all share
  /// them, and those that all share, under "all". Of pooled models also those of a technique that is like all, under "all",
  /// and the same in each circumstance, under "all, incoherent" and the like.
  std::map<std::string, std::vector<std::optional<double>>> constants;
};

inline constexpr const char* kAllTechniques = "all";

/// Fit models to the right, timed and counted cells of each precision, by least squares of relative errors, constants
/// of 0 or more; then, leaving out one scene after the other, predict that scene's cells from the others. A cell is
/// not predicted where a term is more than ten times as large as in every other scene. Pooled models are fitted by the
/// logarithms of times, and predict every cell. The baselines, which do not search,
/// or do not tell how, take no part.
std::vector<ModelFit> fit_models(const std::vector<Group>& groups,
                                 const std::vector<const CostModel*>& models);

}  // namespace rayshoot::analysis
