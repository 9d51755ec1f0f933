#include "analysis/html/summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/plots/series.h"
#include "analysis/statistics/outliers.h"
#include "analysis/statistics/same_twice.h"
#include "analysis/tables/comparison.h"
#include "analysis/tables/page.h"

namespace rayshoot::analysis {

namespace {

using report::Measurement;
using report::Report;
using report::Status;

std::string plural(std::size_t count, const std::string& word) {
  return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
}

std::size_t with_status(const Report& report, Status status) {
  return static_cast<std::size_t>(
      std::count_if(report.measurements.begin(), report.measurements.end(),
                    [&](const Measurement& cell) { return cell.verdict.status == status; }));
}

std::string extent(const Report& report) {
  std::set<std::string> techniques;
  for (const Measurement& cell : report.measurements) techniques.insert(cell.technique);
  std::string text = fmt::format(
      "{} on {} with {}: {}", plural(techniques.size(), "technique"), plural(report.scenes.size(), "scene"),
      plural(report.ray_sets.size(), "ray set"), plural(report.measurements.size(), "cell"));
  text += report.run.complete ? "." : ". The run was interrupted: this is what had finished.";
  return text;
}

std::string correctness(const Report& report) {
  const std::size_t wrong = with_status(report, Status::wrong), failed = with_status(report, Status::failed),
                    graded = with_status(report, Status::graded);
  std::string text = wrong + failed == 0
                         ? "Every answer that was checked agrees with exhaustive search"
                         : fmt::format("{} with wrong answers and {} that failed have no time",
                                       plural(wrong, "cell"), plural(failed, "cell"));
  if (graded > 0)
    text += fmt::format("; {} of engines with object tests of their own are timed although rays may differ",
                        plural(graded, "cell"));
  return text + ".";
}

bool is_baseline(const std::string& label) {
  return label.starts_with(kZeroOverhead) || label.starts_with(kEmbree);
}

std::optional<double> times_zero(const Entry& entry) {
  const auto times = times_zero_overhead(entry);
  return times ? std::optional(times->value) : std::nullopt;
}
std::optional<double> times_of_embree(const Entry& entry) {
  const auto times = times_embree(entry);
  return times ? std::optional(times->value) : std::nullopt;
}
std::optional<double> tests(const Entry& entry) {
  return per_ray(entry.measurement->work, &report::Work::object_tests);
}

std::optional<double> volume_tests(const Entry& entry) {
  return per_ray(entry.measurement->work, &report::Work::volume_tests);
}

/// The first row of none of the baselines.
const MeanRow* best_of(const std::vector<MeanRow>& rows) {
  const auto found =
      std::find_if(rows.begin(), rows.end(), [](const MeanRow& row) { return !is_baseline(row.label); });
  return found == rows.end() ? nullptr : &*found;
}

std::string fastest(const Precision& precision) {
  std::vector<std::string> ignored;
  const auto rows = mean_rows(precision.groups, {trace_ns_per_ray, times_zero, times_of_embree}, ignored);
  const MeanRow* best = best_of(rows);
  if (!best || !best->means[0]) return {};
  std::string text = fmt::format("Fastest over {}: {} with {} ns per ray", title_of_groups(precision),
                                 best->label, significant(*best->means[0]));
  if (best->means[1]) text += fmt::format(", {} times zero overhead", significant(*best->means[1]));
  if (best->means[2]) text += fmt::format(", {} times as fast as Embree", significant(*best->means[2]));
  return text + ".";
}

std::string frugalest(const Precision& precision) {
  std::vector<std::string> ignored;
  const auto rows = mean_rows(precision.groups, {tests, volume_tests}, ignored);
  const MeanRow* best = best_of(rows);
  if (!best || !best->means[0]) return {};
  std::string text = fmt::format("Fewest ray-object tests over {}: {} with {} per ray",
                                 title_of_groups(precision), best->label, significant(*best->means[0]));
  if (best->means[1]) text += fmt::format(", for {} ray-volume tests", significant(*best->means[1]));
  return text + ".";
}

std::string equation_3(const std::vector<Group>& groups) {
  std::vector<double> errors;
  for (const Group& group : groups)
    for (const Entry& entry : group.entries)
      if (entry.measurement->predicted)
        if (const auto error =
                relative_error(entry.measurement->predicted->object_tests_per_ray,
                               per_ray(equation_3_basis(*entry.measurement), &report::Work::object_tests)))
          errors.push_back(std::abs(*error));
  if (errors.empty()) return {};
  return fmt::format(
      "Equation (3) predicts the ray-object tests of {} with a median error of {} %, at most {} %.",
      plural(errors.size(), "cell"), significant(100 * median(errors)->value),
      significant(100 * *std::max_element(errors.begin(), errors.end())));
}

std::string repetitions(const Report& report) {
  std::vector<std::vector<double>> samples;
  std::size_t values = 0, far = 0;
  for (const Measurement& cell : report.measurements)
    for (const auto* times : {&cell.trace_ns, &cell.build_ns}) {
      values += times->size();
      far += outliers(*times).size();
    }
  if (values == 0) return "Nothing was timed.";
  for (const Measurement& cell : report.measurements) samples.push_back(cell.trace_ns);
  const SameTwice check = same_twice(samples);
  std::string text = fmt::format("Of {}, {} lie more than ten deviations from their median; they are kept.",
                                 plural(values, "time"), far);
  if (check.samples > 0)
    text += fmt::format(
        " A/A check: in {} of {} the second half of the repetitions differs from the first at 95 %; by "
        "chance so many "
        "do in {} % of reports{}.",
        check.differ, plural(check.samples, "cell"), significant(100 * check.chance),
        check.chance < 0.01 ? ", so the machine drifted while it measured" : "");
  return text;
}

std::string gradings(const Report& report) {
  if (report.gradings.empty()) return {};
  std::uint64_t rays = 0, leaks = 0, wrong = 0;
  for (const report::Grading& grading : report.gradings) {
    rays += grading.rays;
    leaks += grading.leaks;
    wrong += report::wrong_answers(grading.errors);
  }
  return fmt::format("The numerical suite answered {} rays: {} leaks, {} wrong answers of those graded.",
                     rays, leaks, wrong);
}

}  // namespace

std::vector<std::string> summary_of(const Report& report, const std::vector<Group>& groups) {
  std::vector<std::string> sentences;
  if (!report.measurements.empty()) {
    sentences = {extent(report), correctness(report)};
    for (const Precision& precision : precisions(groups)) {
      sentences.push_back(fastest(precision));
      sentences.push_back(frugalest(precision));
    }
    sentences.push_back(equation_3(groups));
    sentences.push_back(repetitions(report));
  }
  sentences.push_back(gradings(report));
  if (!report.left_out.empty())
    sentences.push_back(fmt::format(
        "{} left out; the reasons are below.",
        report.left_out.size() == 1 ? "1 cell was" : plural(report.left_out.size(), "cell") + " were"));
  std::erase(sentences, "");
  return sentences;
}

}  // namespace rayshoot::analysis
