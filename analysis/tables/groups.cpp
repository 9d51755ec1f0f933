#include "analysis/tables/groups.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "analysis/tables/labels.h"

namespace rayshoot::analysis {

namespace {

using report::Measurement;
using report::Status;

template <class Listed>
const Listed* find(const std::vector<Listed>& list, const std::string& id) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const Listed& one) { return one.id == id; });
  return found == list.end() ? nullptr : &*found;
}

/// The group of a measurement or of a left out cell, which is new at first.
template <class Of>
Group& group_of(std::vector<Group>& groups, const report::Report& report, const Of& cell) {
  const auto found = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
    return std::tie(group.scene_id, group.rays_id, group.scalar, group.intersector) ==
           std::tie(cell.scene, cell.rays, cell.scalar, cell.intersector);
  });
  if (found != groups.end()) return *found;
  return groups.emplace_back(Group{.report = &report,
                                   .scene_id = cell.scene,
                                   .rays_id = cell.rays,
                                   .scalar = cell.scalar,
                                   .intersector = cell.intersector,
                                   .scene = find(report.scenes, cell.scene),
                                   .rays = find(report.ray_sets, cell.rays)});
}

const Measurement* fastest(const std::vector<Entry>& entries, const std::string& technique) {
  const auto cost = [](const Measurement& measurement) {
    return std::pair(!traces_ray_by_ray(measurement), median(measurement.trace_ns)->value);
  };
  const Measurement* best = nullptr;
  for (const Entry& entry : entries) {
    const Measurement* const measurement = entry.measurement;
    if (measurement->technique != technique || measurement->trace_ns.empty()) continue;
    if (!best || cost(*measurement) < cost(*best)) best = measurement;
  }
  return best;
}

void sort(std::vector<Entry>& entries) {
  const auto key = [](const Entry& entry) {
    constexpr double none = std::numeric_limits<double>::infinity();
    const Status status = entry.measurement->verdict.status;
    const auto time = time_per_ray(entry);
    return std::tuple(status == Status::failed  ? 2
                      : status == Status::wrong ? 1
                                                : 0,
                      time ? time->value : none,
                      per_ray(entry.measurement->work, &report::Work::object_tests).value_or(none));
  };
  std::stable_sort(entries.begin(), entries.end(),
                   [&](const Entry& a, const Entry& b) { return key(a) < key(b); });
}

void compare(Group& group) {
  const Measurement *zero_overhead = fastest(group.entries, kZeroOverhead),
                    *embree = fastest(group.entries, kEmbree);
  for (Entry& entry : group.entries) {
    entry.rays = group.rays ? group.rays->rays : 0;
    entry.zero_overhead = zero_overhead;
    entry.embree = embree;
  }
  sort(group.entries);
}

}  // namespace

std::vector<Group> groups(const report::Report& report) {
  std::vector<Group> result;
  Labels labels;
  for (const Measurement& measurement : report.measurements)
    labels.add(measurement.technique, measurement.config);
  for (const Measurement& measurement : report.measurements)
    group_of(result, report, measurement)
        .entries.push_back({&measurement, labels(measurement.technique, measurement.config)});
  for (const report::LeftOutCell& cell : report.left_out)
    group_of(result, report, cell).left_out.push_back(&cell);
  for (Group& group : result) compare(group);
  std::stable_sort(result.begin(), result.end(), [](const Group& a, const Group& b) {
    // Both lead into one array; a scene that is not listed comes first.
    return std::less<>()(a.scene, b.scene);
  });
  return result;
}

bool traces_ray_by_ray(const Measurement& measurement) {
  const auto mode = measurement.config.find("mode");
  return mode == measurement.config.end() || mode->second == report::ConfigValue("single");
}

std::optional<Estimate> time_per_ray(const Entry& entry) {
  auto time = median(entry.measurement->trace_ns);
  if (!time || entry.rays == 0) return std::nullopt;
  const double rays = static_cast<double>(entry.rays);
  time->value /= rays;
  if (auto& interval = time->interval) interval = {interval->low / rays, interval->high / rays};
  return time;
}

std::optional<Estimate> times_zero_overhead(const Entry& entry) {
  if (!entry.zero_overhead) return std::nullopt;
  return ratio(entry.measurement->trace_ns, entry.zero_overhead->trace_ns);
}

std::optional<Estimate> times_embree(const Entry& entry) {
  if (!entry.embree) return std::nullopt;
  return ratio(entry.embree->trace_ns, entry.measurement->trace_ns);
}

std::optional<double> per_ray(const std::optional<report::Work>& work, std::uint64_t report::Work::*count) {
  if (!work || work->rays == 0) return std::nullopt;
  return static_cast<double>((*work).*count) / static_cast<double>(work->rays);
}

const std::optional<report::Work>& equation_3_basis(const Measurement& measurement) {
  return measurement.strict_work ? measurement.strict_work : measurement.work;
}

}  // namespace rayshoot::analysis
