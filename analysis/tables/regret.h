#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/report/report.h"

/// What choices cost beside what could have been chosen.
namespace rayshoot::analysis {

/// A choice and what was measured of it. Pointers lead into the report, which must outlive it.
struct JudgedChoice {
  const report::Report* report = nullptr;
  const report::Choice* choice = nullptr;
  /// Nanoseconds a ray of everything that was measured for these rays and that could be chosen, by specification or, for
  /// what was no candidate, by its label; with its share of the build where the choice counts builds. Baselines are left out.
  std::map<std::string, double> costs;

  std::optional<double> cost(const std::string& spec) const;
  /// What has the least cost; empty where nothing was measured.
  std::string best() const;
  /// Cost over the least cost. Nothing unless all candidates were measured.
  std::optional<double> regret(const std::string& spec) const;
};

/// The choices of all reports, in their order.
std::vector<JudgedChoice> judged_choices(const std::vector<report::Report>& reports);

/// A technique that could always be chosen, and the geometric mean of its regret.
struct FixedChoice {
  std::string spec;
  double mean_regret = 0;
};

/// The fixed choice with the least mean regret, of those that were measured wherever there is a regret; nothing where
/// none was.
std::optional<FixedChoice> best_fixed_choice(const std::vector<JudgedChoice>& choices);

}  // namespace rayshoot::analysis
