#include "analysis/cost_models/pooled_prices.h"

#include <cmath>
#include <iterator>
#include <utility>

namespace rayshoot::analysis {

PooledPrices::PooledPrices(const CostModel& model, std::set<std::string> techniques)
    : model_(model), techniques_(std::move(techniques)) {}

PricedSum PooledPrices::sum_of(const PooledCell& cell) const {
  const std::size_t constants = model_.constants.size(), circumstances = cell.circumstances.size();
  const auto found = techniques_.find(cell.technique);
  const auto which = static_cast<std::size_t>(std::distance(techniques_.begin(), found));
  PricedSum sum;
  for (std::size_t i = 0; i < constants; ++i) {
    PricedAmount& priced = sum.emplace_back(PricedAmount{cell.terms[i], {{i, 1}}});
    for (std::size_t j = 0; j < circumstances; ++j)
      priced.powers.emplace_back((1 + j) * constants + i, cell.circumstances[j]);
    if (found != techniques_.end() && model_.constants[i].of_technique)
      priced.powers.emplace_back((1 + circumstances + which) * constants + i, 1);
  }
  return sum;
}

std::vector<Belief> PooledPrices::beliefs() const {
  const Pooling& pooling = *model_.pooling;
  std::vector<Belief> beliefs;
  for (const Constant& constant : model_.constants)
    beliefs.push_back({std::log(constant.guess.ns), constant.guess.certain});
  const std::size_t changes = model_.constants.size() * pooling.circumstances.size();
  beliefs.resize(beliefs.size() + changes, {0, pooling.indifferent});
  for (std::size_t i = 0; i < techniques_.size(); ++i)
    for (const Constant& constant : model_.constants) beliefs.push_back({0, constant.guess.alike});
  return beliefs;
}

std::vector<double> PooledPrices::constants(const std::string& technique,
                                            const std::vector<double>& circumstances,
                                            const std::vector<double>& unknowns) const {
  const std::vector<double> ones(model_.constants.size(), 1);
  std::vector<double> constants;
  for (const PricedAmount& priced : sum_of({technique, ones, circumstances}))
    constants.push_back(value_of({priced}, unknowns));
  return constants;
}

}  // namespace rayshoot::analysis
