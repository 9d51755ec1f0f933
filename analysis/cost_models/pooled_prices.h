#pragma once

#include <set>
#include <string>
#include <vector>

#include "analysis/cost_models/cost_model.h"
#include "analysis/statistics/priced_sums.h"

namespace rayshoot::analysis {

/// What a pooled model needs of a cell.
struct PooledCell {
  std::string technique;
  /// One for each constant; one for each circumstance.
  std::vector<double> terms, circumstances;
};

/// The constants of a pooled model as unknowns of a list, all logarithms: first those of all techniques; then, for one
/// circumstance after the other, what it adds to each; then the same for one technique after the other.
class PooledPrices {
 public:
  PooledPrices(const CostModel& model, std::set<std::string> techniques);

  const std::set<std::string>& techniques() const { return techniques_; }

  /// The time of a ray. A technique that is not in the list has the prices of all.
  PricedSum sum_of(const PooledCell& cell) const;

  /// The unknowns before anything is measured.
  std::vector<Belief> beliefs() const;

  /// The constants of a technique in some circumstances, in nanoseconds.
  std::vector<double> constants(const std::string& technique, const std::vector<double>& circumstances,
                                const std::vector<double>& unknowns) const;

 private:
  const CostModel& model_;
  std::set<std::string> techniques_;
};

}  // namespace rayshoot::analysis
