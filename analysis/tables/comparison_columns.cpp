#include "analysis/statistics/outliers.h"
#include "analysis/tables/comparison.h"
#include "analysis/tables/labels.h"

namespace rayshoot::analysis {

namespace {

using report::Status;
using report::Work;

constexpr const char* kStatusWords[] = {"ok", "wrong", "graded", "failed"};
constexpr double kNanosecondsPerMillisecond = 1e6, kBytesPerMegabyte = 1e6;

Cell value_of(const std::optional<Estimate>& estimate) {
  return number(estimate ? std::optional(estimate->value) : std::nullopt);
}
Cell low_of(const std::optional<Estimate>& estimate) {
  return number(estimate && estimate->interval ? std::optional(estimate->interval->low) : std::nullopt);
}
Cell high_of(const std::optional<Estimate>& estimate) {
  return number(estimate && estimate->interval ? std::optional(estimate->interval->high) : std::nullopt);
}

std::optional<Estimate> build_ms(const Entry& entry) {
  std::vector<double> milliseconds;
  for (const double ns : entry.measurement->build_ns) milliseconds.push_back(ns / kNanosecondsPerMillisecond);
  return median(milliseconds);
}

/// A member of something that may not have been measured.
template <class Part, class Member>
Cell part(const std::optional<Part>& measured, Member Part::*member) {
  return number(measured ? std::optional(static_cast<double>((*measured).*member)) : std::nullopt);
}

template <std::uint64_t Work::*count>
Cell work(const Group&, const Entry& entry) {
  return number(per_ray(entry.measurement->work, count));
}
template <std::uint64_t Work::*count>
Cell strict_work(const Group&, const Entry& entry) {
  return number(per_ray(entry.measurement->strict_work, count));
}
template <std::uint64_t report::Structure::*count>
Cell structure(const Group&, const Entry& entry) {
  return part(entry.measurement->structure, count);
}
template <double report::Efficiency::*m>
Cell efficiency(const Group&, const Entry& entry) {
  return part(entry.measurement->efficiency, m);
}
template <std::array<double, 2> report::Efficiency::*interval, std::size_t end>
Cell efficiency_interval(const Group&, const Entry& entry) {
  const auto& measured = entry.measurement->efficiency;
  return number(measured ? std::optional(((*measured).*interval)[end]) : std::nullopt);
}
template <double report::EndPointOverlap::*tests>
Cell end_point_overlap(const Group&, const Entry& entry) {
  return part(entry.measurement->end_point_overlap, tests);
}
template <double report::Predicted::*tests>
Cell predicted(const Group&, const Entry& entry) {
  return part(entry.measurement->predicted, tests);
}
template <double report::Predicted::*tests, std::uint64_t Work::*count>
Cell prediction_error(const Group&, const Entry& entry) {
  const auto expected = part(entry.measurement->predicted, tests).number;
  return number(relative_error(expected, per_ray(equation_3_basis(*entry.measurement), count)));
}

Cell basis(const Group&, const Entry& entry) {
  if (!entry.measurement->predicted || !equation_3_basis(*entry.measurement)) return {};
  return words(entry.measurement->strict_work ? "strict" : "closest");
}

Cell label(const Group&, const Entry& entry) {
  return words(entry.label + (entry.measurement->verdict.status == Status::graded ? "*" : ""));
}

/// The time, or why there is none.
Cell time(const Group&, const Entry& entry) {
  const Status status = entry.measurement->verdict.status;
  if (status == Status::failed) return words("FAILED");
  return status == Status::wrong ? words("WRONG") : value_of(time_per_ray(entry));
}

Column in_csv(std::string key, Style style = Style::number) {
  return {.key = std::move(key), .style = style, .place = Place::csv};
}

/// What tells a row from all others.
std::vector<ComparisonColumn> identity_columns() {
  return {
      {technique_column(), label},
      {in_csv("run", Style::text),
       [](const Group& group, const Entry&) { return words(group.report->run.id); }},
      {in_csv("scene", Style::text), [](const Group& group, const Entry&) { return words(group.scene_id); }},
      {in_csv("rays", Style::text), [](const Group& group, const Entry&) { return words(group.rays_id); }},
      {in_csv("scalar", Style::text), [](const Group& group, const Entry&) { return words(group.scalar); }},
      {in_csv("intersector", Style::text),
       [](const Group& group, const Entry&) { return words(group.intersector); }},
      {in_csv("technique", Style::text),
       [](const Group&, const Entry& entry) { return words(entry.measurement->technique); }},
      {in_csv("config", Style::text),
       [](const Group&, const Entry& entry) { return words(config_text(entry.measurement->config)); }},
      {in_csv("query", Style::text),
       [](const Group&, const Entry& entry) { return words(entry.measurement->query); }},
      {in_csv("objects"),
       [](const Group& group, const Entry&) { return group.scene ? whole(group.scene->objects) : Cell{}; }},
      {in_csv("ray_count"),
       [](const Group& group, const Entry&) { return group.rays ? whole(group.rays->rays) : Cell{}; }},
  };
}

std::vector<ComparisonColumn> verdict_columns() {
  return {
      {in_csv("status", Style::text),
       [](const Group&, const Entry& entry) {
         return words(kStatusWords[static_cast<std::size_t>(entry.measurement->verdict.status)]);
       }},
      {in_csv("checked_rays"),
       [](const Group&, const Entry& entry) { return whole(entry.measurement->verdict.checked_rays); }},
      {in_csv("wrong_rays"),
       [](const Group&, const Entry& entry) { return whole(entry.measurement->verdict.wrong_rays); }},
      {in_csv("reference", Style::text),
       [](const Group&, const Entry& entry) { return words(entry.measurement->verdict.reference); }},
      {in_csv("message", Style::text),
       [](const Group&, const Entry& entry) {
         return words(entry.measurement->verdict.message.value_or(""));
       }},
  };
}

std::vector<ComparisonColumn> work_columns() {
  return {
      {{"object_tests_per_ray", "tests", "/ray", "ray-object tests, repeated ones included"},
       work<&Work::object_tests>},
      {{"steps_per_ray", "steps", "/ray", "steps from one cell or node to another"}, work<&Work::steps>},
      {{"volume_tests_per_ray", "volumes", "/ray", "ray-volume tests"}, work<&Work::volume_tests>},
      {in_csv("distinct_objects_per_ray"), work<&Work::distinct_objects>},
      {in_csv("cells_per_ray"), work<&Work::cells>},
      {in_csv("cells_deviation"),
       [](const Group&, const Entry& entry) { return number(entry.measurement->cells_deviation); }},
      {in_csv("empty_cells_per_ray"), work<&Work::empty_cells>},
      {in_csv("mailbox_hits_per_ray"), work<&Work::mailbox_hits>},
      {in_csv("strict_object_tests_per_ray"), strict_work<&Work::object_tests>},
      {in_csv("strict_volume_tests_per_ray"), strict_work<&Work::volume_tests>},
  };
}

std::vector<ComparisonColumn> model_columns() {
  using report::Efficiency, report::EndPointOverlap, report::Predicted;
  return {
      {{"m", "M", "",
        "share of the scene's objects that a ray is tested with on its way to the hit (Revelles)"},
       efficiency<&Efficiency::m>},
      {in_csv("m_low"), efficiency_interval<&Efficiency::m_ci95, 0>},
      {in_csv("m_high"), efficiency_interval<&Efficiency::m_ci95, 1>},
      {in_csv("m_strict"), efficiency<&Efficiency::m_strict>},
      {in_csv("m_strict_low"), efficiency_interval<&Efficiency::m_strict_ci95, 0>},
      {in_csv("m_strict_high"), efficiency_interval<&Efficiency::m_strict_ci95, 1>},
      {{"predicted_object_tests_per_ray", "eq. (3)", "/ray", "ray-object tests that equation (3) predicts"},
       predicted<&Predicted::object_tests_per_ray>},
      {{"predicted_object_tests_error", "error", "%",
        "eq. (3) / tests of the strict optimizer - 1; where those were not counted, / tests of this table - "
        "1",
        Style::signed_percent},
       prediction_error<&Predicted::object_tests_per_ray, &Work::object_tests>},
      {in_csv("predicted_volume_tests_per_ray"), predicted<&Predicted::volume_tests_per_ray>},
      {in_csv("predicted_volume_tests_error"),
       prediction_error<&Predicted::volume_tests_per_ray, &Work::volume_tests>},
      {in_csv("predicted_error_basis", Style::text), basis},
      {in_csv("overlap_object_tests_per_point"), end_point_overlap<&EndPointOverlap::object_tests_per_point>},
      {in_csv("overlap_volume_tests_per_point"), end_point_overlap<&EndPointOverlap::volume_tests_per_point>},
  };
}

std::vector<ComparisonColumn> structure_columns() {
  using report::Structure;
  return {
      {{"build_ms", "build", "ms", "median of the builds"},
       [](const Group&, const Entry& entry) { return value_of(build_ms(entry)); }},
      {in_csv("build_ms_low"), [](const Group&, const Entry& entry) { return low_of(build_ms(entry)); }},
      {in_csv("build_ms_high"), [](const Group&, const Entry& entry) { return high_of(build_ms(entry)); }},
      {in_csv("builds"),
       [](const Group&, const Entry& entry) { return whole(entry.measurement->build_ns.size()); }},
      {{"memory_mb", "memory", "MB",
        "what was built, without the objects themselves; 1 MB = 1,000,000 bytes"},
       [](const Group&, const Entry& entry) {
         Cell cell = part(entry.measurement->structure, &Structure::bytes);
         if (cell.number) *cell.number /= kBytesPerMegabyte;
         return cell;
       }},
      {in_csv("nodes"), structure<&Structure::nodes>},
      {in_csv("leaves"), structure<&Structure::leaves>},
      {in_csv("empty_leaves"), structure<&Structure::empty_leaves>},
      {in_csv("references"), structure<&Structure::references>},
      {in_csv("max_depth"), structure<&Structure::max_depth>},
  };
}

std::vector<ComparisonColumn> time_columns() {
  return {
      {time_column(), time},
      {in_csv("trace_ns_per_ray_low"),
       [](const Group&, const Entry& entry) { return low_of(time_per_ray(entry)); }},
      {in_csv("trace_ns_per_ray_high"),
       [](const Group&, const Entry& entry) { return high_of(time_per_ray(entry)); }},
      {in_csv("repetitions"),
       [](const Group&, const Entry& entry) { return whole(entry.measurement->trace_ns.size()); }},
      {in_csv("outliers"),
       [](const Group&, const Entry& entry) { return whole(outliers(entry.measurement->trace_ns).size()); }},
      {in_csv("trace_threads"),
       [](const Group&, const Entry& entry) {
         return whole(static_cast<std::uint64_t>(entry.measurement->trace_threads));
       }},
      {zero_overhead_column(),
       [](const Group&, const Entry& entry) { return value_of(times_zero_overhead(entry)); }},
      {in_csv("times_zero_overhead_low"),
       [](const Group&, const Entry& entry) { return low_of(times_zero_overhead(entry)); }},
      {in_csv("times_zero_overhead_high"),
       [](const Group&, const Entry& entry) { return high_of(times_zero_overhead(entry)); }},
      {embree_column(), [](const Group&, const Entry& entry) { return value_of(times_embree(entry)); }},
      {in_csv("times_embree_low"),
       [](const Group&, const Entry& entry) { return low_of(times_embree(entry)); }},
      {in_csv("times_embree_high"),
       [](const Group&, const Entry& entry) { return high_of(times_embree(entry)); }},
  };
}

}  // namespace

Column technique_column() {
  return {.key = "label", .title = "technique", .style = Style::text, .place = Place::page};
}

Column time_column() { return {"trace_ns_per_ray", "time", "ns/ray", "median of the repetitions"}; }

Column zero_overhead_column() {
  return {"times_zero_overhead", "x zero", "",
          "time / time of zero_overhead, the median of paired repetitions"};
}

Column embree_column() {
  return {.key = "times_embree",
          .title = "x Embree",
          .meaning = "time of embree / time, likewise: above 1 is faster than Embree",
          .more_is_better = true};
}

const std::vector<ComparisonColumn>& comparison_columns() {
  static const std::vector<ComparisonColumn> columns = [] {
    std::vector<ComparisonColumn> all;
    for (auto* part :
         {identity_columns, verdict_columns, work_columns, model_columns, structure_columns, time_columns})
      for (ComparisonColumn& column : part()) all.push_back(std::move(column));
    return all;
  }();
  return columns;
}

}  // namespace rayshoot::analysis
