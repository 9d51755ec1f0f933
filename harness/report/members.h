#pragma once

#include <array>
#include <concepts>

#include "harness/report/report.h"

/// The members of every object of a report: what reader and writer both follow.
///
/// A visitor has required(name, value), optional(name, value), for a std::optional or a list or map that is absent
/// when empty, choice(name, value, words), for a required string that is one of some words, and optional_choice, which is
/// the first of them where it is absent.
namespace rayshoot::report {

inline constexpr const char* kSchemaName = "rayshoot.report";
inline constexpr std::array kStatusNames = {"ok", "wrong", "graded", "failed"};
inline constexpr std::array kScalarNames = {"float", "double"};
inline constexpr std::array kIntersectorNames = {"fast", "watertight", "exact"};
inline constexpr std::array kPropertyNames = {"as_oracle", "always_hit", "never_hit", "same_as_base"};
inline constexpr std::array kBoundsNames = {"tight", "havran"};
inline constexpr std::array kRelationNames = {"faster", "similar"};
inline constexpr std::array kQueryNames = {"closest", "any", "closest+any"};

/// T, to be read into, or const T, to be written.
template <class Object, class T>
concept Some = std::same_as<std::remove_const_t<Object>, T>;

template <Some<Run> T, class Visitor>
void members(T& run, Visitor& visitor) {
  visitor.required("id", run.id);
  visitor.required("command", run.command);
  visitor.required("started_utc", run.started_utc);
  visitor.required("seconds", run.seconds);
  visitor.optional("phase_seconds", run.phase_seconds);
  visitor.required("git_commit", run.git_commit);
  visitor.required("git_dirty", run.git_dirty);
  visitor.required("seed", run.seed);
  visitor.optional_choice("bounds", run.bounds, kBoundsNames);
  visitor.optional("published", run.published);
  visitor.required("complete", run.complete);
}

template <Some<Environment> T, class Visitor>
void members(T& environment, Visitor& visitor) {
  visitor.required("cpu", environment.cpu);
  visitor.required("cores", environment.cores);
  visitor.required("caches_bytes", environment.caches_bytes);
  visitor.required("governor", environment.governor);
  visitor.optional("load", environment.load);
  visitor.required("os", environment.os);
  visitor.required("compiler", environment.compiler);
  visitor.required("flags", environment.flags);
  visitor.required("packages", environment.packages);
}

template <Some<LeftOut> T, class Visitor>
void members(T& left_out, Visitor& visitor) {
  visitor.required("what", left_out.what);
  visitor.required("why", left_out.why);
}

template <Some<Bounds> T, class Visitor>
void members(T& bounds, Visitor& visitor) {
  visitor.required("min", bounds.min);
  visitor.required("max", bounds.max);
}

template <Some<Scene> T, class Visitor>
void members(T& scene, Visitor& visitor) {
  visitor.required("id", scene.id);
  visitor.required("generator", scene.generator);
  visitor.optional("size", scene.size);
  visitor.required("form", scene.form);
  visitor.required("objects", scene.objects);
  visitor.required("counts", scene.counts);
  visitor.optional("bounds", scene.bounds);
  visitor.required("hash", scene.hash);
  visitor.optional("stiffness", scene.stiffness);
  visitor.required("needs", scene.needs);
  visitor.required("set_aside", scene.set_aside);
  visitor.required("left_out", scene.left_out);
}

template <Some<RaySet> T, class Visitor>
void members(T& set, Visitor& visitor) {
  visitor.required("id", set.id);
  visitor.required("scene", set.scene);
  visitor.required("distribution", set.distribution);
  visitor.optional("rules", set.rules);
  visitor.required("rays", set.rays);
  visitor.required("closest_rays", set.closest_rays);
  visitor.required("any_rays", set.any_rays);
  visitor.required("primary_rays", set.primary_rays);
  visitor.required("primary_hits", set.primary_hits);
  visitor.required("shadow_rays", set.shadow_rays);
  visitor.required("shadow_hits", set.shadow_hits);
  visitor.required("reflected_rays", set.reflected_rays);
  visitor.required("refracted_rays", set.refracted_rays);
  visitor.required("total_internal_reflections", set.total_internal_reflections);
  visitor.required("secondary_hits", set.secondary_hits);
  visitor.required("hash", set.hash);
}

template <Some<Verdict> T, class Visitor>
void members(T& verdict, Visitor& visitor) {
  visitor.required("status", verdict.status);
  visitor.required("checked_rays", verdict.checked_rays);
  visitor.required("wrong_rays", verdict.wrong_rays);
  visitor.required("reference", verdict.reference);
  visitor.optional("message", verdict.message);
}

template <Some<Work> T, class Visitor>
void members(T& work, Visitor& visitor) {
  visitor.required("rays", work.rays);
  visitor.required("object_tests", work.object_tests);
  visitor.required("distinct_objects", work.distinct_objects);
  visitor.required("volume_tests", work.volume_tests);
  visitor.required("steps", work.steps);
  visitor.required("cells", work.cells);
  visitor.required("empty_cells", work.empty_cells);
  visitor.required("mailbox_hits", work.mailbox_hits);
  visitor.optional("events", work.events);
}

template <Some<TestedKinds> T, class Visitor>
void members(T& kinds, Visitor& visitor) {
  visitor.required("triangles", kinds.triangles);
  visitor.required("polygons", kinds.polygons);
  visitor.required("spheres", kinds.spheres);
  visitor.required("cones", kinds.cones);
  visitor.required("polygon_vertices", kinds.polygon_vertices);
}

template <Some<Structure> T, class Visitor>
void members(T& structure, Visitor& visitor) {
  visitor.required("nodes", structure.nodes);
  visitor.required("leaves", structure.leaves);
  visitor.required("empty_leaves", structure.empty_leaves);
  visitor.required("references", structure.references);
  visitor.required("max_depth", structure.max_depth);
  visitor.required("bytes", structure.bytes);
  visitor.optional("figures", structure.figures);
}

template <Some<Predicted> T, class Visitor>
void members(T& predicted, Visitor& visitor) {
  visitor.required("object_tests_per_ray", predicted.object_tests_per_ray);
  visitor.required("volume_tests_per_ray", predicted.volume_tests_per_ray);
}

template <Some<SampledPrediction> T, class Visitor>
void members(T& prediction, Visitor& visitor) {
  visitor.required("sampled_rays", prediction.sampled_rays);
  visitor.required("unoccluded", prediction.unoccluded);
  visitor.required("occluded", prediction.occluded);
  visitor.required("ordered", prediction.ordered);
}

template <Some<EndPointOverlap> T, class Visitor>
void members(T& overlap, Visitor& visitor) {
  visitor.required("points", overlap.points);
  visitor.required("object_tests_per_point", overlap.object_tests_per_point);
  visitor.required("volume_tests_per_point", overlap.volume_tests_per_point);
}

template <Some<WorkMap> T, class Visitor>
void members(T& map, Visitor& visitor) {
  visitor.required("resolution", map.resolution);
  visitor.required("tile", map.tile);
  visitor.required("object_tests", map.object_tests);
  visitor.required("volume_tests", map.volume_tests);
}

template <Some<Efficiency> T, class Visitor>
void members(T& efficiency, Visitor& visitor) {
  visitor.required("m", efficiency.m);
  visitor.required("m_ci95", efficiency.m_ci95);
  visitor.required("m_strict", efficiency.m_strict);
  visitor.required("m_strict_ci95", efficiency.m_strict_ci95);
}

template <Some<Ulps> T, class Visitor>
void members(T& ulps, Visitor& visitor) {
  visitor.required("median", ulps.median);
  visitor.required("p99", ulps.p99);
  visitor.required("p999", ulps.p999);
  visitor.required("max", ulps.max);
}

template <Some<Errors> T, class Visitor>
void members(T& errors, Visitor& visitor) {
  visitor.required("graded_rays", errors.graded_rays);
  visitor.required("answers", errors.answers);
  visitor.optional("ulps_of_t", errors.ulps_of_t);
  visitor.optional("ulps_of_point", errors.ulps_of_point);
}

template <Some<ThreadTimes> T, class Visitor>
void members(T& times, Visitor& visitor) {
  visitor.required("threads", times.threads);
  visitor.required("trace_ns", times.trace_ns);
}

template <Some<PublishedFigure> T, class Visitor>
void members(T& figure, Visitor& visitor) {
  visitor.required("figure", figure.figure);
  visitor.required("label", figure.label);
  visitor.required("theirs", figure.theirs);
  visitor.optional("ours", figure.ours);
}

template <Some<Claim> T, class Visitor>
void members(T& claim, Visitor& visitor) {
  visitor.required("scene", claim.scene);
  visitor.choice("scalar", claim.scalar, kScalarNames);
  visitor.required("first", claim.first);
  visitor.required("second", claim.second);
  visitor.choice("relation", claim.relation, kRelationNames);
  visitor.optional("first_over_second", claim.first_over_second);
  visitor.optional("holds", claim.holds);
}

template <Some<Measurement> T, class Visitor>
void members(T& measurement, Visitor& visitor) {
  visitor.required("scene", measurement.scene);
  visitor.required("rays", measurement.rays);
  visitor.required("technique", measurement.technique);
  visitor.required("config", measurement.config);
  visitor.choice("scalar", measurement.scalar, kScalarNames);
  visitor.optional_choice("intersector", measurement.intersector, kIntersectorNames);
  visitor.choice("query", measurement.query, kQueryNames);
  visitor.required("verdict", measurement.verdict);
  visitor.optional("work", measurement.work);
  visitor.optional("strict_work", measurement.strict_work);
  visitor.optional("tested_kinds", measurement.tested_kinds);
  visitor.optional("structure", measurement.structure);
  visitor.optional("predicted", measurement.predicted);
  visitor.optional("sampled_prediction", measurement.sampled_prediction);
  visitor.optional("end_point_overlap", measurement.end_point_overlap);
  visitor.optional("cells_deviation", measurement.cells_deviation);
  visitor.optional("work_map", measurement.work_map);
  visitor.optional("efficiency", measurement.efficiency);
  visitor.optional("errors", measurement.errors);
  visitor.optional("build_ns", measurement.build_ns);
  visitor.optional("trace_ns", measurement.trace_ns);
  visitor.required("trace_threads", measurement.trace_threads);
  visitor.optional("threads", measurement.threads);
  visitor.optional("published", measurement.published);
}

template <Some<Grading> T, class Visitor>
void members(T& grading, Visitor& visitor) {
  visitor.required("case", grading.torture_case);
  visitor.required("setting", grading.setting);
  visitor.choice("property", grading.property, kPropertyNames);
  visitor.required("technique", grading.technique);
  visitor.required("config", grading.config);
  visitor.choice("scalar", grading.scalar, kScalarNames);
  visitor.optional_choice("intersector", grading.intersector, kIntersectorNames);
  visitor.required("flush_to_zero", grading.flush_to_zero);
  visitor.required("objects", grading.objects);
  visitor.required("set_aside", grading.set_aside);
  visitor.optional("stiffness", grading.stiffness);
  visitor.required("parameter", grading.parameter);
  visitor.optional("base", grading.base);
  visitor.required("rays", grading.rays);
  visitor.required("errors", grading.errors);
  visitor.required("leaks", grading.leaks);
  visitor.required("forbidden_hits", grading.forbidden_hits);
  visitor.required("changed", grading.changed);
  visitor.required("any_differs", grading.any_differs);
  visitor.required("threads_differ", grading.threads_differ);
  visitor.optional("crossings_lost", grading.crossings_lost);
  visitor.optional("work", grading.work);
  visitor.required("most_steps", grading.most_steps);
  visitor.optional("message", grading.message);
}

template <Some<LeftOutCell> T, class Visitor>
void members(T& cell, Visitor& visitor) {
  visitor.required("scene", cell.scene);
  visitor.required("rays", cell.rays);
  visitor.required("technique", cell.technique);
  visitor.choice("scalar", cell.scalar, kScalarNames);
  visitor.optional_choice("intersector", cell.intersector, kIntersectorNames);
  visitor.required("why", cell.why);
}

template <Some<Candidate> T, class Visitor>
void members(T& candidate, Visitor& visitor) {
  visitor.required("spec", candidate.spec);
  visitor.required("technique", candidate.technique);
  visitor.required("config", candidate.config);
  visitor.required("counts", candidate.counts);
  visitor.required("build_ns", candidate.build_ns);
  visitor.optional("predicted_ns_per_ray", candidate.predicted_ns_per_ray);
  visitor.optional("race_ns_per_ray", candidate.race_ns_per_ray);
}

template <Some<Choice> T, class Visitor>
void members(T& choice, Visitor& visitor) {
  visitor.required("scene", choice.scene);
  visitor.required("rays", choice.rays);
  visitor.choice("scalar", choice.scalar, kScalarNames);
  visitor.optional_choice("intersector", choice.intersector, kIntersectorNames);
  visitor.required("statistics", choice.statistics);
  visitor.required("left_out", choice.left_out);
  visitor.required("sample_rays", choice.sample_rays);
  visitor.required("candidates", choice.candidates);
  visitor.required("constants", choice.constants);
  visitor.required("fitted", choice.fitted);
  visitor.optional("expected_rays", choice.expected_rays);
  visitor.required("predicted", choice.predicted);
  visitor.required("pick", choice.pick);
  visitor.required("why", choice.why);
  visitor.required("seconds", choice.seconds);
}

template <Some<Report> T, class Visitor>
void members(T& report, Visitor& visitor) {
  visitor.required("run", report.run);
  visitor.required("environment", report.environment);
  visitor.required("scenes", report.scenes);
  visitor.required("ray_sets", report.ray_sets);
  visitor.required("measurements", report.measurements);
  visitor.required("left_out", report.left_out);
  visitor.optional("claims", report.claims);
  visitor.optional("gradings", report.gradings);
  visitor.optional("choices", report.choices);
}

}  // namespace rayshoot::report
