#include "analysis/compare/exact_counts.h"

#include <fmt/format.h>

#include <type_traits>

#include "analysis/tables/groups.h"
#include "harness/report/members.h"

namespace rayshoot::analysis {

namespace {

using ConfigMap = std::map<std::string, report::ConfigValue>;

/// Goes through the members of an object of a report and keeps its numbers; words and configurations are what it is, not
/// what was counted.
class NumberCollector {
 public:
  NumberCollector(std::string path, std::map<std::string, std::string>& numbers)
      : path_(std::move(path)), numbers_(numbers) {}

  template <class T>
  void required(const std::string& name, const T& value) {
    const std::string path = fmt::format("{}.{}", path_, name);
    if constexpr (std::is_same_v<T, std::string>) {
      return;
    } else if constexpr (std::is_arithmetic_v<T>) {
      numbers_[path] = fmt::format("{}", value);
    } else {
      NumberCollector below(path, numbers_);
      members(value, below);
    }
  }
  void required(const std::string&, const ConfigMap&) {}
  template <class T>
  void required(const std::string& name, const std::map<std::string, T>& values) {
    NumberCollector below(fmt::format("{}.{}", path_, name), numbers_);
    for (const auto& [key, value] : values) below.required(key, value);
  }
  template <class Names>
  void choice(const char*, const std::string&, const Names&) {}
  template <class Names>
  void optional_choice(const char*, const std::string&, const Names&) {}
  template <class T>
  void optional(const std::string& name, const std::optional<T>& value) {
    if (value) required(name, *value);
  }
  template <class T>
  void optional(const std::string& name, const std::map<std::string, T>& values) {
    required(name, values);
  }

 private:
  std::string path_;
  std::map<std::string, std::string>& numbers_;
};

template <class Part>
void collect(const char* name, const std::optional<Part>& part, std::map<std::string, std::string>& numbers) {
  if (!part) return;
  NumberCollector collector(name, numbers);
  members(*part, collector);
}

}  // namespace

std::map<std::string, std::string> exact_counts(const report::Measurement& measurement) {
  const report::Verdict& verdict = measurement.verdict;
  std::map<std::string, std::string> numbers{
      {"verdict.status", report::kStatusNames[static_cast<std::size_t>(verdict.status)]},
      {"verdict.checked_rays", fmt::format("{}", verdict.checked_rays)},
      {"verdict.wrong_rays", fmt::format("{}", verdict.wrong_rays)}};
  collect("work", measurement.work, numbers);
  collect("strict_work", measurement.strict_work, numbers);
  collect("structure", measurement.structure, numbers);
  // Embree builds with many threads, and gives each of them memory.
  if (measurement.technique.starts_with(kEmbree)) numbers.erase("structure.bytes");
  collect("errors", measurement.errors, numbers);
  return numbers;
}

std::map<std::string, std::string> exact_counts(const report::Grading& grading) {
  std::map<std::string, std::string> numbers;
  collect("grading", std::optional(grading), numbers);
  return numbers;
}

}  // namespace rayshoot::analysis
