#include "analysis/cost_models/far_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/statistics/sample.h"
#include "analysis/tables/comparison.h"

namespace rayshoot::analysis {

namespace {

constexpr std::array kAssumptionNames = {"scenes", "rays", "technique", "counts"};
constexpr std::array kAssumptionMeanings = {
    "a price is the same in all scenes: not so for objects of a kind that is rare elsewhere, or out of the "
    "caches",
    "a price is the same for all rays of a scene: not so where a processor guesses branches of coherent rays",
    "a price of this technique is one: not so where its steps or cells are of several sorts",
    "what is counted is all that costs time"};

/// Medians of values by what they belong to.
template <class Key>
class Medians {
 public:
  void add(const Key& key, double value) { values_[key].push_back(value); }
  double operator()(const Key& key) const { return median(values_.at(key))->value; }

  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const auto& [key, values] : values_) visit(key, median(values)->value);
  }

 private:
  std::map<Key, std::vector<double>> values_;
};

double log_ratio(const ModelCell& cell) { return std::log(*cell.predicted / cell.measured); }

/// Nothing is said of cells that are not predicted, or predicted to take no time.
bool speaks(const ModelCell& cell) { return cell.predicted && *cell.predicted > 0; }

Table counts_table(const std::vector<ModelFit>& fits) {
  Table table{
      .title = fmt::format("Cells that a model misses by more than {:.0f} %, by the assumption that fails",
                           100 * kFarOff),
      .columns = {{"model", "model", "", "", Style::text},
                  {"cells", "cells", "", "cells that the model predicts", Style::whole},
                  {"far_off", "far off", "", "", Style::whole}}};
  for (std::size_t i = 0; i < kAssumptionNames.size(); ++i) {
    table.columns.push_back(
        {kAssumptionNames[i], kAssumptionNames[i], "", kAssumptionMeanings[i], Style::whole});
  }
  for (const ModelFit& fit : fits) {
    std::array<double, kAssumptionNames.size()> counts{};
    const std::vector<FarCell> far = far_cells(fit);
    for (const FarCell& cell : far) ++counts[static_cast<std::size_t>(cell.assumption())];
    auto& row = table.rows.emplace_back(
        std::vector{words(fmt::format("{}, {}", fit.model->id, fit.precision)),
                    number(static_cast<double>(std::count_if(fit.cells.begin(), fit.cells.end(), speaks))),
                    number(static_cast<double>(far.size()))});
    for (const double count : counts) row.push_back(number(count));
  }
  table.notes.push_back(
      "The logarithm of predicted over measured is what all techniques have in common in a scene, plus what "
      "they have in common on these rays, plus what a technique has in all scenes, plus the rest, each a "
      "median. The assumption that fails is that behind the greatest part.");
  return table;
}

Table every_far_cell(const std::vector<ModelFit>& fits) {
  Table table{.title = "Every cell that is far off",
              .columns = {technique_column(),
                          {"cell", "scene, rays, precision", "", "", Style::text},
                          {"model", "model", "", "", Style::text},
                          {"error", "error", "%", "predicted / measured - 1", Style::signed_percent},
                          {"of_scene", "scene", "%", "each part of it by itself", Style::signed_percent},
                          {"of_rays", "rays", "%", "", Style::signed_percent},
                          {"of_technique", "technique", "%", "", Style::signed_percent},
                          {"rest", "rest", "%", "", Style::signed_percent},
                          {"assumption", "fails", "", "the assumption that fails", Style::text}}};
  for (const ModelFit& fit : fits)
    for (const FarCell& far : far_cells(fit)) {
      auto& row = table.rows.emplace_back(std::vector{words(far.cell->entry->label),
                                                      words(title_of(*far.cell->group, false)),
                                                      words(fit.model->id), number(far.error)});
      for (const double part : {far.of_scene, far.of_rays, far.of_technique, far.rest})
        row.push_back(number(std::expm1(part)));
      row.push_back(words(kAssumptionNames[static_cast<std::size_t>(far.assumption())]));
    }
  return table;
}

}  // namespace

Assumption FarCell::assumption() const {
  const std::array parts = {of_scene, of_rays, of_technique, rest};
  const double sign = error < 0 ? -1 : 1;
  const auto greatest =
      std::max_element(parts.begin(), parts.end(), [&](double a, double b) { return a * sign < b * sign; });
  return static_cast<Assumption>(greatest - parts.begin());
}

std::vector<FarCell> far_cells(const ModelFit& fit) {
  // Take off what is common to all techniques, scene by scene and rays by rays, then what is a technique's own.
  Medians<const Group*> of_group;
  for (const ModelCell& cell : fit.cells)
    if (speaks(cell)) of_group.add(cell.group, log_ratio(cell));
  Medians<std::string> of_scene, of_technique;
  of_group.for_each([&](const Group* group, double value) { of_scene.add(group->scene_id, value); });
  for (const ModelCell& cell : fit.cells)
    if (speaks(cell)) of_technique.add(cell.entry->label, log_ratio(cell) - of_group(cell.group));

  std::vector<FarCell> far;
  for (const ModelCell& cell : fit.cells) {
    if (!speaks(cell)) continue;
    FarCell parts{.cell = &cell, .error = *cell.predicted / cell.measured - 1};
    if (std::abs(parts.error) <= kFarOff) continue;
    parts.of_scene = of_scene(cell.group->scene_id);
    parts.of_rays = of_group(cell.group) - parts.of_scene;
    parts.of_technique = of_technique(cell.entry->label);
    parts.rest = log_ratio(cell) - parts.of_scene - parts.of_rays - parts.of_technique;
    far.push_back(parts);
  }
  return far;
}

std::vector<Table> far_cells_tables(const std::vector<ModelFit>& fits, bool with_cells) {
  const bool any =
      std::any_of(fits.begin(), fits.end(), [](const ModelFit& fit) { return !far_cells(fit).empty(); });
  if (!any) return {};
  std::vector<Table> tables{counts_table(fits)};
  if (with_cells) tables.push_back(every_far_cell(fits));
  return tables;
}

}  // namespace rayshoot::analysis
