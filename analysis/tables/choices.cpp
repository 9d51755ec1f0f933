#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "analysis/statistics/geometric_mean.h"
#include "analysis/tables/comparison.h"
#include "analysis/tables/page.h"
#include "analysis/tables/regret.h"

namespace rayshoot::analysis {

namespace {

/// A choice that costs at most this many times the least is a good one.
constexpr double kGoodRegret = 1.3;

std::string rays_of(const report::Choice& choice) {
  return choice.rays.starts_with(choice.scene + "/") ? choice.rays.substr(choice.scene.size() + 1)
                                                     : choice.rays;
}

std::string precision_of(const report::Choice& choice) {
  return choice.intersector == "fast" ? choice.scalar
                                      : fmt::format("{}, {}", choice.scalar, choice.intersector);
}

/// "Left out A, B: why", those of one reason together.
std::vector<std::string> left_out_notes(const report::Choice& choice) {
  std::vector<std::pair<std::string, std::vector<std::string>>> reasons;
  for (const auto& [what, why] : choice.left_out) {
    auto found = std::find_if(reasons.begin(), reasons.end(),
                              [&, &reason = why](const auto& r) { return r.first == reason; });
    if (found == reasons.end()) found = reasons.insert(reasons.end(), {why, {}});
    found->second.push_back(what);
  }
  std::vector<std::string> notes;
  for (const auto& [why, what] : reasons)
    notes.push_back(fmt::format("Left out {}: {}", fmt::join(what, ", "), why));
  return notes;
}

std::string looks(const report::Choice& choice) {
  std::vector<std::string> figures;
  for (const auto& [name, value] : choice.statistics)
    figures.push_back(
        fmt::format("{} {}", name, name == "objects" ? fmt::format("{:.0f}", value) : significant(value)));
  return fmt::format("The scene at a glance: {}. Counted on {} rays, constants of {}; choosing took {} s.",
                     fmt::join(figures, ", "), choice.sample_rays, choice.constants,
                     significant(choice.seconds));
}

std::string verdict(const JudgedChoice& judged) {
  const report::Choice& choice = *judged.choice;
  std::string text = fmt::format("Chosen: {}. {}.", choice.pick, choice.why);
  if (const auto regret = judged.regret(choice.pick))
    text += fmt::format(" Measured, it costs {} times the least, which is that of {}.", significant(*regret),
                        judged.best());
  return text;
}

/// Nothing where builds do not count.
std::optional<double> expected_cost(const report::Choice& choice, const report::Candidate& candidate) {
  if (!choice.expected_rays || !candidate.predicted_ns_per_ray) return std::nullopt;
  return *candidate.predicted_ns_per_ray + candidate.build_ns / *choice.expected_rays;
}

Table weighing(const JudgedChoice& judged, bool several_reports) {
  const report::Choice& choice = *judged.choice;
  const std::string run = several_reports ? fmt::format("[{}] ", judged.report->run.id) : "";
  const std::string builds =
      choice.expected_rays ? fmt::format("; builds serve {} rays", significant(*choice.expected_rays)) : "";
  Table table{
      .title = fmt::format("{}{}, {}, {}: what to choose{}", run, choice.scene, rays_of(choice),
                           precision_of(choice), builds),
      .columns = {
          {"candidate", "candidate", "", "", Style::text},
          {"expected_ns_per_ray", "expected", "ns/ray", "counts on a sample times fitted constants"},
          {"race_ns_per_ray", "race", "ns/ray", "median of short times in turns, of near ties"},
          {"expected_cost_ns_per_ray", "with build", "ns/ray", "expected, and its share of the build"},
          {"measured_ns_per_ray", "measured", "ns/ray", "in this run, with the build where builds count"},
          {"built_in_ms", "built in", "ms", "once, while choosing"}}};
  for (const report::Candidate& candidate : choice.candidates) {
    const auto race = median(candidate.race_ns_per_ray);
    table.rows.push_back({words(candidate.spec),
                          {candidate.predicted_ns_per_ray, ""},
                          {race ? std::optional(race->value) : std::nullopt, ""},
                          {expected_cost(choice, candidate), ""},
                          {judged.cost(candidate.spec), ""},
                          {candidate.build_ns / 1e6, ""}});
  }
  table.notes = left_out_notes(choice);
  table.notes.insert(table.notes.begin(), looks(choice));
  table.notes.push_back(verdict(judged));
  return table;
}

/// How many choices are good, and what they cost on average.
std::string account(const std::vector<JudgedChoice>& choices, const std::string& which,
                    bool (*of)(const report::Choice&), const std::string report::Choice::*spec) {
  std::vector<std::optional<double>> regrets;
  for (const JudgedChoice& judged : choices)
    if (const auto regret = judged.regret(judged.choice->*spec); regret && of(*judged.choice))
      regrets.push_back(regret);
  if (regrets.empty()) return {};
  const auto good =
      std::count_if(regrets.begin(), regrets.end(), [](const auto& r) { return *r <= kGoodRegret; });
  return fmt::format("{}: {} of {} within {:g} times the least; geometric mean {}, worst {}.", which, good,
                     regrets.size(), kGoodRegret, significant(*geometric_mean(regrets).value),
                     significant(**std::max_element(regrets.begin(), regrets.end())));
}

std::vector<std::string> accounts(const std::vector<JudgedChoice>& choices) {
  using report::Choice;
  const auto all = [](const Choice&) { return true; };
  std::vector<std::string> notes{
      account(choices, "Chosen", all, &Choice::pick),
      account(
          choices, "Chosen, scenes that constants were fitted on", [](const Choice& c) { return c.fitted; },
          &Choice::pick),
      account(
          choices, "Chosen, other scenes", [](const Choice& c) { return !c.fitted; }, &Choice::pick),
      account(choices, "By prediction alone", all, &Choice::predicted),
      account(
          choices, "By prediction alone, other scenes", [](const Choice& c) { return !c.fitted; },
          &Choice::predicted)};
  if (const auto fixed = best_fixed_choice(choices))
    notes.push_back(fmt::format("The best fixed choice would have been {}, whose geometric mean is {}.",
                                fixed->spec, significant(fixed->mean_regret)));
  std::erase(notes, "");
  return notes;
}

Table regrets(const std::vector<JudgedChoice>& choices) {
  Table table{.title = "What choices cost",
              .columns = {{"scene", "scene", "", "", Style::text},
                          {"rays", "rays", "", "", Style::text},
                          {"fitted", "fitted", "", "whether constants were fitted on the scene", Style::text},
                          {"weighed", "weighed", "", "candidates that were not left out", Style::whole},
                          {"measured", "measured", "", "techniques that were measured, left out ones too",
                           Style::whole},
                          {"pick", "chosen", "", "", Style::text},
                          {"regret", "regret", "", "cost of the choice over the least that was measured"},
                          {"predicted", "by prediction", "", "", Style::text},
                          {"predicted_regret", "its regret", "", "of the choice without a race"},
                          {"best", "fastest", "", "", Style::text}}};
  for (const JudgedChoice& judged : choices) {
    const report::Choice& choice = *judged.choice;
    if (!judged.regret(choice.pick)) continue;
    table.rows.push_back({words(choice.scene), words(rays_of(choice)), words(choice.fitted ? "yes" : "no"),
                          Cell{static_cast<double>(choice.candidates.size()), ""},
                          Cell{static_cast<double>(judged.costs.size()), ""}, words(choice.pick),
                          Cell{judged.regret(choice.pick), ""}, words(choice.predicted),
                          Cell{judged.regret(choice.predicted), ""}, words(judged.best())});
  }
  table.notes = accounts(choices);
  return table;
}

}  // namespace

std::vector<Table> choice_tables(const std::vector<report::Report>& reports) {
  const std::vector<JudgedChoice> choices = judged_choices(reports);
  std::vector<Table> tables;
  for (const JudgedChoice& judged : choices) tables.push_back(weighing(judged, reports.size() > 1));
  if (Table table = regrets(choices); table.rows.size() > 1) tables.push_back(std::move(table));
  return tables;
}

std::string render_regret(const std::vector<report::Report>& reports, Format format) {
  const Table table = regrets(judged_choices(reports));
  return table.rows.empty() ? "" : render(table, format);
}

}  // namespace rayshoot::analysis
