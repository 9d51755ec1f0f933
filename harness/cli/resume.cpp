#include "harness/cli/resume.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "harness/measure/environment.h"
#include "harness/report/join.h"

namespace rayshoot::cli {

namespace {

constexpr const char* kResume = " --resume";

/// A command without the option that does not change what is measured.
std::string without_resume(std::string command) {
  if (const std::size_t at = command.find(kResume); at != std::string::npos)
    command.erase(at, std::char_traits<char>::length(kResume));
  return command;
}

void remove_scene(report::Report& report, const std::string& id) {
  const auto is_of_scene = [&](const auto& part) { return part.scene == id; };
  std::erase_if(report.scenes, [&](const report::Scene& scene) { return scene.id == id; });
  std::erase_if(report.ray_sets, is_of_scene);
  std::erase_if(report.measurements, is_of_scene);
  std::erase_if(report.left_out, is_of_scene);
  std::erase_if(report.claims, is_of_scene);
}

std::optional<report::Report> read_if_there(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return std::nullopt;
  return report::read_report(path);
}

}  // namespace

std::string unfinished_path(const std::string& output) { return output + ".unfinished"; }

std::optional<report::Report> earlier_part(const std::string& output, const report::Run& run) {
  auto done = read_if_there(unfinished_path(output));
  if (!done) {
    done = read_if_there(output);
    // The last scene of a run that was interrupted may have been in hand.
    if (done && !done->run.complete && !done->scenes.empty())
      remove_scene(*done, std::string(done->scenes.back().id));
  }
  if (!done) return std::nullopt;
  if (without_resume(done->run.command) != without_resume(run.command))
    throw report::ReportError(
        fmt::format("{} was begun by another command: {}", output, without_resume(done->run.command)));
  done->run.complete = true;
  // Joining finds out whether the machine and the program are the same; the bounds are, with the command.
  report::Report now{.run = run, .environment = environment()};
  now.run.bounds = done->run.bounds;
  report::joined({*done, now});
  return done;
}

void skip_done(Plan& plan, const report::Report& done) {
  std::erase_if(plan.suite.scenes, [&](const std::string& id) {
    return std::any_of(done.scenes.begin(), done.scenes.end(),
                       [&](const report::Scene& scene) { return scene.id == id; });
  });
}

report::Report continued(const std::optional<report::Report>& earlier, const report::Report& report) {
  return earlier ? report::joined({*earlier, report}) : report;
}

Checkpoints::Checkpoints(RunObserver& next, const std::string& output,
                         const std::optional<report::Report>& earlier)
    : next_(next), path_(output.empty() ? "" : unfinished_path(output)), earlier_(earlier) {}

Checkpoints::~Checkpoints() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove(path_, ignored);
}

void Checkpoints::scene_done(const report::Report& so_far) {
  if (path_.empty()) return;
  report::Report all = continued(earlier_, so_far);
  all.run.complete = false;
  report::write_report(all, path_);
}

}  // namespace rayshoot::cli
