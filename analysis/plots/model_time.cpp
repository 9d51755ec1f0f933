#include <fmt/format.h>

#include "analysis/plots/chart.h"
#include "analysis/plots/plots.h"
#include "analysis/plots/series.h"
#include "analysis/tables/comparison.h"
#include "analysis/tables/page.h"

namespace rayshoot::analysis {

namespace {

/// The model that errs least in each precision.
std::map<std::string, const ModelFit*> best_fits(const Validation& models) {
  std::map<std::string, const ModelVerdict*> best;
  for (const ModelVerdict& verdict : models.verdicts) {
    if (!verdict.median_error) continue;
    const ModelVerdict*& kept = best[verdict.fit->precision];
    if (!kept || *verdict.median_error < *kept->median_error) kept = &verdict;
  }
  std::map<std::string, const ModelFit*> result;
  for (const auto& [precision, verdict] : best) result[precision] = verdict->fit;
  return result;
}

Plot plot_of(const ModelFit& fit, const SeriesStyles& styles) {
  std::vector<double> values;
  for (const ModelCell& cell : fit.cells)
    if (cell.predicted) values.insert(values.end(), {cell.measured, *cell.predicted});
  Chart chart(Axis(values, "time measured, ns per ray"),
              Axis(values, fmt::format("predicted by {}", fit.model->id)), 400);
  chart.equality_with_bands();
  std::vector<std::string> labels;
  std::vector<Point> points;
  for (const ModelCell& cell : fit.cells) {
    if (!cell.predicted || !(*cell.predicted > 0)) continue;
    const std::string& label = cell.entry->label;
    chart.point({cell.measured, *cell.predicted}, styles(label),
                fmt::format("{}, {}: {} ns measured, {} predicted", label, title_of(*cell.group, false),
                            significant(cell.measured), significant(*cell.predicted)));
    labels.push_back(label);
    points.push_back({cell.measured, *cell.predicted});
  }
  chart.legend(styles.legend(labels));
  const std::string title =
      fmt::format("Time that a cost model predicts: {}, {}", fit.model->id, fit.precision);
  return {fmt::format("model-time-{}", file_name_of(fit.precision)), title,
          fmt::format(
              "{}: the model with the least median error. Every scene is predicted from the others; on the "
              "dashed line it is right. {}",
              fit.model->formula, bands_in_words(points)),
          chart.svg().element(title)};
}

}  // namespace

PlotSet model_time_plots(const std::vector<Group>& groups, const Validation& models) {
  PlotSet set{.kind = "Time that cost models predict"};
  const SeriesStyles styles(groups);
  for (const auto& [precision, fit] : best_fits(models)) set.plots.push_back(plot_of(*fit, styles));
  if (set.plots.empty())
    set.left_out = "no scene could be predicted from others: it takes two that were counted and timed";
  return set;
}

}  // namespace rayshoot::analysis
