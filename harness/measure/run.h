#pragma once

#include <functional>

#include "harness/plan/plan.h"
#include "harness/report/report.h"

namespace rayshoot {

/// Is told how a run gets on.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  /// What is being done now, for example "balls:3 whitted@65 float: timing".
  virtual void doing(const std::string& step) = 0;
  /// So many more cells of the plan are done or left out.
  virtual void finished(std::size_t cells) = 0;
  /// All cells of a scene are done, and the report holds them.
  virtual void scene_done(const report::Report&) {}
};

/// Run all cells of a plan: verify, then count, then time. Cells with wrong answers get no counts and no
/// times. When `stopped` returns true the step in hand is finished and the report holds the cells that were
/// complete. `run` is the report's first part, apart from its duration.
report::Report run(const Plan& plan, report::Run run, RunObserver& observer,
                   const std::function<bool()>& stopped);

}  // namespace rayshoot
