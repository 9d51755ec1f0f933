#include "analysis/tables/grading.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "analysis/statistics/rate.h"
#include "analysis/tables/labels.h"

namespace rayshoot::analysis {

namespace {

using report::Grading;

/// The gradings of one row: all settings of a case, or one of them.
using Row = std::vector<const Grading*>;

std::string label(const Labels& labels, const Grading& grading) {
  std::string text = labels(grading.technique, grading.config);
  if (grading.intersector != "fast") text += ", " + grading.intersector;
  if (grading.scalar != "float") text += ", " + grading.scalar;
  if (grading.flush_to_zero) text += ", flushed";
  return text;
}

template <class Count>
std::uint64_t sum(const Row& row, const Count& count) {
  std::uint64_t total = 0;
  for (const Grading* grading : row) total += count(*grading);
  return total;
}

/// A count, left blank where it is none.
Cell counted(std::uint64_t count) { return count == 0 ? Cell{} : Cell{static_cast<double>(count), ""}; }

Cell answers(const Row& row, const std::string& name) {
  return counted(sum(row, [&](const Grading& grading) {
    const auto found = grading.errors.answers.find(name);
    return found == grading.errors.answers.end() ? std::uint64_t{0} : found->second;
  }));
}

/// The largest of what some gradings have.
template <class Value>
Cell worst(const Row& row, const Value& value) {
  std::optional<double> most;
  for (const Grading* grading : row)
    if (const std::optional<double> own = value(*grading)) most = std::max(most.value_or(*own), *own);
  return {most, ""};
}

Cell ulps(const Row& row, double report::Ulps::*quantile) {
  return worst(row, [&](const Grading& grading) -> std::optional<double> {
    if (!grading.errors.ulps_of_t) return std::nullopt;
    return (*grading.errors.ulps_of_t).*quantile;
  });
}

std::uint64_t promised(const Row& row) {
  return sum(row, [](const Grading& g) { return g.property == "always_hit" ? g.rays : 0; });
}
std::uint64_t leaks(const Row& row) {
  return sum(row, [](const Grading& g) { return g.leaks; });
}

Cell leaks_per_billion(const Row& row) { return {per_billion(leaks(row), promised(row)), ""}; }

double work_per_ray(const Grading& grading) {
  const report::Work& work = *grading.work;
  return static_cast<double>(work.object_tests + work.volume_tests + work.steps) /
         static_cast<double>(work.rays);
}

/// Work per ray over that of the setting that it is a stressed form of.
std::optional<double> blow_up(const Grading& grading, const std::vector<Grading>& all) {
  if (!grading.work || !grading.base) return std::nullopt;
  for (const Grading& base : all)
    if (base.setting == *grading.base && base.torture_case == grading.torture_case &&
        base.technique == grading.technique && base.config == grading.config &&
        base.scalar == grading.scalar && base.intersector == grading.intersector && base.work &&
        work_per_ray(base) > 0)
      return work_per_ray(grading) / work_per_ray(base);
  return std::nullopt;
}

/// A column and how it is filled.
struct GradingColumn {
  Column column;
  std::function<Cell(const Row&, const std::vector<Grading>&)> cell;
};

GradingColumn answer_column(const char* name, const char* title, const char* meaning) {
  return {{fmt::format("{}_answers", name), title, "", meaning, Style::whole},
          [name](const Row& row, const auto&) { return answers(row, name); }};
}

GradingColumn ulp_column(const char* name, const char* title, double report::Ulps::*quantile) {
  return {{fmt::format("ulps_of_t_{}", name), title, "ulps", ""},
          [quantile](const Row& row, const auto&) { return ulps(row, quantile); }};
}

GradingColumn count_column(const char* name, const char* title, const char* meaning,
                           std::uint64_t Grading::*count) {
  return {{name, title, "", meaning, Style::whole}, [count](const Row& row, const auto&) {
            return counted(sum(row, [&](const Grading& grading) { return grading.*count; }));
          }};
}

const std::vector<GradingColumn>& grading_columns() {
  static const std::vector<GradingColumn> columns{
      {{"stiffness", "kappa", "", "scene diagonal / smallest feature, the largest of the settings"},
       [](const Row& row, const auto&) { return worst(row, [](const Grading& g) { return g.stiffness; }); }},
      count_column("rays", "rays", "rays answered", &Grading::rays),
      answer_column("exact", "exact", "answers that exact arithmetic confirms"),
      answer_column("ambiguous", "ambig", "answers about which half an ulp of the input decides"),
      answer_column("near", "near", "another object within 4 ulps of the nearest"),
      answer_column("wrong_object", "WRONG", "another object"),
      answer_column("false_miss", "MISS", "misses where something is hit"),
      answer_column("false_hit", "HIT", "hits where nothing is hit"),
      answer_column("not_a_number", "NAN", "distances that are not a number"),
      answer_column("over_steps", "LOST", "rays on which the bound of work was exceeded"),
      answer_column("crash", "CRASH", "rays that ended the program"),
      count_column("changed", "CHANGED", "answers that differ from those of the unstressed setting",
                   &Grading::changed),
      count_column("forbidden_hits", "BAD", "hits where no ray hits", &Grading::forbidden_hits),
      count_column("any_differs", "ANY", "rays for which the any-hit query disagrees", &Grading::any_differs),
      count_column("threads_differ", "THREADS", "answers that depend on the number of threads",
                   &Grading::threads_differ),
      {{"crossings_lost", "CROSS", "", "crossings that a strict optimizer's candidates lack", Style::whole},
       [](const Row& row, const auto&) {
         return counted(sum(row, [](const Grading& g) { return g.crossings_lost.value_or(0); }));
       }},
      {{"leaks_per_1e9", "leaks", "/1e9", "misses of rays that cannot miss"},
       [](const Row& row, const auto&) { return leaks_per_billion(row); }},
      {{"leaks_per_1e9_upper", "below", "/1e9", "the rate of leaks is below this, at 95 %"},
       [](const Row& row, const auto&) {
         return Cell{upper_bound_per_billion(leaks(row), promised(row)), ""};
       }},
      ulp_column("median", "median", &report::Ulps::median),
      ulp_column("p99", "99 %", &report::Ulps::p99),
      ulp_column("max", "max", &report::Ulps::max),
      {{"work_over_base", "work", "x", "work per ray / that of the unstressed setting, the largest"},
       [](const Row& row, const std::vector<Grading>& all) {
         return worst(row, [&](const Grading& g) { return blow_up(g, all); });
       }}};
  return columns;
}

/// Gradings of equal keys, in the order in which the keys come up.
template <class Key>
std::vector<Row> rows_by(const Row& gradings, const Key& key) {
  std::vector<Row> rows;
  for (const Grading* grading : gradings) {
    const auto found = std::find_if(rows.begin(), rows.end(),
                                    [&](const Row& row) { return key(*row.front()) == key(*grading); });
    found == rows.end() ? rows.push_back({grading}) : found->push_back(grading);
  }
  return rows;
}

std::vector<std::string> messages(const Row& row, const std::string& label) {
  std::vector<std::string> notes;
  for (const Grading* grading : row)
    if (grading->message)
      notes.push_back(fmt::format("{}, {}: {}", label, grading->setting, *grading->message));
  return notes;
}

Table table_of(const Row& gradings, const report::Report& report, const Labels& labels, bool by_setting) {
  Table table{.title = fmt::format("{}, {}", gradings.front()->torture_case, gradings.front()->property),
              .columns = {{"case", "case", "", "", Style::text, Place::csv},
                          {"setting", "setting", "", "", Style::text, Place::csv},
                          {"technique", "technique", "", "", Style::text}}};
  for (const GradingColumn& column : grading_columns()) table.columns.push_back(column.column);
  const auto key = [&](const Grading& grading) {
    return label(labels, grading) + (by_setting ? "|" + grading.setting : "");
  };
  for (const Row& row : rows_by(gradings, key)) {
    const Grading& first = *row.front();
    auto& cells = table.rows.emplace_back();
    cells = {{std::nullopt, first.torture_case},
             {std::nullopt, by_setting ? first.setting : ""},
             {std::nullopt, label(labels, first)}};
    for (const GradingColumn& column : grading_columns()) cells.push_back(column.cell(row, report.gradings));
    for (std::string& note : messages(row, label(labels, first))) table.notes.push_back(std::move(note));
  }
  return table;
}

}  // namespace

std::vector<Table> grading_tables(const std::vector<report::Report>& reports, bool by_setting) {
  std::vector<Table> tables;
  for (const report::Report& report : reports) {
    Labels labels;
    Row all;
    for (const Grading& grading : report.gradings)
      labels.add(grading.technique, grading.config), all.push_back(&grading);
    for (const Row& of_case : rows_by(all, [](const Grading& grading) { return grading.torture_case; }))
      tables.push_back(table_of(of_case, report, labels, by_setting));
  }
  return tables;
}

}  // namespace rayshoot::analysis
