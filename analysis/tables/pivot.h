#pragma once

#include <map>
#include <string>
#include <vector>

#include "analysis/tables/table.h"
#include "harness/report/report.h"

/// Tables of a reader's own choice: which metrics, what stands in rows and what in columns.
namespace rayshoot::analysis {

/// What a number of a report belongs to. Rays are named without their scene, precision is scalar and intersector.
inline const std::vector<std::string> kDimensions{"run", "scene", "rays", "precision", "technique", "metric"};

/// Keys of the columns of the comparison that are numbers, or stand for one.
std::vector<std::string> metric_keys();

struct PivotOptions {
  /// Keys; when empty, the time a ray, or, where metrics stand in rows or columns, those of the comparison for readers.
  std::vector<std::string> metrics;
  /// Dimensions. For what is in neither there is a table for each value that it has.
  std::vector<std::string> rows{"technique"}, columns{"metric"};
  /// Patterns with * and ? by dimension: only what matches one of them is shown.
  std::map<std::string, std::vector<std::string>> only;
  /// Add geometric means over the columns, of rows that have a value in all of them, and sort by them, the best first.
  bool mean = false;
};

/// Throws ReportError when a dimension is given twice, when nothing matches, when two cells would stand in one place, or
/// when a mean is asked for over columns that are metrics.
std::vector<Table> pivot_tables(const std::vector<report::Report>& reports, const PivotOptions& options);

}  // namespace rayshoot::analysis
