#include "analysis/compare/compare.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "analysis/compare/exact_counts.h"
#include "analysis/statistics/multiple.h"
#include "analysis/statistics/rank_sum.h"
#include "analysis/tables/comparison.h"
#include "analysis/tables/labels.h"

namespace rayshoot::analysis {

namespace {

using report::Grading;
using report::Measurement;
using report::Report;

constexpr double kLeastBuildNs = 5e5;

std::string group_title(const Measurement& cell) {
  return title_of(
      {.scene_id = cell.scene, .rays_id = cell.rays, .scalar = cell.scalar, .intersector = cell.intersector},
      false);
}

bool same_group(const Measurement& a, const Measurement& b) {
  return a.scene == b.scene && a.rays == b.rays && a.scalar == b.scalar && a.intersector == b.intersector;
}

bool same_cell(const Measurement& a, const Measurement& b) {
  return same_group(a, b) && a.technique == b.technique && a.config == b.config;
}

bool same_cell(const Grading& a, const Grading& b) {
  const auto key = [](const Grading& g) {
    return std::tie(g.torture_case, g.setting, g.technique, g.config, g.scalar, g.intersector,
                    g.flush_to_zero);
  };
  return key(a) == key(b);
}

std::string group_title(const Grading& cell) {
  return fmt::format("{}, {}, {}{}", cell.torture_case, cell.setting,
                     precision_of({.scalar = cell.scalar, .intersector = cell.intersector}),
                     cell.flush_to_zero ? ", flushed" : "");
}

template <class OfCell>
const OfCell* counterpart(const std::vector<OfCell>& cells, const OfCell& cell) {
  const auto found =
      std::find_if(cells.begin(), cells.end(), [&](const OfCell& other) { return same_cell(cell, other); });
  return found == cells.end() ? nullptr : &*found;
}

/// Names in both lists whose hashes differ.
template <class Listed>
std::vector<std::string> changed(const std::vector<Listed>& before, const std::vector<Listed>& after) {
  std::vector<std::string> names;
  for (const Listed& one : before)
    for (const Listed& other : after)
      if (one.id == other.id && one.hash != other.hash) names.push_back(one.id);
  return names;
}

using Counts = std::map<std::string, std::string>;

std::vector<CountChange> changed_counts(const Counts& old_counts, const Counts& new_counts) {
  const auto text = [](const auto& counts, const std::string& name) {
    const auto found = counts.find(name);
    return found == counts.end() ? std::string("absent") : found->second;
  };
  // What was not measured of an answer that is wrong or failed is no further change.
  const std::string status = "verdict.status";
  if (text(old_counts, status) != text(new_counts, status))
    return {{status, text(old_counts, status), text(new_counts, status)}};
  std::set<std::string> names;
  for (const auto* counts : {&old_counts, &new_counts})
    for (const auto& [name, count] : *counts) names.insert(name);
  std::vector<CountChange> changes;
  for (const std::string& name : names)
    if (text(old_counts, name) != text(new_counts, name))
      changes.push_back({name, text(old_counts, name), text(new_counts, name)});
  return changes;
}

std::vector<double> divided(std::vector<double> values, double divisor) {
  for (double& value : values) value /= divisor;
  return values;
}

/// Times, over the median of those of the technique to compare relative to.
std::vector<double> relative(const Report& report, const Measurement& cell, const std::vector<double>& times,
                             const std::string& technique) {
  if (technique.empty() || times.empty()) return times;
  std::set<std::string> timed;
  for (const Measurement& other : report.measurements) {
    if (!same_group(cell, other) || other.trace_ns.empty()) continue;
    if (other.technique == technique) return divided(times, median(other.trace_ns)->value);
    timed.insert(other.technique);
  }
  throw report::ReportError(fmt::format("no time of '{}' in {} of the report {}; timed there: {}", technique,
                                        group_title(cell), report.run.id, fmt::join(timed, ", ")));
}

/// Two samples of times and the change they may show.
struct Judged {
  TimeChange* change;
  std::vector<double> before, after;
};

/// Give all times a judgement whose chances, corrected for the whole table, are small: half of the error each way.
template <class Chance>
void judge(const std::vector<Judged>& all, Judgement judgement, const Chance& chance) {
  std::vector<double> chances(all.size());
  std::transform(all.begin(), all.end(), chances.begin(), chance);
  const std::vector<double> adjusted = benjamini_hochberg(chances);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (adjusted[i] <= (1 - kConfidence) / 2) all[i].change->judgement = judgement;
}

/// Judge all times of a table together.
void judge(const std::vector<Judged>& all, double tolerance) {
  for (const Judged& judged : all) judged.change->judgement = Judgement::same;
  judge(all, Judgement::slower,
        [&](const Judged& judged) { return chance_of_ranks(judged.after, judged.before, 1 + tolerance); });
  judge(all, Judgement::faster,
        [&](const Judged& judged) { return chance_of_ranks(judged.before, judged.after, 1 + tolerance); });
}

std::optional<double> ns_per_ray(const Report& report, const Measurement& cell) {
  const auto time = median(cell.trace_ns);
  for (const report::RaySet& rays : report.ray_sets)
    if (rays.id == cell.rays && rays.rays > 0 && time) return time->value / static_cast<double>(rays.rays);
  return std::nullopt;
}

class Comparer {
 public:
  explicit Comparer(Comparison& comparison) : comparison_(comparison) {}

  void compare_all() {
    const auto &before = *comparison_.before, &after = *comparison_.after;
    comparison_.inputs_changed = changed(before.scenes, after.scenes);
    for (std::string& rays : changed(before.ray_sets, after.ray_sets))
      comparison_.inputs_changed.push_back(std::move(rays));
    for (const Report* report : {&before, &after}) {
      for (const Measurement& cell : report->measurements) labels_.add(cell.technique, cell.config);
      for (const Grading& cell : report->gradings) labels_.add(cell.technique, cell.config);
    }
    compare_lists(before.measurements, after.measurements);
    compare_lists(before.gradings, after.gradings);
    take_times();
  }

 private:
  template <class OfCell>
  void compare_lists(const std::vector<OfCell>& before, const std::vector<OfCell>& after) {
    for (const OfCell& cell : before)
      if (const OfCell* other = counterpart(after, cell))
        pair(cell, *other);
      else
        comparison_.only_before.push_back(name(cell));
    for (const OfCell& cell : after)
      if (!counterpart(before, cell)) comparison_.only_after.push_back(name(cell));
  }

  template <class OfCell>
  std::string name(const OfCell& cell) const {
    return fmt::format("{} ({})", labels_(cell.technique, cell.config), group_title(cell));
  }

  void pair(const Measurement& before, const Measurement& after) {
    const auto& names = comparison_.inputs_changed;
    const auto is_changed = [&](const std::string& id) {
      return std::find(names.begin(), names.end(), id) != names.end();
    };
    if (is_changed(before.scene) || is_changed(before.rays)) return;
    comparison_.cells.push_back({.group = group_title(before),
                                 .label = labels_(before.technique, before.config),
                                 .before = &before,
                                 .after = &after,
                                 .before_ns = ns_per_ray(*comparison_.before, before),
                                 .after_ns = ns_per_ray(*comparison_.after, after),
                                 .counts = changed_counts(exact_counts(before), exact_counts(after))});
  }

  void pair(const Grading& before, const Grading& after) {
    comparison_.cells.push_back({.group = group_title(before),
                                 .label = labels_(before.technique, before.config),
                                 .counts = changed_counts(exact_counts(before), exact_counts(after))});
  }

  void take_times() {
    std::vector<Judged> judged;
    for (ComparedCell& cell : comparison_.cells) {
      if (!cell.before) continue;
      if (cell.before->trace_threads == cell.after->trace_threads)
        take(cell, cell.trace, &Measurement::trace_ns, 0, judged);
      take(cell, cell.build, &Measurement::build_ns, kLeastBuildNs, judged);
    }
    judge(judged, comparison_.options.tolerance);
  }

  void take(const ComparedCell& cell, TimeChange& change, std::vector<double> Measurement::*times,
            double least, std::vector<Judged>& judged) const {
    const std::string& unit = comparison_.options.relative_to;
    Judged one{&change, relative(*comparison_.before, *cell.before, (*cell.before).*times, unit),
               relative(*comparison_.after, *cell.after, (*cell.after).*times, unit)};
    change.ratio = independent_ratio(one.after, one.before);
    if (change.ratio && median((*cell.before).*times)->value >= least) judged.push_back(std::move(one));
  }

  Comparison& comparison_;
  Labels labels_;
};

}  // namespace

bool Comparison::failed() const {
  return !inputs_changed.empty() || std::any_of(cells.begin(), cells.end(), [](const ComparedCell& cell) {
    return !cell.counts.empty() || cell.trace.judgement == Judgement::slower ||
           cell.build.judgement == Judgement::slower;
  });
}

Comparison compare(const Report& before, const Report& after, const CompareOptions& options) {
  Comparison comparison{.before = &before, .after = &after, .options = options};
  Comparer(comparison).compare_all();
  if (comparison.cells.empty() && comparison.inputs_changed.empty())
    throw report::ReportError(
        fmt::format("the reports {} and {} have no cell in common", before.run.id, after.run.id));
  return comparison;
}

}  // namespace rayshoot::analysis
