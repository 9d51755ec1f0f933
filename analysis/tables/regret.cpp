#include "analysis/tables/regret.h"

#include <algorithm>

#include "analysis/statistics/geometric_mean.h"
#include "analysis/tables/groups.h"
#include "analysis/tables/labels.h"

namespace rayshoot::analysis {

namespace {

bool is_baseline(const std::string& technique) {
  return technique == kZeroOverhead || technique.starts_with(kEmbree);
}

/// What a measured technique is called: as the candidate that it is, or by its label, which must be no candidate's name.
std::string name_of(const report::Choice& choice, const Entry& entry) {
  const report::Measurement& measurement = *entry.measurement;
  bool taken = false;
  for (const report::Candidate& candidate : choice.candidates) {
    if (candidate.technique == measurement.technique && candidate.config == measurement.config)
      return candidate.spec;
    taken |= candidate.spec == entry.label;
  }
  return taken ? entry.label + " " + config_text(measurement.config) : entry.label;
}

void add_costs(JudgedChoice& judged, const Group& group) {
  for (const Entry& entry : group.entries) {
    const auto time = time_per_ray(entry);
    if (!time || is_baseline(entry.measurement->technique)) continue;
    double cost = time->value;
    if (const auto build = median(entry.measurement->build_ns); build && judged.choice->expected_rays)
      cost += build->value / *judged.choice->expected_rays;
    judged.costs.emplace(name_of(*judged.choice, entry), cost);
  }
}

}  // namespace

std::optional<double> JudgedChoice::cost(const std::string& spec) const {
  const auto found = costs.find(spec);
  return found == costs.end() ? std::nullopt : std::optional(found->second);
}

std::string JudgedChoice::best() const {
  const auto least = std::min_element(costs.begin(), costs.end(),
                                      [](const auto& a, const auto& b) { return a.second < b.second; });
  return least == costs.end() ? "" : least->first;
}

std::optional<double> JudgedChoice::regret(const std::string& spec) const {
  const auto measured = [this](const report::Candidate& candidate) { return costs.contains(candidate.spec); };
  if (!costs.contains(spec) || !std::all_of(choice->candidates.begin(), choice->candidates.end(), measured))
    return std::nullopt;
  return costs.at(spec) / costs.at(best());
}

std::vector<JudgedChoice> judged_choices(const std::vector<report::Report>& reports) {
  std::vector<JudgedChoice> choices;
  for (const report::Report& report : reports) {
    const std::vector<Group> measured = groups(report);
    for (const report::Choice& choice : report.choices) {
      JudgedChoice& judged = choices.emplace_back(JudgedChoice{&report, &choice});
      for (const Group& group : measured)
        if (group.scene_id == choice.scene && group.rays_id == choice.rays && group.scalar == choice.scalar &&
            group.intersector == choice.intersector)
          add_costs(judged, group);
    }
  }
  return choices;
}

std::optional<FixedChoice> best_fixed_choice(const std::vector<JudgedChoice>& choices) {
  std::map<std::string, std::vector<std::optional<double>>> regrets;
  std::size_t cells = 0;
  for (const JudgedChoice& judged : choices) {
    if (!judged.regret(judged.choice->pick)) continue;
    ++cells;
    for (const auto& [spec, cost] : judged.costs) regrets[spec].push_back(judged.regret(spec));
  }
  std::optional<FixedChoice> best;
  for (const auto& [spec, of_spec] : regrets) {
    const auto mean = geometric_mean(of_spec).value;
    if (of_spec.size() == cells && mean && (!best || *mean < best->mean_regret)) best = {spec, *mean};
  }
  return best;
}

}  // namespace rayshoot::analysis
