#include "harness/report/join.h"

#include <fmt/format.h>

#include <set>

namespace rayshoot::report {

namespace {

void require_alike(const Report& first, const Report& other) {
  const auto require = [&](bool alike, const char* what) {
    if (!alike)
      throw ReportError(fmt::format("runs {} and {} differ in their {}", first.run.id, other.run.id, what));
  };
  require(first.environment.cpu == other.environment.cpu, "machine");
  require(first.environment.flags == other.environment.flags, "compiler's flags");
  require(first.run.git_commit == other.run.git_commit, "commit");
  require(first.run.seed == other.run.seed, "seed");
  require(first.run.bounds == other.run.bounds, "bounds");
}

template <class Element>
void append(std::vector<Element>& to, const std::vector<Element>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

Report joined(const std::vector<Report>& reports) {
  if (reports.empty()) throw ReportError("there is nothing to join");
  Report whole{.run = reports[0].run, .environment = reports[0].environment};
  whole.run.seconds = 0;
  whole.run.phase_seconds.clear();
  std::set<std::string> scenes;
  for (const Report& part : reports) {
    require_alike(reports[0], part);
    for (const Scene& scene : part.scenes)
      if (!scenes.insert(scene.id).second)
        throw ReportError(fmt::format("two runs have the scene {}", scene.id));
    whole.run.seconds += part.run.seconds;
    for (const auto& [phase, seconds] : part.run.phase_seconds) whole.run.phase_seconds[phase] += seconds;
    whole.run.complete &= part.run.complete;
    whole.run.git_dirty |= part.run.git_dirty;
    append(whole.scenes, part.scenes);
    append(whole.ray_sets, part.ray_sets);
    append(whole.measurements, part.measurements);
    append(whole.left_out, part.left_out);
    append(whole.claims, part.claims);
    append(whole.gradings, part.gradings);
    append(whole.choices, part.choices);
  }
  return whole;
}

}  // namespace rayshoot::report
