#include "harness/measure/published.h"

#include <algorithm>

namespace rayshoot {

namespace {

std::optional<double> structure_figure(const std::string& figure, const report::Structure& structure) {
  const auto number = [](std::uint64_t count) { return std::optional(static_cast<double>(count)); };
  if (figure == "interior_nodes") return number(structure.nodes - structure.leaves);
  if (figure == "leaves") return number(structure.leaves);
  if (figure == "empty_leaves") return number(structure.empty_leaves);
  if (figure == "references") return number(structure.references);
  const auto own = structure.figures.find(figure);
  return own == structure.figures.end() ? std::nullopt : std::optional(own->second);
}

std::optional<double> work_figure(const std::string& figure, const report::Work& work, double rays,
                                  double hits) {
  const auto per_ray = [&](std::uint64_t count) { return std::optional(static_cast<double>(count) / rays); };
  if (figure == "object_tests_per_ray") return per_ray(work.object_tests);
  if (figure == "steps_per_ray") return per_ray(work.steps);
  if (figure == "cells_per_ray") return per_ray(work.cells);
  if (figure == "empty_cells_per_ray") return per_ray(work.empty_cells);
  if (figure == "volume_tests_per_ray") return per_ray(work.volume_tests);
  if (figure == "object_tests_per_hit") return static_cast<double>(work.object_tests) / hits;
  if (figure == "object_tests") return static_cast<double>(work.object_tests);
  if (figure == "volume_tests") return static_cast<double>(work.volume_tests);
  return std::nullopt;
}

double median(std::vector<double> times) {
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

}  // namespace

std::optional<double> figure_of(const std::string& figure, const report::Measurement& measurement,
                                const RaySet& set) {
  std::optional<double> value;
  if (measurement.structure) value = structure_figure(figure, *measurement.structure);
  if (value || !measurement.work) return value;
  const auto rays = static_cast<double>(set.rays.size() + set.counts.total_internal_reflections);
  const RayCounts& counts = set.counts;
  const auto hits = static_cast<double>(counts.primary_hits + counts.shadow_hits + counts.secondary_hits);
  return work_figure(figure, *measurement.work, rays, hits);
}

std::vector<report::PublishedFigure> compared(const PublishedRow& row, const report::Measurement& measurement,
                                              const RaySet& set) {
  std::vector<report::PublishedFigure> figures;
  for (const std::string& figure : figure_names())
    if (const auto theirs = row.figures.find(figure); theirs != row.figures.end())
      figures.push_back({figure, row.label, theirs->second, figure_of(figure, measurement, set)});
  return figures;
}

report::Claim judged(const PublishedClaim& claim, const report::Measurement* first,
                     const report::Measurement* second, const std::string& scalar) {
  report::Claim judged{.scene = claim.scene,
                       .scalar = scalar,
                       .first = claim.first,
                       .second = claim.second,
                       .relation = claim.relation};
  if (!first || !second || first->trace_ns.empty() || second->trace_ns.empty()) return judged;
  const double ratio = median(first->trace_ns) / median(second->trace_ns);
  judged.first_over_second = ratio;
  judged.holds = claim.relation == "faster" ? ratio < 1 : std::max(ratio, 1 / ratio) <= kSimilarTimes;
  return judged;
}

}  // namespace rayshoot
