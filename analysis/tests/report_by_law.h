#pragma once

#include <fmt/format.h>

#include "analysis/cost_models/cost_model.h"

namespace rayshoot::analysis {

inline const CostModel& model(const std::string& id) {
  for (const CostModel* one : cost_models())
    if (one->id == id) return *one;
  throw std::out_of_range(id);
}

/// Six scenes, five techniques and work that differs in all of them, and times that follow a law.
template <class Nanoseconds>
report::Report report_by_law(const Nanoseconds& ns_per_ray) {
  report::Report report;
  for (std::uint64_t s = 0; s < 6; ++s) {
    const std::string scene = fmt::format("scene{}", s), rays = scene + "/rays";
    report.scenes.push_back(
        {.id = scene, .objects = 100, .counts = {{"triangle", 10 * s}, {"sphere", 100 - 10 * s}}});
    report.ray_sets.push_back(
        {.id = rays, .scene = scene, .distribution = s % 2 ? "chords" : "whitted", .rays = 100});
    for (std::uint64_t t = 0; t < 5; ++t) {
      report::Measurement cell{
          .scene = scene, .rays = rays, .technique = fmt::format("technique{}", t), .scalar = "float"};
      cell.work = report::Work{100,
                               300 + 170 * ((3 * s + t) % 7),
                               250,
                               t < 2 ? 400 + 90 * s * s : 0,
                               200 + 110 * ((s + 5 * t) % 8),
                               150 + 20 * (s * t % 5),
                               50 + 10 * s,
                               0};
      cell.efficiency = report::Efficiency{0.02 + 0.01 * static_cast<double>(s + t), {}, 0.1, {}};
      if (t < 2) cell.predicted = report::Predicted{3 + static_cast<double>(s), 9 - static_cast<double>(t)};
      cell.trace_ns = {100 * ns_per_ray(report.scenes.back(), cell, static_cast<double>(t))};
      report.measurements.push_back(std::move(cell));
    }
  }
  return report;
}

inline double rate(const report::Measurement& cell, std::uint64_t report::Work::*count) {
  return static_cast<double>((*cell.work).*count) / 100;
}

inline double havrans_law(const report::Scene&, const report::Measurement& cell, double) {
  return 8 * rate(cell, &report::Work::object_tests) + 3 * rate(cell, &report::Work::steps) + 20;
}

}  // namespace rayshoot::analysis
