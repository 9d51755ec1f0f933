#include "analysis/work_precision/work_precision.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/tables/comparison.h"
#include "analysis/tables/page.h"
#include "analysis/work_precision/frontier.h"

namespace rayshoot::analysis {

namespace {

std::vector<Column> error_columns() {
  return {
      {"wrong_per_1e9", "wrong", "/1e9", "answers that exact arithmetic refutes"},
      {"wrong_per_1e9_upper", "below", "/1e9", "the rate of wrong answers is below this, at 95 %"},
      {"float_ulps_of_t_p999", "99.9 %", "ulps",
       "error in the distance that 999 of 1000 hits do not exceed, in ulps of a float in either precision"},
      {"ns_per_ray", "time", "ns/ray", "median of the repetitions"}};
}

std::vector<Cell> error_cells(const WorkPrecision& point) {
  return {{point.wrong_per_billion, ""},
          {point.wrong_upper, ""},
          {point.float_ulps_p999, ""},
          {point.ns_per_ray, ""}};
}

std::string stiffness_in_words(const WorkPrecisionDiagram& diagram) {
  return diagram.stiffness ? fmt::format(", stiffness {}", significant(*diagram.stiffness)) : "";
}

Table table_of(const WorkPrecisionDiagram& diagram) {
  Table table{
      .title = fmt::format("Error against run time: {}{}", diagram.rays_id, stiffness_in_words(diagram)),
      .columns = {{"technique", "technique", "", "", Style::text}}};
  for (Column& column : error_columns()) table.columns.push_back(std::move(column));
  table.columns.push_back(
      {"on_frontier", "frontier", "", "nothing is faster and errs as little", Style::text});
  for (const WorkPrecision& point : diagram.points) {
    auto& row = table.rows.emplace_back(1, Cell{std::nullopt, point.label});
    for (Cell& cell : error_cells(point)) row.push_back(std::move(cell));
    row.push_back({std::nullopt, point.on_frontier ? "*" : ""});
  }
  return table;
}

/// The frontier of every diagram, from the least to the greatest stiffness.
Table over_stiffness(std::vector<WorkPrecisionDiagram> diagrams) {
  std::stable_sort(diagrams.begin(), diagrams.end(),
                   [](const auto& a, const auto& b) { return a.stiffness < b.stiffness; });
  Table table{.title = "Error against run time over stiffness: the frontiers",
              .columns = {{"technique", "technique", "", "", Style::text},
                          {"rays", "rays", "", "", Style::text},
                          {"stiffness", "kappa", "", "scene diagonal / smallest feature"}}};
  for (Column& column : error_columns()) table.columns.push_back(std::move(column));
  for (const WorkPrecisionDiagram& diagram : diagrams)
    for (const WorkPrecision& point : diagram.points) {
      if (!point.on_frontier) continue;
      auto& row = table.rows.emplace_back();
      row = {{std::nullopt, point.label}, {std::nullopt, diagram.rays_id}, {diagram.stiffness, ""}};
      for (Cell& cell : error_cells(point)) row.push_back(std::move(cell));
    }
  return table;
}

}  // namespace

std::vector<Table> work_precision_tables(const std::vector<report::Report>& reports) {
  std::vector<Table> tables;
  for (const report::Report& report : reports) {
    const std::vector<Group> all = groups(report);
    const std::vector<WorkPrecisionDiagram> diagrams = work_precision_diagrams(all);
    for (const WorkPrecisionDiagram& diagram : diagrams) tables.push_back(table_of(diagram));
    if (diagrams.size() > 1) tables.push_back(over_stiffness(diagrams));
  }
  return tables;
}

}  // namespace rayshoot::analysis
