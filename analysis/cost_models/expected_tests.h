#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/cost_models/cost_model.h"
#include "analysis/tables/table.h"

/// Models that say how many tests a ray should cost, held against the tests that were counted.
namespace rayshoot::analysis {

/// A prediction this near is right.
inline constexpr double kRightWithin = 0.05;

/// What some models expect of a cell, in their order: relative errors, expected over counted less 1. Absent where a model
/// does not speak of the cell.
struct CellOfTests {
  const Group* group = nullptr;
  const Entry* entry = nullptr;
  std::vector<std::optional<double>> volume_errors, object_errors;
  /// The larger of both, without sign, where what a sample of the rays led to expect is held against the other rays.
  std::vector<std::optional<double>> errors_elsewhere;
};

/// The right cells that were counted and of which a model speaks; the models are those with `tests`.
std::vector<CellOfTests> cells_of_tests(const std::vector<Group>& groups,
                                        const std::vector<const CostModel*>& models);

/// How often a model is right.
struct TestsVerdict {
  std::size_t cells = 0;
  /// Of these, cells in which both errors are at most 5 %.
  std::size_t right = 0;
  /// The same of the rays that are not in the sample; absent where the model needs none.
  std::optional<std::size_t> right_elsewhere;
  std::optional<double> median_volumes, max_volumes, median_objects, max_objects;
};

/// Of the model at that place, for one distribution of rays, or for all where it is empty.
TestsVerdict verdict_of_tests(const std::vector<CellOfTests>& cells, std::size_t model,
                              const std::string& distribution);

/// Whether every model with `tests` speaks of some cell and errs by no more than that in any.
bool tests_hold(const std::vector<Group>& groups, const std::vector<const CostModel*>& models,
                double max_error);

/// How often each model is right, by distribution and by technique; then what was counted of every cell beside the errors of all. Empty
/// where no model speaks of any cell.
std::vector<Table> tests_tables(const std::vector<Group>& groups,
                                const std::vector<const CostModel*>& models);

}  // namespace rayshoot::analysis
