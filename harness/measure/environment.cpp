#include "harness/measure/environment.h"

#include <benchmark/benchmark.h>
#include <fmt/chrono.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <memory>
#include <thread>

#include "harness/baseline/baselines.h"

namespace rayshoot {

namespace {

std::string first_line(const std::string& path) {
  std::string line;
  std::getline(std::ifstream(path) >> std::ws, line);
  return line;
}

/// The value of the first line `key<separator>value` of a file, without quotes and leading spaces.
std::string value_of(const std::string& path, const std::string& key, char separator) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(key)) continue;
    std::string value = line.substr(line.find(separator) + 1);
    std::erase(value, '"');
    return value.substr(std::min(value.find_first_not_of(" \t"), value.size()));
  }
  return {};
}

/// What a command prints, without the last line's end; empty when it fails.
std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen((command + " 2>/dev/null").c_str(), "r"), pclose);
  std::string text;
  std::array<char, 256> part;
  while (pipe && std::fgets(part.data(), part.size(), pipe.get())) text += part.data();
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

std::string operating_system() {
  utsname kernel{};
  uname(&kernel);
  return fmt::format("{}, {} {}", value_of("/etc/os-release", "PRETTY_NAME", '='), kernel.sysname,
                     kernel.release);
}

/// "l1d", "l1i", "l2", "l3" and their sizes.
std::map<std::string, std::uint64_t> caches() {
  std::map<std::string, std::uint64_t> sizes;
  for (const auto& cache : benchmark::CPUInfo::Get().caches) {
    const char* suffix = cache.type == "Data" ? "d" : cache.type == "Instruction" ? "i" : "";
    sizes[fmt::format("l{}{}", cache.level, suffix)] = static_cast<std::uint64_t>(cache.size);
  }
  return sizes;
}

std::string governor() {
  const std::string name = first_line("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
  return name.empty() ? "unavailable" : name;
}

std::string git(const std::string& arguments) {
  return output_of("git -C '" RAYSHOOT_SOURCE "' " + arguments);
}

}  // namespace

report::Environment environment() {
  std::array<double, 1> load{};
  getloadavg(load.data(), 1);
  return {.cpu = value_of("/proc/cpuinfo", "model name", ':'),
          .cores = static_cast<int>(std::thread::hardware_concurrency()),
          .caches_bytes = caches(),
          .governor = governor(),
          .load = load[0],
          .os = operating_system(),
          .compiler = RAYSHOOT_COMPILER,
          .flags = RAYSHOOT_FLAGS,
          .packages = {{"embree", embree_version()},
                       {"embree_assertions", embree_has_assertions() ? "on" : "off"},
                       {"benchmark", RAYSHOOT_BENCHMARK},
                       {"tbb", RAYSHOOT_TBB}}};
}

report::Run started_run(const std::string& command, std::uint64_t seed) {
  const auto now = std::chrono::system_clock::now();
  const auto milliseconds =
      std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch()).count() % 1000;
  const std::tm utc = fmt::gmtime(std::chrono::system_clock::to_time_t(now));
  return {.id = fmt::format("{:%Y%m%dT%H%M%S}.{:03}Z-{}", utc, milliseconds, getpid()),
          .command = command,
          .started_utc = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", utc),
          .git_commit = git("rev-parse HEAD"),
          .git_dirty = !git("status --porcelain").empty(),
          .seed = seed};
}

}  // namespace rayshoot
