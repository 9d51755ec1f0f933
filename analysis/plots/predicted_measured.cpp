#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/plots/chart.h"
#include "analysis/plots/plots.h"
#include "analysis/plots/series.h"
#include "analysis/tables/comparison.h"
#include "analysis/tables/page.h"

namespace rayshoot::analysis {

namespace {

/// A kind of test that equation (3) predicts.
struct Kind {
  const char *name, *words;
  double report::Predicted::*predicted;
  std::uint64_t report::Work::*measured;
};
constexpr Kind kKinds[] = {
    {"objects", "ray-object tests", &report::Predicted::object_tests_per_ray, &report::Work::object_tests},
    {"volumes", "ray-volume tests", &report::Predicted::volume_tests_per_ray, &report::Work::volume_tests}};

struct Pair {
  std::string label, tip;
  double measured, predicted;
};

std::vector<Pair> pairs_of(const std::vector<Group>& groups, const Kind& kind) {
  std::vector<Pair> pairs;
  for (const Group& group : groups)
    for (const Entry& entry : group.entries) {
      const report::Measurement& cell = *entry.measurement;
      const auto measured = per_ray(equation_3_basis(cell), kind.measured);
      if (!cell.predicted || !measured || !is_right(entry)) continue;
      const double predicted = (*cell.predicted).*kind.predicted;
      if (*measured > 0 && predicted > 0)
        pairs.push_back({entry.label,
                         fmt::format("{}, {}: {} counted, {} predicted", entry.label, title_of(group, false),
                                     significant(*measured), significant(predicted)),
                         *measured, predicted});
    }
  return pairs;
}

double median_error(const std::vector<Pair>& pairs) {
  std::vector<double> errors;
  errors.reserve(pairs.size());
  for (const Pair& pair : pairs) errors.push_back(std::abs(pair.predicted / pair.measured - 1));
  return median(errors)->value;
}

Plot plot_of(const std::vector<Pair>& pairs, const Kind& kind, const SeriesStyles& styles) {
  // Both axes have one range, so that the line of equality is their diagonal.
  std::vector<double> values;
  for (const Pair& pair : pairs) values.push_back(pair.measured), values.push_back(pair.predicted);
  Chart chart(Axis(values, fmt::format("{} per ray, counted", kind.words)),
              Axis(values, "predicted by equation (3)"), 400);
  chart.equality_with_bands();
  std::vector<std::string> labels;
  std::vector<Point> points;
  for (const Pair& pair : pairs) {
    chart.point({pair.measured, pair.predicted}, styles(pair.label), pair.tip);
    labels.push_back(pair.label);
    points.push_back({pair.measured, pair.predicted});
  }
  chart.legend(styles.legend(labels));
  const std::string title = fmt::format("Equation (3) against {}", kind.words);
  return {fmt::format("predicted-measured-{}", kind.name), title,
          fmt::format(
              "{} cells. On the dashed line prediction and count agree; the median of the absolute errors is "
              "{} %. {} Counts are those of the strict optimizer where they were taken.",
              pairs.size(), significant(100 * median_error(pairs)), bands_in_words(points)),
          chart.svg().element(title)};
}

}  // namespace

PlotSet predicted_measured_plots(const std::vector<Group>& groups) {
  PlotSet set{.kind = "Predicted against measured"};
  const SeriesStyles styles(groups);
  for (const Kind& kind : kKinds)
    if (const std::vector<Pair> pairs = pairs_of(groups, kind); !pairs.empty())
      set.plots.push_back(plot_of(pairs, kind, styles));
  if (set.plots.empty()) set.left_out = "no cell has both a prediction of equation (3) and a count";
  return set;
}

}  // namespace rayshoot::analysis
