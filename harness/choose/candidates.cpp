#include "harness/choose/candidates.h"

#include <fmt/format.h>

#include <algorithm>

#include "accel/algebra/expression.h"

namespace rayshoot {

namespace {

std::vector<std::string> known_candidates(const Constants& constants) {
  std::vector<std::string> specs;
  for (const TechniqueEntry* entry : catalogue())
    if (!entry->info.baseline) specs.push_back(entry->info.id);
  for (const auto& [technique, known] : constants.techniques)
    if (is_composition(technique)) specs.push_back(technique);
  return specs;
}

void add(std::vector<TechniqueChoice>& techniques, const std::string& spec) {
  const auto same = [&](const TechniqueChoice& other) { return other.spec == spec; };
  if (std::any_of(techniques.begin(), techniques.end(), same)) return;
  techniques.push_back(choose_technique(spec));
  if (techniques.back().entry->info.baseline)
    throw InputError(fmt::format("'{}' is a point of comparison, not a technique to choose", spec));
}

}  // namespace

Candidates candidates_of(const std::vector<std::string>& specs, const Constants& constants) {
  Candidates candidates{.named = !specs.empty()};
  for (const std::string& spec : specs.empty() ? std::vector<std::string>{kAllCandidates} : specs) {
    if (spec != kAllCandidates)
      add(candidates.techniques, spec);
    else
      for (const std::string& known : known_candidates(constants)) add(candidates.techniques, known);
  }
  return candidates;
}

}  // namespace rayshoot
