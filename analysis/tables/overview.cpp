#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

#include "analysis/statistics/geometric_mean.h"
#include "analysis/tables/comparison.h"

namespace rayshoot::analysis {

namespace {

constexpr const char* kRule =
    "Geometric means over the cells of a technique that are right; what is missing is left out, not "
    "replaced. "
    "Techniques that have fewer cells stand below those that have more, with which their means do not "
    "compare.";

/// What a technique did in the groups in which it is right, and where it is not.
struct Summary {
  std::string label;
  std::vector<std::optional<double>> tests, times, times_zero_overhead, times_embree;
  std::size_t right = 0;

  void add(const Entry& entry) {
    using report::Status;
    const Status status = entry.measurement->verdict.status;
    if (status == Status::wrong || status == Status::failed) return;
    const auto value = [](const std::optional<Estimate>& e) {
      return e ? std::optional(e->value) : std::nullopt;
    };
    ++right;
    tests.push_back(per_ray(entry.measurement->work, &report::Work::object_tests));
    times.push_back(value(time_per_ray(entry)));
    times_zero_overhead.push_back(value(analysis::times_zero_overhead(entry)));
    times_embree.push_back(value(analysis::times_embree(entry)));
  }
};

std::vector<Summary> summaries(const std::vector<const Group*>& groups) {
  std::vector<Summary> result;
  for (const Group* group : groups)
    for (const Entry& entry : group->entries) {
      auto found = std::find_if(result.begin(), result.end(),
                                [&](const Summary& s) { return s.label == entry.label; });
      if (found == result.end()) found = result.insert(result.end(), {.label = entry.label});
      found->add(entry);
    }
  const auto mean = [](const auto& cells) {
    return geometric_mean(cells).value.value_or(std::numeric_limits<double>::infinity());
  };
  const auto key = [&](const Summary& summary) {
    return std::tuple(-static_cast<double>(summary.right), mean(summary.times), mean(summary.tests));
  };
  std::stable_sort(result.begin(), result.end(),
                   [&](const Summary& a, const Summary& b) { return key(a) < key(b); });
  return result;
}

Table overview(const std::vector<const Group*>& groups, bool several_reports) {
  const std::string run = several_reports ? fmt::format("[{}] ", groups[0]->report->run.id) : "";
  Table table{
      .title = fmt::format("{}All {} scenes and rays, {}", run, groups.size(), precision_of(*groups[0])),
      .columns = {technique_column(),
                  {"cells", "cells", "", "scenes and rays in which the technique is right", Style::whole},
                  {"object_tests_per_ray", "tests", "/ray", "ray-object tests, repeated ones included"},
                  time_column(),
                  zero_overhead_column(),
                  embree_column()},
      .notes = {kRule}};
  for (const Summary& summary : summaries(groups))
    table.rows.push_back({{std::nullopt, summary.label},
                          {static_cast<double>(summary.right), ""},
                          {geometric_mean(summary.tests).value, ""},
                          {geometric_mean(summary.times).value, ""},
                          {geometric_mean(summary.times_zero_overhead).value, ""},
                          {geometric_mean(summary.times_embree).value, ""}});
  return table;
}

}  // namespace

std::vector<Table> overview_tables(const std::vector<report::Report>& reports) {
  std::vector<Table> tables;
  for (const report::Report& report : reports) {
    const std::vector<Group> all = groups(report);
    std::map<std::pair<std::string, std::string>, std::vector<const Group*>> measured;
    for (const Group& group : all)
      if (!group.entries.empty()) measured[{group.scalar, group.intersector}].push_back(&group);
    for (const auto& [precision, of_precision] : measured)
      if (of_precision.size() > 1) tables.push_back(overview(of_precision, reports.size() > 1));
  }
  return tables;
}

}  // namespace rayshoot::analysis
