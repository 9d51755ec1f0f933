#pragma once

#include <deque>

#include "harness/measure/run.h"
#include "harness/torture/cell.h"

namespace rayshoot {

/// What `rayshoot torture` is asked to do. Empty lists stand for everything.
struct TortureRequest {
  std::vector<std::string> cases, techniques, scalars{"float"}, intersectors{"fast", "watertight"};
  /// Trace with denormal numbers taken as zero.
  bool flush_to_zero = false;
  /// 1 is the short form; more has more settings, larger scenes and as many times the rays.
  int size = 1;
  /// Rays of every setting in place of what the case asks for; 0 for that.
  std::uint64_t rays = 0;
  /// Rays of a setting that the exact oracle grades.
  std::uint64_t graded_rays = 5000;
  std::uint64_t seed = 1;
};

/// A case with its settings made.
struct MadeCase {
  const StiffCase* stiff_case;
  std::vector<StiffSetting> settings;
};

/// A request, understood, with all its scenes made.
class TorturePlan {
 public:
  /// Throws InputError on names that are not known.
  explicit TorturePlan(const TortureRequest& request);
  TorturePlan(const TorturePlan&) = delete;

  /// Every technique on every setting, in the order of the cases.
  const std::deque<TortureCell>& cells() const { return cells_; }

 private:
  void add_cells(const MadeCase& made, std::size_t setting, const std::string& scalar);

  TortureRequest request_;
  std::vector<TechniqueChoice> techniques_;
  std::vector<MadeCase> cases_;
  std::deque<TortureCell> cells_;
};

/// Run all cells, so many processes at once, and return a report of their gradings. When `stopped` returns true no
/// further cell is begun. The caller must have no other threads.
report::Report torture(const TorturePlan& plan, int processes, report::Run run, RunObserver& observer,
                       const std::function<bool()>& stopped);

/// Whether a grading shows anything that must not be: leaks, wrong answers, changed answers, crashes.
bool faulty(const report::Grading& grading);

}  // namespace rayshoot
