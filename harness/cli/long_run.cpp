#include "harness/cli/long_run.h"

#include <fmt/format.h>

#include <csignal>
#include <filesystem>

#include "harness/cli/writable.h"
#include "scenes/core/spec.h"

namespace rayshoot::cli {

namespace {

volatile std::sig_atomic_t interrupts = 0;

void interrupt(int signal) {
  interrupts = interrupts + 1;
  std::signal(signal, SIG_DFL);
}

std::filesystem::path default_path(const std::string& run_id) {
  const std::filesystem::path project = RAYSHOOT_SOURCE;
  const auto folder =
      (std::filesystem::exists(project) ? project : std::filesystem::current_path()) / "results" / "local";
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed)
    throw InputError(fmt::format("{}: {}; say where to write with -o", folder.string(), failed.message()));
  return folder / (run_id + ".json");
}

}  // namespace

void stop_on_interrupt() { std::signal(SIGINT, interrupt); }

bool interrupted() { return interrupts > 0; }

std::string report_path(const std::string& given, const std::string& run_id) {
  const std::string path = given.empty() ? default_path(run_id).string() : given;
  require_writable(path);
  return path;
}

}  // namespace rayshoot::cli
