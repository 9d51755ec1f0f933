#pragma once

#include <string>
#include <vector>

#include "analysis/cost_models/model_fit.h"
#include "analysis/tables/table.h"

/// Where a model is far off, and which of its assumptions fails there.
namespace rayshoot::analysis {

/// A model is far off by more than this part of the measured time.
inline constexpr double kFarOff = 0.25;

/// What the prices of a model are taken to be the same for.
enum class Assumption { scenes, rays, technique, counts };

/// A cell that a model misses. The logarithm of predicted over measured is the sum of four parts.
struct FarCell {
  const ModelCell* cell = nullptr;
  double error = 0;
  /// What all techniques have in common in this scene; what they have in common on these rays beyond that; what is this
  /// technique's beyond that, in all scenes; and what is left.
  double of_scene = 0, of_rays = 0, of_technique = 0, rest = 0;

  /// That of the part which is greatest towards the error.
  Assumption assumption() const;
};

/// In the order of the fit's cells.
std::vector<FarCell> far_cells(const ModelFit& fit);

/// How many cells each assumption puts far off, and every such cell. Empty where there is none.
std::vector<Table> far_cells_tables(const std::vector<ModelFit>& fits, bool with_cells);

}  // namespace rayshoot::analysis
