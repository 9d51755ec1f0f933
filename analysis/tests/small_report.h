#pragma once

#include "harness/report/report.h"

namespace rayshoot::analysis {

/// A report whose numbers are easy to divide: 100 rays of 50 objects; one technique in two configurations, both
/// baselines, one wrong cell and one that failed.
inline report::Report small_report() {
  using report::Status;
  report::Report report;
  report.run.id = "run-1";
  report.scenes = {
      {.id = "balls:2/curves", .generator = "balls", .size = 2, .form = "curves", .objects = 50}};
  report.ray_sets = {{.id = "balls:2/curves/whitted@9", .scene = "balls:2/curves", .rays = 100},
                     {.id = "balls:2/curves/chords", .scene = "balls:2/curves", .rays = 10}};
  const auto cell = [](std::string technique, Status status) {
    return report::Measurement{.scene = "balls:2/curves",
                               .rays = "balls:2/curves/whitted@9",
                               .technique = std::move(technique),
                               .scalar = "float",
                               .query = "closest+any",
                               .verdict = {.status = status, .checked_rays = 100, .reference = "exhaustive"}};
  };
  auto coarse = cell("uniform_grid", Status::ok);
  coarse.config = {{"density", 1.0}, {"mailbox", true}, {"assignment", std::string("box")}};
  coarse.work = report::Work{100, 1200, 1000, 0, 950, 900, 200, 30};
  coarse.strict_work = report::Work{50, 1000, 800, 0, 900, 800, 100, 10};
  coarse.structure = report::Structure{64, 64, 20, 90, 1, 1234};
  coarse.efficiency = report::Efficiency{0.2, {0.19, 0.21}, 0.32, {0.3, 0.34}};
  coarse.build_ns = {2e6, 4e6, 3e6};
  coarse.trace_ns = {20000, 21000, 22000, 24000, 23000, 25000};
  coarse.threads = {{2, {10000, 10500, 11000, 12000, 11500, 12500}}};
  auto fine = coarse;
  fine.config["density"] = 8.0;
  fine.work->object_tests = 500;
  fine.trace_ns = {12000, 12000, 12000};
  fine.threads.clear();
  auto hierarchy = cell("bvh_sah", Status::ok);
  hierarchy.work = report::Work{100, 300, 300, 800, 700, 200, 0, 0};
  hierarchy.strict_work = report::Work{50, 400, 400, 600, 500, 200, 0, 0};
  hierarchy.predicted = report::Predicted{7.6, 12.6};
  hierarchy.efficiency = report::Efficiency{0.06, {0.05, 0.07}, 0.16, {0.15, 0.17}};
  hierarchy.structure = report::Structure{99, 50, 0, 50, 9, 6400};
  hierarchy.build_ns = {123456};
  hierarchy.trace_ns = {8000, 8400, 8800, 9600, 9200, 10000};
  auto zero = cell("zero_overhead", Status::ok);
  zero.work = report::Work{100, 60, 60, 0, 0, 0, 0, 0};
  zero.trace_ns = {500, 525, 550, 600, 575, 625};
  auto embree = cell("embree", Status::graded);
  embree.verdict.wrong_rays = 1;
  embree.build_ns = {5e5};
  embree.trace_ns = {4000, 4200, 4400, 4800, 4600, 5000};
  auto wrong = cell("octree_glassner", Status::wrong);
  wrong.verdict.wrong_rays = 12;
  wrong.build_ns = {1e6};
  auto failed = cell("bvh_goldsmith_salmon", Status::failed);
  failed.verdict = {.status = Status::failed, .message = "out of memory"};
  report.measurements = {wrong, coarse, failed, embree, zero, hierarchy, fine};
  report.left_out = {
      {"balls:2/curves", "balls:2/curves/whitted@9", "exhaustive", "float", "fast", "it would take an hour"},
      {"balls:2/curves", "balls:2/curves/light", "bvh_sah", "float", "fast", "the scene has no lights"},
      {"balls:2/curves", "balls:2/curves/light", "embree", "float", "fast", "the scene has no lights"}};
  return report;
}

}  // namespace rayshoot::analysis
