#include "analysis/cost_models/expected_tests.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/statistics/sample.h"
#include "analysis/tables/comparison.h"

namespace rayshoot::analysis {

namespace {

std::string distribution_of(const Group& group) {
  return group.rays ? group.rays->distribution : group.rays_id;
}

std::vector<const CostModel*> with_tests(const std::vector<const CostModel*>& models) {
  std::vector<const CostModel*> chosen;
  for (const CostModel* model : models)
    if (model->tests) chosen.push_back(model);
  return chosen;
}

/// The distributions of the cells, in the order in which they come.
std::vector<std::string> distributions(const std::vector<CellOfTests>& cells) {
  std::vector<std::string> names;
  for (const CellOfTests& cell : cells)
    if (const std::string name = distribution_of(*cell.group);
        std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  return names;
}

std::optional<double> median_of(const std::vector<double>& errors) {
  const auto middle = median(errors);
  return middle ? std::optional(middle->value) : std::nullopt;
}
std::optional<double> max_of(const std::vector<double>& errors) {
  return errors.empty() ? std::nullopt : std::optional(*std::max_element(errors.begin(), errors.end()));
}

Table verdict_table(const std::vector<CellOfTests>& cells, const std::vector<const CostModel*>& models) {
  Table table{
      .title = "Expected tests against counted ones",
      .columns = {{"model", "model", "", "", Style::text},
                  {"distribution", "rays", "", "", Style::text},
                  {"cells", "cells", "", "cells of which the model speaks", Style::whole},
                  {"right", "within", "5 %",
                   "cells in which the errors of volume tests and of object tests are both at most 5 %",
                   Style::whole},
                  {"right_elsewhere", "others", "5 %",
                   "the same where what a sample of the rays led to expect is held against the other rays",
                   Style::whole},
                  {"median_volumes_percent", "volumes", "% median",
                   "median and largest relative error of volume tests, without sign"},
                  {"max_volumes_percent", "volumes", "% max", ""},
                  {"median_objects_percent", "objects", "% median",
                   "median and largest relative error of object tests, without sign"},
                  {"max_objects_percent", "objects", "% max", ""}}};
  std::vector<std::string> rows = distributions(cells);
  if (rows.size() > 1) rows.push_back("");
  for (std::size_t i = 0; i < models.size(); ++i) {
    for (const std::string& name : rows) {
      const TestsVerdict verdict = verdict_of_tests(cells, i, name);
      table.rows.push_back({words(models[i]->id), words(name.empty() ? "all" : name), whole(verdict.cells),
                            whole(verdict.right),
                            verdict.right_elsewhere ? whole(*verdict.right_elsewhere) : Cell{},
                            percent(verdict.median_volumes), percent(verdict.max_volumes),
                            percent(verdict.median_objects), percent(verdict.max_objects)});
    }
    table.notes.push_back(
        fmt::format("{} ({}): assumes that {}.", models[i]->id, models[i]->title, models[i]->assumptions));
  }
  return table;
}

/// How many cells of every technique each model is right in.
Table techniques_table(const std::vector<CellOfTests>& cells, const std::vector<const CostModel*>& models) {
  Table table{.title = "Cells in which expected tests are within 5 % of counted ones, by technique",
              .columns = {{"technique", "technique", "", "", Style::text},
                          {"cells", "cells", "", "cells of the technique", Style::whole}}};
  for (const CostModel* model : models)
    table.columns.push_back(
        {model->id + "_right", model->tests->heading, "", model->id + " is right", Style::whole});
  std::map<std::string, std::vector<CellOfTests>> of_technique;
  for (const CellOfTests& cell : cells) of_technique[cell.entry->label].push_back(cell);
  for (const auto& [technique, members] : of_technique) {
    auto& row = table.rows.emplace_back(std::vector{words(technique), whole(members.size())});
    for (std::size_t i = 0; i < models.size(); ++i) {
      const TestsVerdict verdict = verdict_of_tests(members, i, "");
      row.push_back(verdict.cells > 0 ? whole(verdict.right) : Cell{});
    }
  }
  return table;
}

Table cells_table(const std::vector<CellOfTests>& cells, const std::vector<const CostModel*>& models,
                  const std::string& distribution) {
  Table table{.title = fmt::format("Tests of a ray, {}: counted, and expected / counted - 1", distribution),
              .columns = {technique_column(),
                          {"technique", "", "", "", Style::text, Place::csv},
                          {"cell", "scene", "", "", Style::text}}};
  const auto add_columns = [&](const std::string& tests, const std::string& title) {
    table.columns.push_back({tests + "_tests_per_ray", title, "/ray", ""});
    for (const CostModel* model : models)
      table.columns.push_back({fmt::format("{}_{}_error", model->id, tests), model->tests->heading, "%", "",
                               Style::signed_percent});
  };
  add_columns("volume", "volumes");
  add_columns("object", "objects");
  for (const CellOfTests& cell : cells) {
    if (distribution_of(*cell.group) != distribution) continue;
    auto& row = table.rows.emplace_back(
        std::vector{words(cell.entry->label), words(cell.entry->label),
                    words(fmt::format("{}, {}", cell.group->scene_id, precision_of(*cell.group)))});
    const auto append = [&](std::uint64_t report::Work::*count,
                            const std::vector<std::optional<double>>& errors) {
      row.push_back(number(counted(*cell.entry, count)));
      for (const auto& error : errors) row.push_back(number(error));
    };
    append(&report::Work::volume_tests, cell.volume_errors);
    append(&report::Work::object_tests, cell.object_errors);
  }
  return table;
}

/// What was counted on the rays outside of the sample: for those inside, `ordered` is what was counted.
std::optional<report::Predicted> counted_elsewhere(const report::Measurement& measurement) {
  const auto& sampled = measurement.sampled_prediction;
  const auto rays = static_cast<double>(measurement.work->rays);
  if (!sampled || !(static_cast<double>(sampled->sampled_rays) < rays)) return std::nullopt;
  const double share = static_cast<double>(sampled->sampled_rays) / rays;
  const auto rest = [&](std::uint64_t all, double inside) {
    return (static_cast<double>(all) / rays - share * inside) / (1 - share);
  };
  return report::Predicted{rest(measurement.work->object_tests, sampled->ordered.object_tests_per_ray),
                           rest(measurement.work->volume_tests, sampled->ordered.volume_tests_per_ray)};
}

std::optional<double> error_elsewhere(const ExpectedTests& tests, const report::Measurement& measurement) {
  const auto expected = tests.of(measurement), counted = counted_elsewhere(measurement);
  if (!tests.of_sample || !expected || !counted) return std::nullopt;
  const auto volumes = relative_error(expected->volume_tests_per_ray, counted->volume_tests_per_ray),
             objects = relative_error(expected->object_tests_per_ray, counted->object_tests_per_ray);
  if (!volumes || !objects) return std::nullopt;
  return std::max(std::abs(*volumes), std::abs(*objects));
}

}  // namespace

std::vector<CellOfTests> cells_of_tests(const std::vector<Group>& groups,
                                        const std::vector<const CostModel*>& models) {
  std::vector<CellOfTests> cells;
  for (const Group& group : groups)
    for (const Entry& entry : group.entries) {
      const report::Measurement& measurement = *entry.measurement;
      if (measurement.verdict.status != report::Status::ok || !measurement.work) continue;
      CellOfTests cell{&group, &entry, {}, {}, {}};
      for (const CostModel* model : with_tests(models)) {
        cell.errors_elsewhere.push_back(error_elsewhere(*model->tests, measurement));
        const auto tests = model->tests->of(measurement);
        const auto error = [&](double report::Predicted::*expected, std::uint64_t report::Work::*count) {
          return tests ? relative_error((*tests).*expected, per_ray(measurement.work, count)) : std::nullopt;
        };
        cell.volume_errors.push_back(
            error(&report::Predicted::volume_tests_per_ray, &report::Work::volume_tests));
        cell.object_errors.push_back(
            error(&report::Predicted::object_tests_per_ray, &report::Work::object_tests));
      }
      const auto said = [](const std::optional<double>& error) { return error.has_value(); };
      if (std::any_of(cell.volume_errors.begin(), cell.volume_errors.end(), said))
        cells.push_back(std::move(cell));
    }
  return cells;
}

TestsVerdict verdict_of_tests(const std::vector<CellOfTests>& cells, std::size_t model,
                              const std::string& distribution) {
  TestsVerdict verdict;
  std::vector<double> volume_errors, object_errors;
  for (const CellOfTests& cell : cells) {
    const auto &volumes = cell.volume_errors[model], &objects = cell.object_errors[model];
    if (!volumes || !objects) continue;
    if (!distribution.empty() && distribution_of(*cell.group) != distribution) continue;
    volume_errors.push_back(std::abs(*volumes));
    object_errors.push_back(std::abs(*objects));
    ++verdict.cells;
    verdict.right += std::abs(*volumes) <= kRightWithin && std::abs(*objects) <= kRightWithin;
    if (const auto& elsewhere = cell.errors_elsewhere[model])
      verdict.right_elsewhere = verdict.right_elsewhere.value_or(0) + (*elsewhere <= kRightWithin);
  }
  verdict.median_volumes = median_of(volume_errors);
  verdict.max_volumes = max_of(volume_errors);
  verdict.median_objects = median_of(object_errors);
  verdict.max_objects = max_of(object_errors);
  return verdict;
}

bool tests_hold(const std::vector<Group>& groups, const std::vector<const CostModel*>& models,
                double max_error) {
  const std::vector<CellOfTests> cells = cells_of_tests(groups, models);
  for (std::size_t i = 0; i < with_tests(models).size(); ++i) {
    const TestsVerdict verdict = verdict_of_tests(cells, i, "");
    if (!(verdict.cells > 0 && *verdict.max_volumes <= max_error && *verdict.max_objects <= max_error))
      return false;
  }
  return true;
}

std::vector<Table> tests_tables(const std::vector<Group>& groups,
                                const std::vector<const CostModel*>& models) {
  const std::vector<const CostModel*> chosen = with_tests(models);
  const std::vector<CellOfTests> cells = cells_of_tests(groups, chosen);
  if (cells.empty()) return {};
  std::vector<Table> tables{verdict_table(cells, chosen), techniques_table(cells, chosen)};
  for (const std::string& distribution : distributions(cells))
    tables.push_back(cells_table(cells, chosen, distribution));
  return tables;
}

}  // namespace rayshoot::analysis
