#include "harness/measure/record.h"

namespace rayshoot {

namespace {

std::optional<report::Ulps> ulps_of(const ErrorHistogram& errors) {
  if (errors.count() == 0) return std::nullopt;
  return report::Ulps{errors.quantile(0.5), errors.quantile(0.99), errors.quantile(0.999), errors.max()};
}

}  // namespace

report::Work record(const Work& work, const std::vector<std::string>& events) {
  report::Work recorded{.rays = work.rays,
                        .object_tests = work.object_tests,
                        .distinct_objects = work.distinct_objects,
                        .volume_tests = work.volume_tests,
                        .steps = work.steps,
                        .cells = work.cells,
                        .empty_cells = work.empty_cells,
                        .mailbox_hits = work.mailbox_hits};
  for (std::size_t kind = 0; kind < events.size(); ++kind) recorded.events[events[kind]] = work.events[kind];
  return recorded;
}

std::map<std::string, report::ConfigValue> config_of(const Arguments& arguments) {
  std::map<std::string, report::ConfigValue> config;
  for (const auto& [name, value] : arguments.values())
    std::visit([&config, &key = name](const auto& v) { config.emplace(key, v); }, value);
  return config;
}

report::Structure record(const StructureStats& stats) {
  return {.nodes = stats.nodes,
          .leaves = stats.leaves,
          .empty_leaves = stats.empty_leaves,
          .references = stats.references,
          .max_depth = stats.max_depth,
          .bytes = stats.bytes,
          .figures = stats.figures};
}

report::Errors record(const Grades& grades) {
  report::Errors errors{.graded_rays = grades.graded,
                        .answers = {},
                        .ulps_of_t = ulps_of(grades.ulps_of_t),
                        .ulps_of_point = ulps_of(grades.ulps_of_point)};
  for (std::size_t i = 0; i < grades.answers.size(); ++i)
    if (grades.answers[i] > 0) errors.answers[kAnswerClassNames[i]] = grades.answers[i];
  return errors;
}

}  // namespace rayshoot
