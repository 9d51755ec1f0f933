#include "analysis/plots/series.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "analysis/plots/plots.h"
#include "analysis/statistics/geometric_mean.h"
#include "analysis/tables/comparison.h"

namespace rayshoot::analysis {

namespace {
constexpr const char* kExhaustive = "exhaustive";
}

namespace {
std::set<std::string> labels_of(const std::vector<Group>& groups) {
  std::set<std::string> labels;
  for (const Group& group : groups)
    for (const Entry& entry : group.entries) labels.insert(entry.label);
  return labels;
}
}  // namespace

SeriesStyles::SeriesStyles(const std::vector<Group>& groups) : SeriesStyles(labels_of(groups)) {}

SeriesStyles::SeriesStyles(const std::set<std::string>& labels) {
  for (const std::string& label : labels) styles_.emplace(label, MarkerStyle(styles_.size()));
}

std::vector<std::pair<std::string, MarkerStyle>> SeriesStyles::legend(
    const std::vector<std::string>& labels) const {
  std::vector<std::pair<std::string, MarkerStyle>> lines;
  for (const auto& [label, style] : styles_)
    if (std::find(labels.begin(), labels.end(), label) != labels.end()) lines.emplace_back(label, style);
  return lines;
}

bool is_right(const Entry& entry) {
  const report::Status status = entry.measurement->verdict.status;
  return status == report::Status::ok || status == report::Status::graded;
}

std::optional<double> trace_ns_per_ray(const Entry& entry) {
  const auto time = time_per_ray(entry);
  return time ? std::optional(time->value) : std::nullopt;
}

std::optional<double> build_milliseconds(const Entry& entry) {
  const std::string& technique = entry.measurement->technique;
  const auto time = median(entry.measurement->build_ns);
  if (technique == kZeroOverhead || technique == kExhaustive) return std::nullopt;
  return time ? std::optional(time->value / 1e6) : std::nullopt;
}

std::optional<double> structure_bytes(const Entry& entry) {
  const auto& structure = entry.measurement->structure;
  if (!structure || structure->bytes == 0) return std::nullopt;
  return static_cast<double>(structure->bytes);
}

std::vector<Precision> precisions(const std::vector<Group>& groups) {
  std::vector<Precision> result;
  for (const Group& group : groups) {
    if (group.entries.empty()) continue;
    const std::string name = precision_of(group);
    auto found =
        std::find_if(result.begin(), result.end(), [&](const Precision& p) { return p.name == name; });
    if (found == result.end()) found = result.insert(result.end(), {name, {}});
    found->groups.push_back(&group);
  }
  return result;
}

std::vector<MeanRow> mean_rows(const std::vector<const Group*>& groups,
                               const std::vector<Quantity>& quantities, std::vector<std::string>& left_out) {
  std::map<std::string, std::vector<std::vector<std::optional<double>>>> cells;
  for (const Group* group : groups)
    for (const Entry& entry : group->entries) {
      auto& columns = cells[entry.label];
      columns.resize(quantities.size());
      if (!is_right(entry) || !quantities[0](entry)) continue;
      for (std::size_t i = 0; i < quantities.size(); ++i) columns[i].push_back(quantities[i](entry));
    }
  std::vector<MeanRow> rows;
  for (const auto& [label, columns] : cells) {
    if (columns[0].size() < groups.size()) {
      left_out.push_back(label);
      continue;
    }
    auto& row = rows.emplace_back(MeanRow{label, columns[0].size(), {}});
    for (const auto& column : columns) row.means.push_back(geometric_mean(column).value);
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const MeanRow& a, const MeanRow& b) { return a.means[0] < b.means[0]; });
  return rows;
}

std::string title_of_groups(const Precision& precision) {
  if (precision.groups.size() == 1) return title_of(*precision.groups[0], false);
  return fmt::format("{} scenes and rays, {}", precision.groups.size(), precision.name);
}

std::string file_name_of(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_';
    if (plain)
      name += c;
    else if (!name.empty() && name.back() != '-')
      name += '-';
  }
  while (!name.empty() && name.back() == '-') name.pop_back();
  return name.substr(0, 100);
}

std::vector<PlotSet> all_plots(const std::vector<Group>& groups, const std::vector<report::Report>& reports,
                               const Validation& models) {
  return {predicted_measured_plots(groups),
          model_time_plots(groups, models),
          error_time_plots(groups),
          work_bars_plots(groups),
          build_trace_plots(groups),
          object_scaling_plots(groups),
          thread_scaling_plots(groups),
          stiffness_work_plots(groups, reports),
          work_map_plots(groups)};
}

}  // namespace rayshoot::analysis
