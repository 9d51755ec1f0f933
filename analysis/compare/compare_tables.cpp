#include "analysis/compare/compare_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/statistics/same_twice.h"
#include "analysis/tables/comparison.h"
#include "analysis/tables/page.h"

namespace rayshoot::analysis {

namespace {

using report::Measurement;

/// Value, low and high end.
void append(std::vector<Cell>& row, const std::optional<Estimate>& estimate) {
  row.push_back(number(estimate ? std::optional(estimate->value) : std::nullopt));
  const auto interval = estimate ? estimate->interval : std::nullopt;
  row.push_back(number(interval ? std::optional(interval->low) : std::nullopt));
  row.push_back(number(interval ? std::optional(interval->high) : std::nullopt));
}

void append_columns(Table& table, const std::string& key, const std::string& title) {
  table.columns.push_back({key, title, "new/old", title + " of the new report over that of the old"});
  table.columns.push_back({key + "_low", "from", "", "95 % interval of the column before"});
  table.columns.push_back({key + "_high", "to", "", ""});
}

/// The geometric mean of ratios, with the interval of the mean of their logarithms.
std::optional<Estimate> mean_ratio(const std::vector<const TimeChange*>& changes) {
  std::vector<double> logarithms;
  for (const TimeChange* change : changes)
    if (change->ratio) logarithms.push_back(std::log(change->ratio->value));
  auto estimate = mean(logarithms);
  if (!estimate) return estimate;
  estimate->value = std::exp(estimate->value);
  if (auto& interval = estimate->interval) interval = {std::exp(interval->low), std::exp(interval->high)};
  return estimate;
}

std::string judgement_of(const ComparedCell& cell) {
  std::vector<std::string> all;
  const auto add = [&](const TimeChange& change, const std::string& what) {
    if (change.judgement == Judgement::slower) all.push_back(what + "slower");
    if (change.judgement == Judgement::faster) all.push_back(what + "faster");
  };
  add(cell.trace, "");
  add(cell.build, "build ");
  if (!cell.counts.empty()) all.push_back("counts");
  return fmt::format("{}", fmt::join(all, ", "));
}

Table overall(const Comparison& comparison) {
  Table table{
      .title = "Over all scenes and rays",
      .columns = {technique_column(), {"cells", "cells", "", "", Style::whole}},
      .notes = {"Geometric means over the cells that both reports timed, with the interval of the mean "
                "of their logarithms."}};
  append_columns(table, "trace_ratio", "time");
  append_columns(table, "build_ratio", "build");
  table.columns.push_back({"count_changes", "counts", "", "cells with a changed count", Style::whole});
  std::map<std::string, std::vector<const ComparedCell*>> rows;
  for (const ComparedCell& cell : comparison.cells) rows[cell.label].push_back(&cell);
  const auto append_row = [&](const std::string& name, const std::vector<const ComparedCell*>& cells) {
    std::vector<const TimeChange*> trace, build;
    std::size_t changed = 0;
    for (const ComparedCell* cell : cells) {
      trace.push_back(&cell->trace);
      build.push_back(&cell->build);
      changed += !cell->counts.empty();
    }
    auto& row = table.rows.emplace_back();
    row = {words(name), number(static_cast<double>(cells.size()))};
    append(row, mean_ratio(trace));
    append(row, mean_ratio(build));
    row.push_back(number(static_cast<double>(changed)));
  };
  std::vector<const ComparedCell*> all;
  for (const ComparedCell& cell : comparison.cells) all.push_back(&cell);
  append_row("all", all);
  for (const auto& [label, cells] : rows) append_row(label, cells);
  return table;
}

Table cells_table(const Comparison& comparison, bool all_cells) {
  Table table{.title = all_cells ? "All cells" : "Cells that changed",
              .columns = {technique_column(),
                          {"label", "", "", "", Style::text, Place::csv},
                          {"cell", "scene, rays, precision", "", "", Style::text},
                          {"before_ns_per_ray", "old", "ns/ray", "median of the repetitions"},
                          {"after_ns_per_ray", "new", "ns/ray", ""}}};
  append_columns(table, "trace_ratio", "time");
  append_columns(table, "build_ratio", "build");
  table.columns.push_back({"judgement", "change", "", "", Style::text});
  for (const ComparedCell& cell : comparison.cells) {
    const std::string judgement = judgement_of(cell);
    if (!all_cells && judgement.empty()) continue;
    auto& row = table.rows.emplace_back();
    row = {words(cell.label), words(cell.label), words(cell.group), number(cell.before_ns),
           number(cell.after_ns)};
    append(row, cell.trace.ratio);
    append(row, cell.build.ratio);
    row.push_back(words(judgement));
  }
  return table;
}

Table counts_table(const Comparison& comparison) {
  Table table{.title = "Counts that changed",
              .columns = {technique_column(),
                          {"cell", "scene, rays, precision", "", "", Style::text},
                          {"count", "count", "", "", Style::text},
                          {"before", "old", "", "", Style::text},
                          {"after", "new", "", "", Style::text}}};
  for (const ComparedCell& cell : comparison.cells)
    for (const CountChange& change : cell.counts)
      table.rows.push_back({words(cell.label), words(cell.group), words(change.name), words(change.before),
                            words(change.after)});
  return table;
}

std::string drift_note(const report::Report& report, const std::string& which) {
  std::vector<std::vector<double>> samples;
  for (const Measurement& cell : report.measurements) samples.push_back(cell.trace_ns);
  const SameTwice check = same_twice(samples);
  if (check.samples == 0) return {};
  return fmt::format(
      "A/A check of the {} report: in {} of {} cells the second half of the repetitions differs "
      "from the first at 95 %{}.",
      which, check.differ, check.samples,
      check.chance < 0.01 ? "; more than by chance: the machine drifted while it measured" : "");
}

std::string cells_in_words(std::size_t count) {
  return fmt::format("{} cell{}", count, count == 1 ? "" : "s");
}

std::string repetitions_note(const Comparison& comparison) {
  const auto few =
      std::count_if(comparison.cells.begin(), comparison.cells.end(),
                    [](const ComparedCell& cell) { return cell.trace.ratio && !cell.trace.ratio->interval; });
  if (few == 0) return {};
  return fmt::format("{} have too few repetitions for an interval: no slowdown of theirs can be flagged.",
                     cells_in_words(static_cast<std::size_t>(few)));
}

std::string environment_note(const Comparison& comparison) {
  const report::Environment &before = comparison.before->environment, &after = comparison.after->environment;
  std::vector<std::string> differing;
  const auto compare = [&](const std::string& what, const std::string& a, const std::string& b) {
    if (a != b) differing.push_back(fmt::format("{} ('{}' and '{}')", what, a, b));
  };
  compare("processor", before.cpu, after.cpu);
  compare("compiler", before.compiler, after.compiler);
  compare("flags", before.flags, after.flags);
  compare("operating system", before.os, after.os);
  if (differing.empty()) return {};
  return fmt::format("Not alike: {}.", fmt::join(differing, ", "));
}

std::string listed(const std::string& what, const std::vector<std::string>& names) {
  constexpr std::size_t most = 10;
  if (names.empty()) return {};
  const auto end = names.begin() + static_cast<std::ptrdiff_t>(std::min(most, names.size()));
  return fmt::format("{}: {}{}.", what, fmt::join(names.begin(), end, "; "),
                     names.size() > most ? fmt::format("; and {} more", names.size() - most) : "");
}

std::vector<std::string> notes_of(const Comparison& comparison) {
  const CompareOptions& options = comparison.options;
  std::vector<std::string> notes{
      fmt::format("Old: {}, {}. New: {}, {}.", comparison.before->run.id, comparison.before->run.git_commit,
                  comparison.after->run.id, comparison.after->run.git_commit),
      fmt::format("Slower and faster are times that differ by more than {} %{}, by rank sums at 2.5 % each "
                  "(Benjamini and "
                  "Hochberg over all times). Counts are compared exactly.",
                  significant(100 * options.tolerance),
                  options.relative_to.empty() ? "" : " relative to " + options.relative_to),
      listed("Other rays or objects under the same name, and so not compared", comparison.inputs_changed),
      listed("Only in the old report", comparison.only_before),
      listed("Only in the new report", comparison.only_after),
      repetitions_note(comparison),
      environment_note(comparison),
      drift_note(*comparison.before, "old"),
      drift_note(*comparison.after, "new")};
  std::erase(notes, "");
  return notes;
}

}  // namespace

std::string in_words(const Comparison& comparison) {
  const auto count = [&](const auto& is) {
    return static_cast<std::size_t>(std::count_if(comparison.cells.begin(), comparison.cells.end(), is));
  };
  const auto judged = [](Judgement judgement) {
    return [judgement](const ComparedCell& cell) {
      return cell.trace.judgement == judgement || cell.build.judgement == judgement;
    };
  };
  std::string text = fmt::format("Of {}: {} slower, {} faster, {} with another count",
                                 cells_in_words(comparison.cells.size()), count(judged(Judgement::slower)),
                                 count(judged(Judgement::faster)),
                                 count([](const ComparedCell& cell) { return !cell.counts.empty(); }));
  if (!comparison.inputs_changed.empty())
    text += fmt::format("; {} scenes or ray sets changed", comparison.inputs_changed.size());
  return text;
}

std::string render_compare(const Comparison& comparison, Format format, bool all_cells) {
  if (format == Format::csv) return render(cells_table(comparison, true), format);
  std::vector<Table> tables{{.title = in_words(comparison), .notes = notes_of(comparison)}};
  for (Table& table : std::vector{cells_table(comparison, all_cells), counts_table(comparison)})
    if (!table.rows.empty()) tables.push_back(std::move(table));
  if (!comparison.cells.empty()) tables.push_back(overall(comparison));
  return render(tables, format);
}

}  // namespace rayshoot::analysis
