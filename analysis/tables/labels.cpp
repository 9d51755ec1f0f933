#include "analysis/tables/labels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace rayshoot::analysis {

namespace {

std::string text(const report::ConfigValue& value) {
  if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "on" : "off";
  return std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
}

/// The entries of a configuration whose keys are wanted, each as "key=value".
template <class Wanted>
std::vector<std::string> assignments(const Config& config, const Wanted& wanted) {
  std::vector<std::string> texts;
  for (const auto& [key, value] : config)
    if (wanted(key)) texts.push_back(fmt::format("{}={}", key, text(value)));
  return texts;
}

}  // namespace

std::string config_text(const Config& config) {
  return fmt::format("{}", fmt::join(assignments(config, [](const std::string&) { return true; }), ";"));
}

void Labels::add(const std::string& technique, const Config& config) {
  Uses& uses = uses_[technique];
  ++uses.count;
  for (const auto& [key, value] : config) uses.values[key].insert(text(value)), ++uses.present[key];
}

bool Labels::Uses::differs(const std::string& key) const {
  return values.at(key).size() > 1 || present.at(key) < count;
}

std::string Labels::operator()(const std::string& technique, const Config& config) const {
  const Uses& uses = uses_.at(technique);
  const auto texts = assignments(config, [&](const std::string& key) { return uses.differs(key); });
  if (texts.empty()) return technique;
  return fmt::format("{}({})", technique, fmt::join(texts, ", "));
}

}  // namespace rayshoot::analysis
