#include "analysis/html/provenance.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "analysis/tables/page.h"
#include "analysis/tables/wall_time.h"

namespace rayshoot::analysis {

namespace {

using report::Report;

template <class Value>
std::string listed(const std::map<std::string, Value>& map) {
  std::vector<std::string> parts;
  parts.reserve(map.size());
  for (const auto& [name, value] : map) parts.push_back(fmt::format("{} {}", name, value));
  return fmt::format("{}", fmt::join(parts, ", "));
}

struct Fact {
  const char* name;
  std::function<std::string(const Report&)> text;
};

std::vector<Fact> facts() {
  return {
      {"command", [](const Report& r) { return r.run.command; }},
      {"started (UTC)", [](const Report& r) { return r.run.started_utc; }},
      {"seconds", [](const Report& r) { return significant(r.run.seconds); }},
      {"spent on", [](const Report& r) { return wall_time(r.run); }},
      {"commit",
       [](const Report& r) { return r.run.git_commit + (r.run.git_dirty ? ", with changes" : ""); }},
      {"seed", [](const Report& r) { return fmt::format("{}", r.run.seed); }},
      {"bounds", [](const Report& r) { return r.run.bounds; }},
      {"complete", [](const Report& r) { return r.run.complete ? "yes" : "no, interrupted"; }},
      {"processor",
       [](const Report& r) { return fmt::format("{}, {} cores", r.environment.cpu, r.environment.cores); }},
      {"caches, bytes", [](const Report& r) { return listed(r.environment.caches_bytes); }},
      {"governor", [](const Report& r) { return r.environment.governor; }},
      {"load at the start",
       [](const Report& r) { return r.environment.load ? significant(*r.environment.load) : "unknown"; }},
      {"operating system", [](const Report& r) { return r.environment.os; }},
      {"compiler", [](const Report& r) { return r.environment.compiler; }},
      {"flags", [](const Report& r) { return r.environment.flags; }},
      {"libraries", [](const Report& r) { return listed(r.environment.packages); }}};
}

/// Names, at most ten of them.
std::string some_of(const std::set<std::string>& names) {
  constexpr std::size_t most = 10;
  std::vector<std::string> shown(
      names.begin(), std::next(names.begin(), static_cast<std::ptrdiff_t>(std::min(most, names.size()))));
  if (names.size() > most) shown.push_back(fmt::format("and {} more", names.size() - most));
  return fmt::format("{}", fmt::join(shown, ", "));
}

/// What was left out for one reason.
struct Reason {
  std::set<std::string> what, where;
};

}  // namespace

Table provenance_table(const std::vector<Report>& reports) {
  Table table{.title = "Where the numbers come from", .columns = {{"fact", "", "", "", Style::text}}};
  for (const Report& report : reports)
    table.columns.push_back({report.run.id, report.run.id, "", "", Style::text});
  for (const Fact& fact : facts()) {
    auto& row = table.rows.emplace_back(1, words(fact.name));
    for (const Report& report : reports) row.push_back(words(fact.text(report)));
  }
  return table;
}

Table inputs_table(const std::vector<Report>& reports) {
  Table table{.title = "What was traced",
              .columns = {{"rays", "rays", "", "", Style::text},
                          {"objects", "objects", "", "", Style::whole},
                          {"kinds", "kinds", "", "", Style::text},
                          {"ray_count", "rays", "number", "", Style::whole},
                          {"primary", "primary", "rays", "", Style::whole},
                          {"shadow", "shadow", "rays", "", Style::whole},
                          {"reflected", "reflected", "rays", "", Style::whole},
                          {"refracted", "refracted", "rays", "", Style::whole},
                          {"scene_hash", "scene", "hash", "", Style::text},
                          {"hash", "rays", "hash", "", Style::text}}};
  for (const Report& report : reports)
    for (const report::RaySet& rays : report.ray_sets)
      for (const report::Scene& scene : report.scenes) {
        if (scene.id != rays.scene) continue;
        std::map<std::string, std::uint64_t> kinds = scene.counts;
        std::erase_if(kinds, [](const auto& kind) { return kind.second == 0; });
        table.rows.push_back({words(rays.id), whole(scene.objects), words(listed(kinds)), whole(rays.rays),
                              whole(rays.primary_rays), whole(rays.shadow_rays), whole(rays.reflected_rays),
                              whole(rays.refracted_rays), words(scene.hash), words(rays.hash)});
      }
  return table;
}

Table left_out_table(const std::vector<Report>& reports, const std::vector<PlotSet>& plots) {
  std::map<std::string, Reason> reasons;
  for (const Report& report : reports) {
    for (const report::LeftOutCell& cell : report.left_out) {
      reasons[cell.why].what.insert(cell.technique);
      reasons[cell.why].where.insert(cell.rays);
    }
    for (const report::Scene& scene : report.scenes) {
      for (const report::LeftOut& line : scene.left_out) {
        reasons[line.why].what.insert(line.what);
        reasons[line.why].where.insert(scene.id);
      }
      for (const auto& [reason, count] : scene.set_aside)
        reasons[reason].what.insert(fmt::format("{} objects", count)), reasons[reason].where.insert(scene.id);
    }
  }
  for (const PlotSet& set : plots)
    if (!set.left_out.empty()) reasons[set.left_out].what.insert("plot: " + set.kind);
  Table table{.title = "What was left out",
              .columns = {{"what", "what", "", "", Style::text},
                          {"where", "where", "", "", Style::text},
                          {"why", "why", "", "", Style::text}}};
  for (const auto& [why, reason] : reasons)
    table.rows.push_back({words(some_of(reason.what)), words(some_of(reason.where)), words(why)});
  return table;
}

}  // namespace rayshoot::analysis
