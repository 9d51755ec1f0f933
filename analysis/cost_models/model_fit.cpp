#include "analysis/cost_models/model_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "analysis/cost_models/pooled_prices.h"
#include "analysis/statistics/nnls.h"
#include "analysis/tables/comparison.h"

namespace rayshoot::analysis {

namespace {

constexpr double kFarthest = 10;

bool takes_part(const Entry& entry) {
  const std::string& technique = entry.measurement->technique;
  return entry.measurement->verdict.status == report::Status::ok && entry.measurement->work &&
         technique != kZeroOverhead && !technique.starts_with(kEmbree);
}

/// A cell and its terms.
struct Row {
  ModelCell cell;
  std::string technique;
  std::vector<double> terms;
};

/// Where the constants of some techniques stand in one list of unknowns: first those that all share.
class Unknowns {
 public:
  Unknowns(const CostModel& model, const std::vector<Row*>& rows) : constants_(model.constants) {
    for (const Constant& constant : constants_) (constant.of_technique ? own_ : shared_) += 1;
    for (const Row* row : rows) techniques_.insert(row->technique);
  }

  const std::set<std::string>& techniques() const { return techniques_; }

  /// The place of a constant in the list.
  std::size_t operator()(const std::string& technique, std::size_t constant) const {
    const bool own = constants_[constant].of_technique;
    std::size_t before = 0;
    for (std::size_t i = 0; i < constant; ++i) before += constants_[i].of_technique == own;
    const auto which = std::distance(techniques_.begin(), techniques_.find(technique));
    return own ? shared_ + own_ * static_cast<std::size_t>(which) + before : before;
  }

  /// The coefficients of a row.
  std::vector<double> coefficients(const Row& row) const {
    std::vector<double> result(shared_ + own_ * techniques_.size(), 0);
    for (std::size_t i = 0; i < row.terms.size(); ++i) result[(*this)(row.technique, i)] = row.terms[i];
    return result;
  }

 private:
  const std::vector<Constant>& constants_;
  std::size_t shared_ = 0, own_ = 0;
  std::set<std::string> techniques_;
};

/// The constants that fit rows best, but for those of a scene; nothing without rows.
std::optional<std::vector<double>> fitted(const std::vector<Row*>& rows, const Unknowns& unknowns,
                                          const std::string& without_scene) {
  std::vector<std::vector<double>> coefficients;
  std::vector<double> ones;
  for (const Row* row : rows) {
    if (row->cell.group->scene_id == without_scene) continue;
    // Divided by the time, what is left over is a relative error.
    auto& scaled = coefficients.emplace_back(unknowns.coefficients(*row));
    for (double& coefficient : scaled) coefficient /= row->cell.measured;
    ones.push_back(1);
  }
  const auto fit = non_negative_least_squares(coefficients, ones);
  return fit ? std::optional(fit->coefficients) : std::nullopt;
}

/// Whether a row lies so far outside of what was measured in other scenes that its constants are guesses: a term is more
/// than ten times as large as any there, of the same technique where techniques have constants of their own.
bool is_beyond(const Row& row, const std::vector<Row*>& rows, const CostModel& model) {
  const bool by_technique = std::any_of(model.constants.begin(), model.constants.end(),
                                        [](const Constant& c) { return c.of_technique; });
  for (std::size_t i = 0; i < row.terms.size(); ++i) {
    double greatest = 0;
    for (const Row* other : rows)
      if (other->cell.group->scene_id != row.cell.group->scene_id &&
          (!by_technique || other->technique == row.technique))
        greatest = std::max(greatest, other->terms[i]);
    if (row.terms[i] > kFarthest * greatest) return true;
  }
  return false;
}

void keep_constants(ModelFit& fit, const Unknowns& unknowns, const std::vector<double>& values) {
  const auto& constants = fit.model->constants;
  const auto keep = [&](const std::string& name, const std::string& technique, std::size_t constant) {
    auto& kept = fit.constants[name];
    kept.resize(constants.size());
    kept[constant] = values[unknowns(technique, constant)];
  };
  for (std::size_t i = 0; i < constants.size(); ++i)
    if (!constants[i].of_technique)
      keep(kAllTechniques, "", i);
    else
      for (const std::string& technique : unknowns.techniques()) keep(technique, technique, i);
}

/// Fit and predict rows that share constants.
void fit_together(ModelFit& fit, const std::vector<Row*>& rows) {
  const Unknowns unknowns(*fit.model, rows);
  if (const auto values = fitted(rows, unknowns, "")) keep_constants(fit, unknowns, *values);
  std::set<std::string> scenes;
  for (const Row* row : rows) scenes.insert(row->cell.group->scene_id);
  for (const std::string& scene : scenes) {
    const auto values = fitted(rows, unknowns, scene);
    if (!values) continue;
    for (Row* row : rows) {
      if (row->cell.group->scene_id != scene || is_beyond(*row, rows, *fit.model)) continue;
      const auto coefficients = unknowns.coefficients(*row);
      row->cell.predicted =
          std::inner_product(coefficients.begin(), coefficients.end(), values->begin(), 0.0);
    }
  }
}

PooledCell pooled_cell(const Row& row, const Pooling& pooling) {
  return {row.technique, row.terms,
          pooling.amounts ? pooling.amounts(*row.cell.group, *row.cell.entry) : std::vector<double>{}};
}

std::vector<double> fitted(const std::vector<Row*>& rows, const PooledPrices& prices, const Pooling& pooling,
                           const std::string& without_scene) {
  std::vector<PricedSum> sums;
  std::vector<double> times;
  for (const Row* row : rows) {
    if (row->cell.group->scene_id == without_scene) continue;
    sums.push_back(prices.sum_of(pooled_cell(*row, pooling)));
    times.push_back(row->cell.measured);
  }
  return fit_priced_sums(sums, times, prices.beliefs(), pooling.robust);
}

/// Those of all techniques, in each circumstance by itself as well, and those that a technique has of its own.
void keep_constants(ModelFit& fit, const PooledPrices& prices, const std::vector<double>& unknowns) {
  const auto& names = fit.model->pooling->circumstances;
  std::vector<double> circumstances(names.size(), 0);
  const auto keep = [&](const std::string& name, const std::string& technique) {
    for (const double constant : prices.constants(technique, circumstances, unknowns))
      fit.constants[name].emplace_back(constant);
  };
  keep(kAllTechniques, "");
  for (const std::string& technique : prices.techniques()) {
    keep(technique, technique);
    for (std::size_t i = 0; i < fit.model->constants.size(); ++i)
      if (!fit.model->constants[i].of_technique) fit.constants[technique][i].reset();
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    circumstances[i] = 1;
    keep(fmt::format("{}, {}", kAllTechniques, names[i]), "");
    circumstances[i] = 0;
  }
}

/// Fit and predict rows of a pooled model. It says something of every cell: what few scenes have is priced as it was guessed.
void fit_pooled(ModelFit& fit, const std::vector<Row*>& rows) {
  const Pooling& pooling = *fit.model->pooling;
  std::set<std::string> techniques, scenes;
  for (const Row* row : rows) techniques.insert(row->technique), scenes.insert(row->cell.group->scene_id);
  const PooledPrices prices(*fit.model, std::move(techniques));
  keep_constants(fit, prices, fitted(rows, prices, pooling, ""));
  if (scenes.size() < 2) return;
  for (const std::string& scene : scenes) {
    const auto unknowns = fitted(rows, prices, pooling, scene);
    for (Row* row : rows)
      if (row->cell.group->scene_id == scene)
        row->cell.predicted = value_of(prices.sum_of(pooled_cell(*row, pooling)), unknowns);
  }
}

/// Whether techniques have nothing in common: then each is a small system of its own.
bool is_separate(const CostModel& model) {
  return std::all_of(model.constants.begin(), model.constants.end(),
                     [](const Constant& constant) { return constant.of_technique; });
}

ModelFit fit_model(const CostModel& model, const std::string& precision,
                   const std::vector<const Group*>& groups) {
  ModelFit fit{.model = &model, .precision = precision};
  std::vector<Row> rows;
  for (const Group* group : groups)
    for (const Entry& entry : group->entries) {
      const auto time = time_per_ray(entry);
      if (!takes_part(entry) || !time || !(time->value > 0)) continue;
      if (auto terms = model.terms(*group, entry))
        rows.push_back({{group, &entry, time->value, std::nullopt}, entry.label, std::move(*terms)});
      else
        ++fit.silent;
    }
  std::map<std::string, std::vector<Row*>> together;
  for (Row& row : rows) together[is_separate(model) ? row.technique : kAllTechniques].push_back(&row);
  for (const auto& [name, members] : together)
    model.pooling ? fit_pooled(fit, members) : fit_together(fit, members);
  for (const Row& row : rows) {
    fit.silent += !row.cell.predicted;
    fit.cells.push_back(row.cell);
  }
  return fit;
}

}  // namespace

double counted(const Entry& entry, std::uint64_t report::Work::*count) {
  return per_ray(entry.measurement->work, count).value_or(0);
}

std::optional<std::vector<double>> test_terms(const std::optional<report::Predicted>& expected) {
  if (!expected) return std::nullopt;
  return std::vector{expected->volume_tests_per_ray, expected->object_tests_per_ray};
}

std::vector<ModelFit> fit_models(const std::vector<Group>& groups,
                                 const std::vector<const CostModel*>& models) {
  std::vector<std::pair<std::string, std::vector<const Group*>>> precisions;
  for (const Group& group : groups) {
    const std::string name = precision_of(group);
    auto found =
        std::find_if(precisions.begin(), precisions.end(), [&](const auto& p) { return p.first == name; });
    if (found == precisions.end()) found = precisions.insert(precisions.end(), {name, {}});
    found->second.push_back(&group);
  }
  std::vector<ModelFit> fits;
  for (const auto& [precision, members] : precisions)
    for (const CostModel* model : models)
      if (ModelFit fit = fit_model(*model, precision, members); !fit.cells.empty())
        fits.push_back(std::move(fit));
  return fits;
}

}  // namespace rayshoot::analysis
