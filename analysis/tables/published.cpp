#include <fmt/format.h>

#include <cmath>

#include "analysis/tables/comparison.h"

namespace rayshoot::analysis {

namespace {

Cell relative(double ours, double theirs) {
  if (theirs == 0) return ours == 0 ? Cell{0.0, ""} : Cell{};
  return {ours / theirs - 1, ""};
}

void append_figures(Table& table, const Entry& entry) {
  for (const report::PublishedFigure& figure : entry.measurement->published) {
    auto& row = table.rows.emplace_back(std::vector<Cell>{
        {std::nullopt, entry.label}, {std::nullopt, figure.label}, {std::nullopt, figure.figure}});
    row.push_back({figure.theirs, ""});
    row.push_back({figure.ours, ""});
    row.push_back(figure.ours ? relative(*figure.ours, figure.theirs) : Cell{});
  }
}

Table figures_table(const Group& group, bool several_reports) {
  Table table{.title = title_of(group, several_reports) + ": published figures and ours",
              .columns = {technique_column(),
                          {"published_as", "published as", "", "", Style::text, Place::csv},
                          {"figure", "figure", "", "", Style::text},
                          {"theirs", "theirs", "", "", Style::number},
                          {"ours", "ours", "", "", Style::number},
                          {"deviation", "deviation", "%", "of ours from theirs", Style::signed_percent}}};
  for (const Entry& entry : group.entries) append_figures(table, entry);
  return table;
}

std::string judgement(const report::Claim& claim) {
  if (!claim.holds) return "not timed";
  return *claim.holds ? "holds" : "does not hold";
}

Table claims_table(const report::Report& report) {
  Table table{
      .title = "What was published of times, and whether ours agree",
      .columns = {{"scene", "scene", "", "", Style::text},
                  {"first", "technique", "", "", Style::text},
                  {"relation", "is said to be", "", "", Style::text},
                  {"second", "beside", "", "", Style::text},
                  {"first_over_second", "ours", "times", "our time of the one over that of the other"},
                  {"holds", "here it", "", "", Style::text}}};
  for (const report::Claim& claim : report.claims)
    table.rows.push_back({{std::nullopt, claim.scene},
                          {std::nullopt, claim.first},
                          {std::nullopt, claim.relation},
                          {std::nullopt, claim.second},
                          {claim.first_over_second, ""},
                          {std::nullopt, judgement(claim)}});
  return table;
}

}  // namespace

std::vector<Table> published_tables(const std::vector<report::Report>& reports) {
  std::vector<Table> tables;
  for (const report::Report& report : reports) {
    const std::size_t first = tables.size();
    for (const Group& group : groups(report))
      if (Table table = figures_table(group, reports.size() > 1); !table.rows.empty())
        tables.push_back(std::move(table));
    if (!report.claims.empty()) tables.push_back(claims_table(report));
    if (tables.size() > first && report.run.published)
      tables.back().notes.push_back(
          fmt::format("Published: {}. Bounds: {}.", *report.run.published, report.run.bounds));
  }
  return tables;
}

}  // namespace rayshoot::analysis
