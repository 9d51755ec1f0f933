#include "harness/torture/torture.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "harness/measure/building.h"
#include "harness/measure/environment.h"
#include "harness/measure/record.h"
#include "harness/torture/isolation.h"
#include "scenes/core/stiffness.h"

namespace rayshoot {

namespace {

std::vector<MadeCase> made_cases(const TortureRequest& request) {
  std::vector<std::string> known;
  for (const StiffCase* one : stiff_cases()) known.push_back(one->id);
  require_known("case", request.cases, known);
  std::vector<MadeCase> made;
  for (const StiffCase* one : stiff_cases())
    if (request.cases.empty() ||
        std::find(request.cases.begin(), request.cases.end(), one->id) != request.cases.end())
      made.push_back({one, one->settings(request.size, request.seed)});
  std::stable_sort(made.begin(), made.end(), [](const MadeCase& a, const MadeCase& b) {
    return a.stiff_case->number < b.stiff_case->number;
  });
  return made;
}

/// All techniques that search, Embree's robust form beside its default; or those that were asked for.
std::vector<TechniqueChoice> chosen_techniques(const TortureRequest& request) {
  std::vector<TechniqueChoice> chosen;
  for (const std::string& spec : request.techniques) {
    chosen.push_back(choose_technique(spec));
    if (chosen.back().entry->info.needs_recorded_hits)
      throw InputError(
          fmt::format("{} searches for nothing, so it cannot err", chosen.back().entry->info.id));
  }
  if (!chosen.empty()) return chosen;
  for (const TechniqueEntry* entry : catalogue())
    if (!entry->info.needs_recorded_hits) chosen.push_back(choose_technique(entry->info.id));
  chosen.push_back(choose_technique("embree(robust=on)"));
  return chosen;
}

report::Grading record(const TortureCell& cell, const Tally& tally) {
  const StiffSetting& setting = cell.of_setting();
  report::Grading grading{.torture_case = cell.stiff_case->id,
                          .setting = setting.label,
                          .property = kPropertyNames[static_cast<std::size_t>(setting.property)],
                          .technique = cell.technique->entry->info.id,
                          .config = config_of(cell.technique->arguments),
                          .scalar = cell.scalar,
                          .intersector = kIntersectorNames[static_cast<std::size_t>(cell.intersector)],
                          .flush_to_zero = cell.flush_to_zero,
                          .objects = tally.objects,
                          .set_aside = tally.set_aside,
                          .stiffness = stiffness(*setting.scene),
                          .parameter = setting.stiffness_parameter,
                          .rays = tally.rays,
                          .errors = record(tally.grades),
                          .leaks = tally.leaks,
                          .forbidden_hits = tally.forbidden_hits,
                          .changed = tally.changed,
                          .any_differs = tally.any_differs,
                          .threads_differ = tally.threads_differ,
                          .most_steps = tally.most_steps};
  if (cell.base()) grading.base = cell.base()->label;
  if (tally.crossed_rays > 0) grading.crossings_lost = tally.crossings_lost;
  if (tally.work.rays > 0) grading.work = record(tally.work, cell.technique->entry->info.events);
  if (tally.message[0] != 0) grading.message = tally.message.data();
  return grading;
}

}  // namespace

TorturePlan::TorturePlan(const TortureRequest& request) : request_(request) {
  require_known("scalar", request.scalars, {"float", "double"});
  require_known("intersector", request.intersectors, {kIntersectorNames.begin(), kIntersectorNames.end()});
  techniques_ = chosen_techniques(request);
  cases_ = made_cases(request);
  for (const MadeCase& made : cases_)
    for (std::size_t setting = 0; setting < made.settings.size(); ++setting)
      for (const std::string& scalar : request.scalars) add_cells(made, setting, scalar);
}

void TorturePlan::add_cells(const MadeCase& made, std::size_t setting, const std::string& scalar) {
  const std::uint64_t wanted =
      made.settings[setting].default_rays * static_cast<std::uint64_t>(request_.size);
  const std::uint64_t rays = request_.rays > 0 ? request_.rays : wanted;
  for (const TechniqueChoice& technique : techniques_)
    for (const std::string& intersector : request_.intersectors) {
      const TechniqueEntry& entry = *technique.entry;
      const bool again = entry.info.own_object_test && intersector != request_.intersectors.front();
      if (again || !(scalar == "float" ? entry.supports<float>() : entry.supports<double>())) continue;
      cells_.push_back(
          {.stiff_case = made.stiff_case,
           .settings = &made.settings,
           .setting = setting,
           .technique = &technique,
           .scalar = scalar,
           .intersector = entry.info.own_object_test ? Intersector::fast : intersector_named(intersector),
           .flush_to_zero = request_.flush_to_zero,
           .seed = request_.seed,
           .rays = rays,
           .graded_rays = std::min(rays, request_.graded_rays)});
    }
}

report::Report torture(const TorturePlan& plan, int processes, report::Run run, RunObserver& observer,
                       const std::function<bool()>& stopped) {
  report::Report report{.run = std::move(run), .environment = environment()};
  std::map<const TortureCell*, report::Grading> gradings;
  IsolatedCells isolated(processes, [&](const TortureCell& cell, const Tally& tally) {
    gradings.emplace(&cell, record(cell, tally));
    observer.finished(1);
  });
  report.run.seconds = seconds_of([&] {
    for (const TortureCell& cell : plan.cells()) {
      if (stopped()) break;
      observer.doing(
          fmt::format("{} {} {}", cell.stiff_case->id, cell.of_setting().label, cell.technique->spec));
      isolated.start(cell);
    }
    isolated.finish();
  });
  for (const TortureCell& cell : plan.cells())
    if (const auto found = gradings.find(&cell); found != gradings.end())
      report.gradings.push_back(found->second);
  report.run.complete = !stopped();
  return report;
}

bool faulty(const report::Grading& grading) {
  return report::wrong_answers(grading.errors) > 0 || grading.leaks > 0 || grading.forbidden_hits > 0 ||
         grading.changed > 0 || grading.any_differs > 0 || grading.threads_differ > 0 ||
         grading.crossings_lost.value_or(0) > 0;
}

}  // namespace rayshoot
