#pragma once

#include <optional>
#include <string>

#include "harness/measure/run.h"

/// Runs that go on where they were killed.
namespace rayshoot::cli {

/// The file beside a report that holds, while a run is under way, the scenes that are done.
std::string unfinished_path(const std::string& output);

/// What an earlier run of the same command left behind, scenes that were done from beginning to end: beside the report
/// when it was killed, in the report when it was interrupted. Nothing when there is no such thing. Throws ReportError when
/// it is of another command, commit, seed or machine.
std::optional<report::Report> earlier_part(const std::string& output, const report::Run& run);

/// Leaves to a plan the scenes that an earlier part does not have.
void skip_done(Plan& plan, const report::Report& done);

/// An earlier part, if any, and what came after it.
report::Report continued(const std::optional<report::Report>& earlier, const report::Report& report);

/// Passes everything on to another observer, and writes down the scenes that are done. What it wrote is removed at its end:
/// only a run that is killed leaves it.
class Checkpoints final : public RunObserver {
 public:
  /// Nothing is written without the name of a report: a run that nobody can name cannot be gone on with.
  Checkpoints(RunObserver& next, const std::string& output, const std::optional<report::Report>& earlier);
  ~Checkpoints() override;
  Checkpoints(const Checkpoints&) = delete;

  void doing(const std::string& step) override { next_.doing(step); }
  void finished(std::size_t cells) override { next_.finished(cells); }
  void scene_done(const report::Report& so_far) override;

 private:
  RunObserver& next_;
  std::string path_;
  const std::optional<report::Report>& earlier_;
};

}  // namespace rayshoot::cli
