#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "analysis/tables/comparison.h"

namespace rayshoot::analysis {

namespace {

std::set<int> thread_counts(const Group& group) {
  std::set<int> counts;
  for (const Entry& entry : group.entries)
    for (const report::ThreadTimes& times : entry.measurement->threads) counts.insert(times.threads);
  return counts;
}

/// How many times faster a number of threads is than the threads of the main measurement.
Cell speed_up(const report::Measurement& measurement, int threads) {
  const auto found = std::find_if(measurement.threads.begin(), measurement.threads.end(),
                                  [&](const report::ThreadTimes& times) { return times.threads == threads; });
  if (found == measurement.threads.end()) return {};
  const auto estimate = ratio(measurement.trace_ns, found->trace_ns);
  return {estimate ? std::optional(estimate->value) : std::nullopt, ""};
}

Table scaling_table(const Group& group, const std::set<int>& counts, bool several_reports) {
  const int threads = group.entries[0].measurement->trace_threads;
  Table table{.title = fmt::format("{}: times faster with more threads than with {}",
                                   title_of(group, several_reports), threads),
              .columns = {technique_column()}};
  for (const int count : counts)
    table.columns.push_back(
        {fmt::format("speed_up_{}_threads", count), fmt::format("{}", count), "threads", ""});
  for (const Entry& entry : group.entries) {
    if (entry.measurement->threads.empty()) continue;
    auto& row = table.rows.emplace_back(1, Cell{std::nullopt, entry.label});
    for (const int count : counts) row.push_back(speed_up(*entry.measurement, count));
  }
  return table;
}

}  // namespace

std::vector<Table> scaling_tables(const std::vector<report::Report>& reports) {
  std::vector<Table> tables;
  for (const report::Report& report : reports)
    for (const Group& group : groups(report))
      if (const std::set<int> counts = thread_counts(group); !counts.empty())
        tables.push_back(scaling_table(group, counts, reports.size() > 1));
  return tables;
}

}  // namespace rayshoot::analysis
