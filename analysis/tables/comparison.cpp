#include "analysis/tables/comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "analysis/tables/grading.h"
#include "analysis/tables/page.h"
#include "analysis/work_precision/work_precision.h"

namespace rayshoot::analysis {

namespace {

using report::Measurement;
using report::Status;

/// "12 of 3000 checked rays (0.4 %)".
std::string wrong_rays(const report::Verdict& verdict) {
  const double checked = static_cast<double>(std::max<std::uint64_t>(verdict.checked_rays, 1));
  return fmt::format("{} of {} checked rays ({} %)", verdict.wrong_rays, verdict.checked_rays,
                     significant(100 * static_cast<double>(verdict.wrong_rays) / checked));
}

/// What the reader of a row must know; empty where there is nothing.
std::string verdict_note(const Entry& entry) {
  const report::Verdict& verdict = entry.measurement->verdict;
  switch (verdict.status) {
    case Status::ok:
      return {};
    case Status::wrong:
      return fmt::format("WRONG {}: {} differ from {}.", entry.label, wrong_rays(verdict), verdict.reference);
    case Status::failed:
      return fmt::format("FAILED {}: {}", entry.label, verdict.message.value_or("no reason given"));
    case Status::graded:
      break;
  }
  return fmt::format("* {} has an object test of its own: {} differ from {}.", entry.label,
                     wrong_rays(verdict), verdict.reference);
}

/// Who was compared with, where there was a choice.
std::string baseline_note(const Group& group, const std::string& technique, const Measurement* baseline) {
  std::size_t all = 0, alike = 0;
  std::string chosen;
  for (const auto& [measurement, label, rays, zero_overhead, embree] : group.entries) {
    if (measurement->technique != technique || measurement->trace_ns.empty()) continue;
    ++all, alike += traces_ray_by_ray(*measurement) == traces_ray_by_ray(*baseline);
    if (measurement == baseline) chosen = label;
  }
  if (all < 2) return {};
  return fmt::format("Compared with {}, the fastest of {}.", chosen,
                     alike < all ? "those that trace ray by ray" : fmt::format("{}", all));
}

/// Cells that were not run, those with one reason together.
std::vector<std::string> left_out_notes(const Group& group) {
  std::vector<std::pair<std::string, std::vector<std::string>>> reasons;
  for (const report::LeftOutCell* cell : group.left_out) {
    auto reason =
        std::find_if(reasons.begin(), reasons.end(), [&](const auto& r) { return r.first == cell->why; });
    if (reason == reasons.end()) reason = reasons.insert(reasons.end(), {cell->why, {}});
    reason->second.push_back(cell->technique);
  }
  std::vector<std::string> notes;
  for (const auto& [why, techniques] : reasons) {
    const bool all = group.entries.empty() && reasons.size() == 1;
    notes.push_back(all ? fmt::format("Left out: {}", why)
                        : fmt::format("Left out {}: {}", fmt::join(techniques, ", "), why));
  }
  return notes;
}

std::vector<std::string> notes_of(const Group& group) {
  std::vector<std::string> notes;
  for (const Entry& entry : group.entries) notes.push_back(verdict_note(entry));
  if (!group.entries.empty()) {
    notes.push_back(baseline_note(group, kZeroOverhead, group.entries[0].zero_overhead));
    notes.push_back(baseline_note(group, kEmbree, group.entries[0].embree));
  }
  for (const std::string& note : left_out_notes(group)) notes.push_back(note);
  std::erase(notes, "");
  return notes;
}

/// Size of the task, and with how many threads it was timed where those were several.
std::string task_of(const Group& group) {
  std::string task;
  if (group.scene) task += fmt::format("; {} objects", group.scene->objects);
  if (group.scene && group.scene->stiffness)
    task += fmt::format(", stiffness {}", significant(*group.scene->stiffness));
  if (group.rays) task += fmt::format("; {} rays", group.rays->rays);
  const int threads = group.entries.empty() ? 1 : group.entries[0].measurement->trace_threads;
  if (threads > 1) task += fmt::format("; {} threads", threads);
  return task;
}

/// What concerns a whole run.
std::vector<std::string> notes_of(const report::Report& report, const std::vector<Group>& measured) {
  std::vector<std::string> notes;
  const bool beside_embree = std::any_of(measured.begin(), measured.end(), [](const Group& group) {
    return !group.entries.empty() && group.entries[0].embree;
  });
  const auto& packages = report.environment.packages;
  if (const auto found = packages.find("embree_assertions");
      beside_embree && found != packages.end() && found->second == "on")
    notes.emplace_back(
        "Embree was built with assertions, as Debian does: a release build is up to 4 % faster.");
  if (!report.run.complete) notes.emplace_back("The run was interrupted: cells after this one are missing.");
  return notes;
}

Table table_of(const Group& group, bool several_reports) {
  Table table{.title = title_of(group, several_reports) + task_of(group), .notes = notes_of(group)};
  for (const ComparisonColumn& column : comparison_columns()) table.columns.push_back(column.column);
  for (const Entry& entry : group.entries) {
    auto& row = table.rows.emplace_back();
    for (const ComparisonColumn& column : comparison_columns()) row.push_back(column.cell(group, entry));
  }
  return table;
}

}  // namespace

std::string precision_of(const Group& group) {
  return group.intersector == "fast" ? group.scalar : fmt::format("{}, {}", group.scalar, group.intersector);
}

std::string title_of(const Group& group, bool several_reports) {
  const std::string prefix = group.scene_id + "/";
  const std::string rays =
      group.rays_id.starts_with(prefix) ? group.rays_id.substr(prefix.size()) : group.rays_id;
  const std::string run = several_reports ? fmt::format("[{}] ", group.report->run.id) : "";
  return fmt::format("{}{}, {}, {}", run, group.scene_id, rays, precision_of(group));
}

std::vector<Table> comparison_tables(const std::vector<report::Report>& reports) {
  std::vector<Table> tables;
  for (const report::Report& report : reports) {
    const std::vector<Group> measured = groups(report);
    for (const Group& group : measured) tables.push_back(table_of(group, reports.size() > 1));
    if (measured.empty()) continue;
    for (const std::string& note : notes_of(report, measured)) tables.back().notes.push_back(note);
  }
  return tables;
}

std::string render_comparison(const std::vector<report::Report>& reports, Format format) {
  std::vector<Table> tables = comparison_tables(reports);
  const auto append = [&](std::vector<Table> more) {
    std::move(more.begin(), more.end(), std::back_inserter(tables));
  };
  if (format != Format::csv) {
    append(scaling_tables(reports));
    append(growth_tables(reports));
    append(overview_tables(reports));
    append(work_precision_tables(reports));
  }
  append(published_tables(reports));
  append(grading_tables(reports, format == Format::csv));
  append(choice_tables(reports));
  return render(tables, format);
}

}  // namespace rayshoot::analysis
