#include "harness/cli/long_run.h"

#include <fmt/format.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <csignal>
#include <filesystem>
#include <limits>

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

void keep_freed_memory() {
#ifdef __GLIBC__
  // Larger pieces always come from the system and go back: this is the most that the library takes as a threshold.
  constexpr int most_on_heap = 32 << 20;
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_MMAP_THRESHOLD, most_on_heap);
#endif
}

std::string report_path(const std::string& given, const std::string& run_id) {
  const std::string path = given.empty() ? default_path(run_id).string() : given;
  require_writable(path);
  return path;
}

}  // namespace rayshoot::cli
