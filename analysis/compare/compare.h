#pragma once

#include <string>
#include <vector>

#include "analysis/statistics/sample.h"
#include "harness/report/report.h"

/// Two reports of the same cells, measured before and after a change.
namespace rayshoot::analysis {

struct CompareOptions {
  /// Times that grow by no more than this part are not slower. Two runs of one program on one idle machine were seen
  /// to differ by up to 5 %, in all techniques of a scene alike: more than the repetitions of one run tell.
  double tolerance = 0.05;
  /// The technique that times are divided by, in the same report, scene, rays and precision, before they are compared:
  /// it takes away what made all of a run slower. Empty for none.
  std::string relative_to;
};

enum class Judgement { not_judged, same, slower, faster };

/// New over old time, and what it says once it is one of many that were looked at.
struct TimeChange {
  std::optional<Estimate> ratio;
  Judgement judgement = Judgement::not_judged;
};

/// Numbers that should be the same; "absent" where one of them is not there.
struct CountChange {
  std::string name, before, after;
};

struct ComparedCell {
  /// Scene, rays and precision; of the numerical suite case, setting and precision.
  std::string group;
  std::string label;
  /// Null for answers of the numerical suite, which have no times.
  const report::Measurement *before = nullptr, *after = nullptr;
  /// Nanoseconds a ray; absent where a cell was not timed.
  std::optional<double> before_ns, after_ns;
  TimeChange trace, build;
  std::vector<CountChange> counts;
};

/// All pointers lead into the two reports, which must outlive it.
struct Comparison {
  const report::Report *before = nullptr, *after = nullptr;
  CompareOptions options;
  std::vector<ComparedCell> cells;
  /// Cells that only one of the reports has.
  std::vector<std::string> only_before, only_after;
  /// Scenes and ray sets of one name that are not the same: their cells are not compared.
  std::vector<std::string> inputs_changed;

  /// Whether a gate must stop the change: a cell is slower, a count or an input changed.
  bool failed() const;
};

/// Cells are the same that have one scene, ray set, technique, configuration, precision and intersector. Counts are
/// compared exactly, times by ranks (statistics/rank_sum.h). A cell is slower when its time grew by more than the
/// tolerance with a chance of error of 2.5 %, corrected for the whole table after Benjamini and Hochberg, and likewise
/// faster. So where nothing became slower a gate stops in one of forty comparisons, and where something did, what it names
/// is right but for a fortieth part. Then the cell's own 95 % interval excludes the tolerance too. Builds of less than 0.5 ms
/// are shown and not judged: whether they meet memory that was used before is as much. Throws ReportError when nothing can be compared, or when the
/// technique to compare relative to is missing.
Comparison compare(const report::Report& before, const report::Report& after, const CompareOptions& options);

}  // namespace rayshoot::analysis
