#include "harness/plan/catalogue.h"

#include <fmt/format.h>

#include "accel/algebra/expression.h"
#include "accel/core/registry.h"
#include "harness/baseline/baselines.h"

namespace rayshoot {

namespace {

const TechniqueEntry& find_technique(const std::string& id) {
  std::vector<std::string> known;
  for (const TechniqueEntry* entry : catalogue()) {
    if (entry->info.id == id) return *entry;
    known.push_back(entry->info.id);
  }
  throw InputError(unknown_name("technique", id, known));
}

}  // namespace

const std::vector<const TechniqueEntry*>& catalogue() {
  static const std::vector<const TechniqueEntry*> entries = [] {
    const auto techniques = technique_entries(), baselines = baseline_entries();
    std::vector<const TechniqueEntry*> all(techniques.begin(), techniques.end());
    all.insert(all.end(), baselines.begin(), baselines.end());
    return all;
  }();
  return entries;
}

namespace {

/// Throws InputError where arguments contradict one another, before anything runs: an empty scene shows it as well.
void require_consistent(const TechniqueEntry& entry, const Arguments& arguments) {
  if (entry.info.needs_recorded_hits) return;
  static const Geometry<float> nothing{Scene{}};
  entry.build<float>({nothing, arguments});
}

}  // namespace

TechniqueChoice choose_technique(std::string_view text) {
  if (is_composition(text)) {
    const Expression expression = parse_expression(text, catalogue());
    const auto composed = std::make_shared<const TechniqueEntry>(compose(expression));
    return {composed.get(), configuration(expression), std::string(text), {}, composed};
  }
  const Spec spec = parse_spec(text);
  const TechniqueEntry& entry = find_technique(spec.name);
  if (!spec.size.empty() || !spec.form.empty())
    throw InputError(
        fmt::format("technique '{}': write {} or {}(key=value,...)", text, spec.name, spec.name));
  const Arguments arguments(entry.info.parameters, spec.arguments, spec.name);
  require_consistent(entry, arguments);
  return {&entry, arguments, std::string(text), {}};
}

}  // namespace rayshoot
