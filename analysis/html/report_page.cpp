#include "analysis/html/report_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>
#include <set>

#include "analysis/cost_models/verdicts.h"
#include "analysis/html/html.h"
#include "analysis/html/provenance.h"
#include "analysis/html/summary.h"
#include "analysis/plots/svg.h"
#include "analysis/tables/comparison.h"
#include "analysis/tables/grading.h"
#include "analysis/work_precision/work_precision.h"

namespace rayshoot::analysis {

namespace {

using report::Report;

class PageBuilder {
 public:
  PageBuilder(const std::vector<Report>& reports, const std::vector<Picture>& pictures)
      : reports_(reports), pictures_(pictures) {
    for (const Report& report : reports) {
      auto of_report = groups(report);
      std::move(of_report.begin(), of_report.end(), std::back_inserter(groups_));
    }
    models_ = judged(fit_models(groups_, {cost_models().begin(), cost_models().end()}), {});
    plots_ = all_plots(groups_, reports, models_);
    make_names_unique();
  }

  ReportPage build() {
    add("summary", "Summary", html_paragraphs(summary()));
    add_tables("overview", "All scenes together", overview_tables(reports_));
    add_plots();
    add_pictures();
    add_tables("comparison", "Scene by scene", comparison_tables(reports_));
    add_tables("threads", "Threads", scaling_tables(reports_));
    add_tables("errors", "Error against run time", work_precision_tables(reports_));
    add_tables("models", "Cost models", model_tables());
    add_tables("published", "Published figures", published_tables(reports_));
    add_tables("numerical", "Numerical suite", grading_tables(reports_, false));
    add_tables("provenance", "Machine and provenance", {provenance_table(reports_), inputs_table(reports_)});
    add_tables("left-out", "What was left out, and why", {left_out_table(reports_, plots_)});
    add("columns", "What the columns mean", html_legend(tables_));
    return {html_page("Rayshoot report", subtitle(), sections_), plot_files()};
  }

 private:
  void make_names_unique() {
    std::set<std::string> names;
    for (PlotSet& set : plots_)
      for (Plot& plot : set.plots) {
        const std::string name = plot.name;
        for (int i = 2; !names.insert(plot.name).second; ++i) plot.name = fmt::format("{}-{}", name, i);
      }
  }

  /// Verdicts on the cost models; none where nothing was both counted and timed.
  std::vector<Table> model_tables() const {
    if (models_.fits.empty()) return {};
    return validation_tables(models_, false);
  }

  std::vector<std::string> summary() const {
    std::vector<std::string> sentences;
    for (const Report& report : reports_) {
      std::vector<Group> of_report = groups(report);
      auto more = summary_of(report, of_report);
      if (reports_.size() > 1) sentences.push_back(fmt::format("Run {}:", report.run.id));
      std::move(more.begin(), more.end(), std::back_inserter(sentences));
    }
    return sentences;
  }

  std::string subtitle() const {
    std::vector<std::string> runs;
    for (const Report& report : reports_)
      runs.push_back(fmt::format("Run {} on {}", report.run.id, report.environment.cpu));
    return fmt::format("{}", fmt::join(runs, "; "));
  }

  void add(const std::string& id, const std::string& title, std::string body) {
    sections_.push_back({id, title, std::move(body)});
  }

  void add_tables(const std::string& id, const std::string& title, const std::vector<Table>& tables) {
    std::string body;
    for (const Table& table : tables)
      if (!table.rows.empty() || !table.notes.empty()) body += html_table(table), tables_.push_back(table);
    if (!body.empty()) add(id, title, std::move(body));
  }

  void add_plots() {
    std::string figures;
    for (const PlotSet& set : plots_)
      for (const Plot& plot : set.plots) figures += html_figure(plot);
    if (!figures.empty()) add("plots", "Plots", "<div class=\"figures\">\n" + figures + "</div>\n");
  }

  void add_pictures() {
    std::string figures;
    for (const Picture& picture : pictures_) figures += html_picture(picture.name, picture.png);
    if (!figures.empty()) add("pictures", "Pictures", "<div class=\"figures\">\n" + figures + "</div>\n");
  }

  std::vector<std::pair<std::string, std::string>> plot_files() const {
    std::vector<std::pair<std::string, std::string>> files;
    for (const PlotSet& set : plots_)
      for (const Plot& plot : set.plots) files.emplace_back(plot.name + ".svg", svg_file(plot.svg));
    return files;
  }

  const std::vector<Report>& reports_;
  const std::vector<Picture>& pictures_;
  std::vector<Group> groups_;
  Validation models_;
  std::vector<PlotSet> plots_;
  std::vector<Section> sections_;
  /// All tables of the page, for the legend.
  std::vector<Table> tables_;
};

}  // namespace

ReportPage report_page(const std::vector<Report>& reports, const std::vector<Picture>& pictures) {
  return PageBuilder(reports, pictures).build();
}

}  // namespace rayshoot::analysis
