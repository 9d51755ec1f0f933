#include "analysis/tables/pivot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>

#include <algorithm>
#include <limits>
#include <set>

#include "analysis/statistics/geometric_mean.h"
#include "analysis/tables/comparison.h"

namespace rayshoot::analysis {

namespace {

constexpr const char* kMetric = "metric";
constexpr const char* kDefaultMetric = "trace_ns_per_ray";

/// Where a value stands: a name in every dimension, in the order of kDimensions.
using Coordinates = std::vector<std::string>;
/// Names in some of the dimensions.
using Key = std::vector<std::string>;

struct Value {
  Coordinates at;
  const ComparisonColumn* metric;
  analysis::Cell cell;
};

std::size_t place_of(const std::string& dimension) {
  return static_cast<std::size_t>(std::find(kDimensions.begin(), kDimensions.end(), dimension) -
                                  kDimensions.begin());
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

Key key_of(const Coordinates& at, const std::vector<std::string>& dimensions) {
  Key key;
  for (const std::string& dimension : dimensions) key.push_back(at[place_of(dimension)]);
  return key;
}

std::string rays_without_scene(const Group& group) {
  const std::string prefix = group.scene_id + "/";
  return group.rays_id.starts_with(prefix) ? group.rays_id.substr(prefix.size()) : group.rays_id;
}

/// The columns of the comparison that are asked for, in that order.
std::vector<const ComparisonColumn*> metrics_of(const PivotOptions& options) {
  std::vector<const ComparisonColumn*> metrics;
  const bool side_by_side = has(options.rows, kMetric) || has(options.columns, kMetric);
  const auto append = [&](const auto& wanted) {
    for (const ComparisonColumn& column : comparison_columns())
      if (column.column.style != Style::text && wanted(column.column)) metrics.push_back(&column);
  };
  for (const std::string& key : options.metrics)
    append([&](const Column& column) { return column.key == key; });
  if (!options.metrics.empty()) return metrics;
  append([&](const Column& column) {
    return side_by_side ? column.place != Place::csv : column.key == kDefaultMetric;
  });
  return metrics;
}

bool is_wanted(const Coordinates& at, const PivotOptions& options) {
  return std::all_of(options.only.begin(), options.only.end(), [&](const auto& only) {
    const auto& [dimension, patterns] = only;
    return patterns.empty() || std::any_of(patterns.begin(), patterns.end(), [&](const std::string& pattern) {
             return fnmatch(pattern.c_str(), at[place_of(dimension)].c_str(), 0) == 0;
           });
  });
}

/// All values that are asked for. Names that were passed over are kept in `others`, by dimension.
std::vector<Value> values_of(const std::vector<report::Report>& reports, const PivotOptions& options,
                             std::map<std::string, std::set<std::string>>& others) {
  std::vector<Value> values;
  const auto metrics = metrics_of(options);
  for (const report::Report& report : reports)
    for (const Group& group : groups(report))
      for (const Entry& entry : group.entries)
        for (const ComparisonColumn* metric : metrics) {
          Coordinates at{report.run.id,       group.scene_id, rays_without_scene(group),
                         precision_of(group), entry.label,    metric->column.key};
          if (is_wanted(at, options))
            values.push_back({std::move(at), metric, metric->cell(group, entry)});
          else
            for (const auto& [dimension, patterns] : options.only)
              if (!patterns.empty()) others[dimension].insert(at[place_of(dimension)]);
        }
  return values;
}

/// Keys in the order in which values first have them.
std::vector<Key> keys_of(const std::vector<const Value*>& values,
                         const std::vector<std::string>& dimensions) {
  std::vector<Key> keys;
  for (const Value* value : values)
    if (Key key = key_of(value->at, dimensions); std::find(keys.begin(), keys.end(), key) == keys.end())
      keys.push_back(std::move(key));
  return keys;
}

/// A metric as it is called in tables for readers.
std::string title_of_metric(const Column& column) { return column.title.empty() ? column.key : column.title; }

std::string title_of_key(const Key& key, const std::vector<std::string>& dimensions, const Value& of) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < key.size(); ++i)
    names.push_back(dimensions[i] == kMetric ? title_of_metric(of.metric->column) : key[i]);
  return fmt::format("{}", fmt::join(names, ", "));
}

/// One table: the values of a group.
class Pivot {
 public:
  Pivot(const PivotOptions& options, const std::vector<std::string>& group_dimensions,
        const std::vector<const Value*>& values)
      : options_(options), group_dimensions_(group_dimensions), values_(values) {}

  Table table() {
    rows_ = keys_of(values_, options_.rows);
    columns_ = keys_of(values_, options_.columns);
    put_names();
    put_values();
    if (options_.mean) put_means();
    return std::move(table_);
  }

 private:
  /// Columns that name rows, and, in CSV, the group.
  void put_names() {
    const Value& first = *values_.front();
    table_.title = title_of_key(key_of(first.at, group_dimensions_), group_dimensions_, first);
    if (table_.title.empty()) table_.title = "All";
    for (const std::string& dimension : options_.rows)
      table_.columns.push_back({dimension, dimension, "", "", Style::text});
    for (const std::string& dimension : group_dimensions_)
      table_.columns.push_back({dimension, dimension, "", "", Style::text, Place::csv});
    const Key group = key_of(first.at, group_dimensions_);
    for (const Key& row : rows_) {
      auto& cells = table_.rows.emplace_back();
      for (const auto* names : {&row, &group})
        for (const std::string& name : *names) cells.push_back({std::nullopt, name});
      cells.resize(cells.size() + columns_.size());
    }
    names_ = options_.rows.size() + group_dimensions_.size();
  }

  void put_values() {
    table_.columns.resize(names_ + columns_.size());
    std::set<std::pair<std::size_t, std::size_t>> taken;
    for (const Value* value : values_) {
      const std::size_t row = index(rows_, key_of(value->at, options_.rows)),
                        column = index(columns_, key_of(value->at, options_.columns));
      if (!taken.emplace(row, column).second)
        throw report::ReportError(
            fmt::format("two cells are called {}; give every report once", fmt::join(value->at, ", ")));
      put_column(table_.columns[names_ + column], *value);
      table_.rows[row][names_ + column] = value->cell;
    }
  }

  static std::size_t index(const std::vector<Key>& keys, const Key& key) {
    return static_cast<std::size_t>(std::find(keys.begin(), keys.end(), key) - keys.begin());
  }

  void put_column(Column& column, const Value& value) const {
    const Column& metric = value.metric->column;
    const Key key = key_of(value.at, options_.columns);
    column = {.key = fmt::format("{}", fmt::join(key, " ")),
              .title = title_of_key(key, options_.columns, value),
              .style = metric.style};
    // Metrics one below the other have no unit or meaning in common.
    if (has(options_.rows, kMetric)) return;
    column.unit = metric.unit;
    if (has(options_.columns, kMetric)) column.meaning = metric.meaning;
  }

  void put_means() {
    if (has(options_.columns, kMetric))
      throw report::ReportError("metrics have no mean: put scenes, rays or precisions in the columns");
    for (auto& row : table_.rows) {
      std::vector<std::optional<double>> cells;
      for (std::size_t i = names_; i < row.size(); ++i) cells.push_back(row[i].number);
      const GeometricMean mean = geometric_mean(cells);
      row.push_back({mean.missing == 0 ? mean.value : std::nullopt, ""});
    }
    table_.columns.push_back({"geometric_mean", "mean", "", "geometric mean; none where a cell is missing"});
    // The best first, rows without a mean last.
    const bool descending = values_.front()->metric->column.more_is_better && !has(options_.rows, kMetric);
    const auto rank = [&](const auto& row) {
      const auto& mean = row.back().number;
      return mean ? (descending ? -*mean : *mean) : std::numeric_limits<double>::infinity();
    };
    std::stable_sort(table_.rows.begin(), table_.rows.end(),
                     [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  }

  const PivotOptions& options_;
  const std::vector<std::string>& group_dimensions_;
  const std::vector<const Value*>& values_;
  std::vector<Key> rows_, columns_;
  std::size_t names_ = 0;
  Table table_;
};

/// Dimensions that are in neither rows nor columns.
std::vector<std::string> group_dimensions_of(const PivotOptions& options) {
  std::vector<std::string> rest;
  for (const std::string& dimension : kDimensions) {
    const auto uses = std::count(options.rows.begin(), options.rows.end(), dimension) +
                      std::count(options.columns.begin(), options.columns.end(), dimension);
    if (uses > 1) throw report::ReportError(fmt::format("'{}' can stand in one place only", dimension));
    if (uses == 0) rest.push_back(dimension);
  }
  return rest;
}

/// What would have matched, by dimension.
std::string nothing_matches(const std::map<std::string, std::set<std::string>>& names) {
  if (names.empty()) return "the reports have nothing to show";
  std::string message = "nothing matches";
  for (const auto& [dimension, known] : names)
    message += fmt::format("; {} is one of {}", dimension, fmt::join(known, ", "));
  return message;
}

}  // namespace

std::vector<std::string> metric_keys() {
  std::vector<std::string> keys;
  for (const ComparisonColumn& column : comparison_columns())
    if (column.column.style != Style::text) keys.push_back(column.column.key);
  return keys;
}

std::vector<Table> pivot_tables(const std::vector<report::Report>& reports, const PivotOptions& options) {
  std::vector<std::string> group_dimensions = group_dimensions_of(options);
  std::map<std::string, std::set<std::string>> others;
  const std::vector<Value> values = values_of(reports, options, others);
  if (values.empty()) throw report::ReportError(nothing_matches(others));
  // One run needs no name.
  if (reports.size() == 1) std::erase(group_dimensions, "run");
  std::vector<const Value*> all;
  for (const Value& value : values) all.push_back(&value);
  std::vector<Table> tables;
  for (const Key& group : keys_of(all, group_dimensions)) {
    std::vector<const Value*> members;
    for (const Value* value : all)
      if (key_of(value->at, group_dimensions) == group) members.push_back(value);
    tables.push_back(Pivot(options, group_dimensions, members).table());
  }
  return tables;
}

}  // namespace rayshoot::analysis
