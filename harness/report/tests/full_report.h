#pragma once

#include "harness/report/report.h"

namespace rayshoot::test {

/// A report in which every member of the format is present, each with a value of its own.
inline report::Report full_report() {
  report::Report report;
  report.run = {.id = "20250102T030405.678Z-9",
                .command = "rayshoot run quick --seed 7",
                .started_utc = "2025-01-02T03:04:05Z",
                .seconds = 1.25,
                .phase_seconds = {{"trace", 0.75}, {"other", 0.5}},
                .git_commit = "0123456789abcdef",
                .git_dirty = true,
                .seed = 18446744073709551615u,
                .bounds = "havran",
                .published = "a paper",
                .complete = false};
  report.environment = {.cpu = "A processor",
                        .cores = 2,
                        .caches_bytes = {{"l1d", 32768}, {"l2", 1048576}},
                        .governor = "performance",
                        .load = 0.5,
                        .os = "An operating system",
                        .compiler = "GNU 12.2.0",
                        .flags = "-O3",
                        .packages = {{"embree", "3.13.5"}}};
  report.scenes = {{.id = "balls:2/curves",
                    .generator = "balls",
                    .size = 2,
                    .form = "curves",
                    .objects = 92,
                    .counts = {{"polygon", 1}, {"sphere", 91}},
                    .bounds = report::Bounds{{-1, -2, -3.5}, {1, 2, 0.1}},
                    .hash = "00000000000000aa",
                    .stiffness = 100,
                    .needs = {{"shadow_rays", true}, {"triangles_only", false}},
                    .set_aside = {{"not finite", 3}},
                    .left_out = {{"refracted rays", "no material transmits"}}}};
  report.ray_sets = {{.id = "balls:2/curves/whitted@3",
                      .scene = "balls:2/curves",
                      .distribution = "whitted",
                      .rules = "clean",
                      .rays = 30,
                      .closest_rays = 12,
                      .any_rays = 18,
                      .primary_rays = 9,
                      .primary_hits = 8,
                      .shadow_rays = 18,
                      .shadow_hits = 7,
                      .reflected_rays = 2,
                      .refracted_rays = 1,
                      .total_internal_reflections = 4,
                      .secondary_hits = 3,
                      .hash = "00000000000000bb"}};
  report.measurements = {
      {.scene = "balls:2/curves",
       .rays = "balls:2/curves/whitted@3",
       .technique = "uniform_grid",
       .config = {{"density", 0.1}, {"resolution", std::int64_t{-1}}, {"mailbox", true}, {"rule", "woo"}},
       .scalar = "float",
       .intersector = "exact",
       .query = "closest+any",
       .verdict = {report::Status::graded, 30, 1, "exhaustive", "one ray differs"},
       .work = report::Work{30, 120, 100, 60, 90, 80, 20, 10, {{"states_shared", 7}}},
       .strict_work = report::Work{15, 240, 200, 61, 91, 81, 21, 11},
       .tested_kinds = report::TestedKinds{0.125, 0.25, 0.5, 0.0625, 1.5},
       .structure = report::Structure{64, 63, 40, 120, 1, 4096, {{"void_area_per_object", 0.5}}},
       .predicted = report::Predicted{4.5, 2.25},
       .sampled_prediction = report::SampledPrediction{7, {4, 2}, {3.5, 1.75}, {3.25, 1.5}},
       .end_point_overlap = report::EndPointOverlap{1000, 0.125, 0.75},
       .cells_deviation = 1.375,
       .work_map = report::WorkMap{3, 2, {40, 20, 10, 5}, {9, 8, 7, 6}},
       .efficiency = report::Efficiency{0.036, {0.03, 0.042}, 0.14, {0.13, 0.15}},
       .errors =
           report::Errors{
               30, {{"exact", 29}, {"near", 1}}, report::Ulps{0.5, 1, 2, 3}, report::Ulps{0, 1, 1, 2}},
       .build_ns = {1000, 1001.5},
       .trace_ns = {3000, 3100, 3050},
       .trace_threads = 1,
       .threads = {{2, {1600, 1650}}},
       .published = {{"references", "a grid", 120, 121}}}};
  report.left_out = {
      {"balls:2/curves", "balls:2/curves/light", "exhaustive", "double", "exact", "it is slow"}};
  report.claims = {{"balls:2/curves", "float", "bvh_sah", "exhaustive", "faster", 0.25, true}};
  report.gradings = {
      {.torture_case = "closed_vertex",
       .setting = "level=3",
       .property = "always_hit",
       .technique = "uniform_grid",
       .config = {{"density", 0.1}},
       .scalar = "float",
       .intersector = "watertight",
       .flush_to_zero = true,
       .objects = 1280,
       .set_aside = 1,
       .stiffness = 12.5,
       .parameter = 3,
       .base = "level=2",
       .rays = 1000,
       .errors = report::Errors{100, {{"exact", 100}}, report::Ulps{0.5, 1, 2, 3}, report::Ulps{0, 1, 1, 2}},
       .leaks = 1,
       .forbidden_hits = 2,
       .changed = 3,
       .any_differs = 4,
       .threads_differ = 5,
       .crossings_lost = 6,
       .work = report::Work{30, 120, 100, 60, 90, 80, 20, 10},
       .most_steps = 17,
       .message = "given up after 20 crashes"}};
  report.choices = {{.scene = "balls:2/curves",
                     .rays = "balls:2/curves/whitted@3",
                     .scalar = "double",
                     .intersector = "watertight",
                     .statistics = {{"objects", 92}, {"crowding", 3.5}},
                     .left_out = {{"exhaustive", "92 objects"}},
                     .sample_rays = 30,
                     .candidates = {{.spec = "uniform_grid(density=0.1)",
                                     .technique = "uniform_grid",
                                     .config = {{"density", 0.1}},
                                     .counts = {{"sphere_test", 4}, {"step", 3}},
                                     .build_ns = 1000,
                                     .predicted_ns_per_ray = 101,
                                     .race_ns_per_ray = {99, 103.5}}},
                     .constants = "a processor, a day",
                     .fitted = true,
                     .expected_rays = 1e6,
                     .predicted = "uniform_grid(density=0.1)",
                     .pick = "uniform_grid(density=0.1)",
                     .why = "nothing else was weighed",
                     .seconds = 0.25}};
  return report;
}

}  // namespace rayshoot::test
