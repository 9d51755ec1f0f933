#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/cost_models/far_cells.h"
#include "analysis/cost_models/verdicts.h"
#include "analysis/statistics/geometric_mean.h"
#include "analysis/tables/comparison.h"

namespace rayshoot::analysis {

namespace {

std::string name_of(const ModelFit& fit) { return fmt::format("{}, {}", fit.model->id, fit.precision); }

std::string notes_of(const CostModel& model) {
  return fmt::format("{} ({}): {}; {}. Assumes that {}.", model.id, model.title, model.formula, model.source,
                     model.assumptions);
}

Table verdict_table(const Validation& validation) {
  Table table{
      .title = "Cost models against times of scenes they were not fitted to",
      .columns = {{"model", "model", "", "", Style::text},
                  {"cells", "cells", "", "cells of which the model speaks", Style::whole},
                  {"silent", "silent", "", "cells that it cannot predict", Style::whole},
                  {"median_error_percent", "median", "%", "median of the relative errors, without sign"},
                  {"max_error_percent", "max", "%", "the largest of them"},
                  {"spearman", "rho", "",
                   "Spearman's rank correlation of predicted and measured times, all cells"},
                  {"kendall", "tau", "", "Kendall's rank correlation, all cells"},
                  {"spearman_within", "rho in", "scene",
                   "Spearman's rho among the techniques of one scene and its rays, the median of those"},
                  {"verdict", "verdict", "", "", Style::text}},
      .notes = {"Each scene is predicted by constants fitted to all others, by least squares of relative "
                "errors, 0 or more. A model predicts times when the median error is at most 10 %, orders "
                "techniques when "
                "rho in a scene is at least 0.9."}};
  std::set<const CostModel*> explained;
  for (const ModelVerdict& verdict : validation.verdicts) {
    const ModelFit& fit = *verdict.fit;
    table.rows.push_back({words(name_of(fit)), number(static_cast<double>(verdict.predicted)),
                          number(static_cast<double>(fit.silent)), percent(verdict.median_error),
                          percent(verdict.max_error), number(verdict.spearman), number(verdict.kendall),
                          number(verdict.spearman_within), words(verdict.in_words())});
    if (explained.insert(fit.model).second) table.notes.push_back(notes_of(*fit.model));
  }
  return table;
}

/// Predicted over measured, by what a cell belongs to.
using Ratios = std::map<std::string, std::vector<std::optional<double>>>;

template <class Name>
Table bias_table(const Validation& validation, const std::string& of, const Name& name) {
  Table table{.title = fmt::format("Bias by {}: predicted over measured time - 1, geometric means", of),
              .columns = {{"of", of, "", "", Style::text}}};
  std::map<std::string, std::vector<Cell>> rows;
  const std::size_t models = validation.fits.size();
  for (std::size_t i = 0; i < models; ++i) {
    const ModelFit& fit = validation.fits[i];
    table.columns.push_back({fmt::format("{}_{}", fit.model->id, fit.precision), fit.model->id,
                             fmt::format("% {}", fit.precision), "", Style::signed_percent});
    Ratios ratios;
    for (const ModelCell& cell : fit.cells)
      if (cell.predicted) ratios[name(*cell.group)].push_back(*cell.predicted / cell.measured);
    for (const auto& [key, values] : ratios) {
      auto& row = rows[key];
      row.resize(models);
      if (const auto mean = geometric_mean(values).value) row[i] = {*mean - 1, ""};
    }
  }
  for (auto& [key, cells] : rows) {
    auto& row = table.rows.emplace_back(1, words(key));
    row.insert(row.end(), cells.begin(), cells.end());
  }
  return table;
}

std::string distribution_of(const Group& group) {
  return group.rays ? group.rays->distribution : group.rays_id;
}

Table constants_table(const ModelFit& fit) {
  Table table{.title = fmt::format("Constants of {}, fitted to all scenes", name_of(fit)),
              .columns = {{"technique", "technique", "", "", Style::text}}};
  for (const Constant& constant : fit.model->constants)
    table.columns.push_back({constant.name + "_ns", constant.name, "ns", ""});
  const auto append = [&](const std::string& technique, const std::vector<std::optional<double>>& constants) {
    auto& row = table.rows.emplace_back(1, words(technique));
    for (const auto& constant : constants) row.push_back(number(constant));
  };
  // What all share comes first.
  for (const bool shared : {true, false})
    for (const auto& [technique, constants] : fit.constants)
      if ((technique == kAllTechniques) == shared) append(technique, constants);
  return table;
}

}  // namespace

Table predictions_table(const Validation& validation) {
  Table table{.title = "Predicted and measured time of every cell",
              .columns = {technique_column(),
                          {"technique", "", "", "", Style::text, Place::csv},
                          {"cell", "scene, rays, precision", "", "", Style::text},
                          {"model", "model", "", "", Style::text},
                          {"measured_ns_per_ray", "measured", "ns/ray", ""},
                          {"predicted_ns_per_ray", "predicted", "ns/ray", ""},
                          {"error", "error", "%", "predicted / measured - 1", Style::signed_percent}}};
  for (const ModelFit& fit : validation.fits)
    for (const ModelCell& cell : fit.cells)
      table.rows.push_back({words(cell.entry->label), words(cell.entry->label),
                            words(title_of(*cell.group, false)), words(fit.model->id), number(cell.measured),
                            number(cell.predicted), number(relative_error(cell.predicted, cell.measured))});
  return table;
}

std::vector<Table> validation_tables(const Validation& validation, bool with_cells) {
  std::vector<Table> tables{
      verdict_table(validation),
      bias_table(validation, "scene", [](const Group& group) { return group.scene_id; }),
      bias_table(validation, "distribution of rays", distribution_of)};
  for (const ModelFit& fit : validation.fits) tables.push_back(constants_table(fit));
  for (Table& table : far_cells_tables(validation.fits, with_cells)) tables.push_back(std::move(table));
  if (with_cells) tables.push_back(predictions_table(validation));
  return tables;
}

}  // namespace rayshoot::analysis
