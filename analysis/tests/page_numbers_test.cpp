// Every number of a page against the report, by formulas of their own.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "analysis/html/report_page.h"
#include "analysis/tables/page.h"
#include "analysis/tests/page_tables.h"
#include "analysis/tests/small_report.h"

namespace rayshoot::analysis {
namespace {

using report::Measurement;
using report::Report;
using report::Status;

double middle(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

/// The median of the ratios of times that were taken in turns; of all ratios where some of them are missing.
double ratio_of(const std::vector<double>& above, const std::vector<double>& below) {
  std::vector<double> logarithms;
  for (std::size_t i = 0; i < above.size(); ++i)
    for (std::size_t j = 0; j < below.size(); ++j)
      if (i == j || above.size() != below.size()) logarithms.push_back(std::log(above[i] / below[j]));
  return std::exp(middle(logarithms));
}

bool same_group(const Measurement& a, const Measurement& b) {
  return a.scene == b.scene && a.rays == b.rays && a.scalar == b.scalar && a.intersector == b.intersector;
}

/// What a column says of a cell: a text, or nothing where a column is not known here.
std::optional<std::string> expected(const Report& report, const Measurement& cell,
                                    const std::string& column) {
  const auto shown = [](std::optional<double> number) { return number ? significant(*number) : "-"; };
  const auto per_ray = [&](std::uint64_t report::Work::*count) {
    return shown(cell.work ? std::optional(static_cast<double>((*cell.work).*count) /
                                           static_cast<double>(cell.work->rays))
                           : std::nullopt);
  };
  const auto ratio_to = [&](const std::string& technique, bool inverse) -> std::string {
    // Those that hand over many rays at a time are the reference only where there is no other.
    const auto many_at_a_time = [](const Measurement& other) {
      return other.config.contains("mode") && other.config.at("mode") != report::ConfigValue("single");
    };
    const Measurement* best = nullptr;
    for (const bool many : {false, true}) {
      if (best) break;
      for (const Measurement& other : report.measurements)
        if (same_group(cell, other) && other.technique == technique && many_at_a_time(other) == many &&
            !other.trace_ns.empty())
          if (!best || middle(other.trace_ns) < middle(best->trace_ns)) best = &other;
    }
    if (!best || cell.trace_ns.empty()) return "-";
    return significant(inverse ? ratio_of(best->trace_ns, cell.trace_ns)
                               : ratio_of(cell.trace_ns, best->trace_ns));
  };
  if (column == "tests /ray") return per_ray(&report::Work::object_tests);
  if (column == "steps /ray") return per_ray(&report::Work::steps);
  if (column == "volumes /ray") return per_ray(&report::Work::volume_tests);
  if (column == "M") return shown(cell.efficiency ? std::optional(cell.efficiency->m) : std::nullopt);
  if (column == "eq. (3) /ray")
    return shown(cell.predicted ? std::optional(cell.predicted->object_tests_per_ray) : std::nullopt);
  if (column == "error %") {
    const auto& work = cell.strict_work ? cell.strict_work : cell.work;
    if (!cell.predicted || !work || work->object_tests == 0) return "-";
    const double error = cell.predicted->object_tests_per_ray * static_cast<double>(work->rays) /
                             static_cast<double>(work->object_tests) -
                         1;
    return (error < 0 ? "" : "+") + significant(100 * error);
  }
  if (column == "build ms") return cell.build_ns.empty() ? "-" : significant(middle(cell.build_ns) / 1e6);
  if (column == "memory MB")
    return shown(cell.structure ? std::optional(static_cast<double>(cell.structure->bytes) / 1e6)
                                : std::nullopt);
  if (column == "time ns/ray") {
    if (cell.verdict.status == Status::failed) return "FAILED";
    if (cell.verdict.status == Status::wrong) return "WRONG";
    for (const report::RaySet& rays : report.ray_sets)
      if (rays.id == cell.rays && !cell.trace_ns.empty())
        return significant(middle(cell.trace_ns) / static_cast<double>(rays.rays));
    return "-";
  }
  if (column == "x zero") return ratio_to("zero_overhead", false);
  if (column == "x Embree") return ratio_to("embree", true);
  return std::nullopt;
}

/// The measurements that a table of the comparison, by its title, shows.
std::vector<const Measurement*> cells_of_table(const Report& report, const std::string& title) {
  std::vector<const Measurement*> cells;
  for (const Measurement& cell : report.measurements) {
    const std::string rays =
        cell.rays.substr(cell.rays.starts_with(cell.scene + "/") ? cell.scene.size() + 1 : 0);
    const std::string start = fmt::format("{}, {}, {}{}; ", cell.scene, rays, cell.scalar,
                                          cell.intersector == "fast" ? "" : ", " + cell.intersector);
    if (title.starts_with(start)) cells.push_back(&cell);
  }
  return cells;
}

/// Whether a row is named after a technique, with or without some of its configuration.
bool names(const std::string& row, const Measurement& cell) {
  const std::string rest = row.starts_with(cell.technique) ? row.substr(cell.technique.size()) : "?";
  return rest.empty() || rest == "*" || rest.starts_with("(");
}

/// What the numbers of all rows of a table are and should be: as sets, since names leave out what all cells share.
void expect_numbers(const Report& report, const PageTable& table, std::size_t& numbers) {
  const auto cells = cells_of_table(report, table.title);
  ASSERT_EQ(cells.size(), table.rows.size()) << table.title;
  std::multiset<std::vector<std::string>> is, should;
  for (const Measurement* cell : cells) {
    std::vector<std::string> row{cell->technique};
    for (std::size_t i = 1; i < table.columns.size(); ++i) {
      const auto text = expected(report, *cell, table.columns[i]);
      ASSERT_TRUE(text) << "nothing is known of the column " << table.columns[i];
      row.push_back(*text);
    }
    should.insert(row);
  }
  for (std::vector<std::string> row : table.rows) {
    // Of "a" and "a|b" the longer one is meant.
    std::string technique;
    for (const Measurement* cell : cells)
      if (names(row[0], *cell) && cell->technique.size() > technique.size()) technique = cell->technique;
    row[0] = technique;
    numbers += row.size() - 1;
    is.insert(row);
  }
  EXPECT_EQ(is, should) << table.title;
}

/// How many numbers of the comparison were compared.
std::size_t compare_page(const Report& report) {
  std::size_t numbers = 0, tables = 0;
  std::set<std::string> groups;
  for (const Measurement& cell : report.measurements)
    groups.insert(cell.rays + " " + cell.scalar + " " + cell.intersector);
  for (const PageTable& table : page_tables(report_page({report}).html))
    if (!cells_of_table(report, table.title).empty()) expect_numbers(report, table, numbers), ++tables;
  EXPECT_EQ(tables, groups.size());
  return numbers;
}

TEST(PageNumbers, AreThoseOfTheReport) {
  EXPECT_EQ(compare_page(small_report()), 7u * 11);
  Report other = small_report();
  other.measurements[1].work->object_tests = 98765;
  other.measurements[3].trace_ns = {1, 2, 3, 4, 5, 6};
  other.measurements[5].predicted->object_tests_per_ray = 1234;
  EXPECT_EQ(compare_page(other), 7u * 11);
}

/// Pages of other reports than they are held against.
TEST(PageNumbers, AreSeenWhereTheyDiffer) {
  const auto tables = page_tables(report_page({small_report()}).html);
  const auto table = std::find_if(tables.begin(), tables.end(), [](const PageTable& one) {
    return one.title.starts_with("balls:2/curves, whitted@9, float; ");
  });
  ASSERT_NE(table, tables.end());
  for (const auto& row : table->rows)
    for (std::size_t column = 1; column < row.size(); ++column) {
      const Report report = small_report();
      for (const Measurement& cell : report.measurements)
        if (names(row[0], cell) && cell.technique == "bvh_sah") {
          EXPECT_EQ(expected(report, cell, table->columns[column]), row[column]) << table->columns[column];
        }
    }
  Report changed = small_report();
  changed.measurements[5].structure->bytes = 9900000;
  EXPECT_EQ(expected(changed, changed.measurements[5], "memory MB"), "9.90");
  EXPECT_EQ(expected(small_report(), small_report().measurements[5], "memory MB"), "0.00640");
}

TEST(PageNumbers, OfInputsAreThoseOfTheReport) {
  Report report = small_report();
  report.ray_sets[0].primary_rays = 64;
  report.ray_sets[0].shadow_rays = 31;
  report.ray_sets[0].reflected_rays = 5;
  report.scenes[0].counts = {{"sphere", 49}, {"polygon", 1}};
  for (const PageTable& table : page_tables(report_page({report}).html))
    if (table.title == "What was traced") {
      EXPECT_EQ(table.rows.at(0),
                (std::vector<std::string>{"balls:2/curves/whitted@9", "50", "polygon 1, sphere 49", "100",
                                          "64", "31", "5", "0"}));
      return;
    }
  ADD_FAILURE() << "no inputs on the page";
}

/// All cells of all reports of the project.
TEST(LongPageNumbers, AreThoseOfTheReportsOfTheProject) {
  std::size_t numbers = 0;
  for (const auto& file :
       std::filesystem::directory_iterator(std::filesystem::path(RAYSHOOT_SOURCE) / "results/reports"))
    if (file.path().extension() == ".json") {
      SCOPED_TRACE(file.path().string());
      numbers += compare_page(report::read_report(file.path().string()));
    }
  EXPECT_GT(numbers, 10000u);
}

}  // namespace
}  // namespace rayshoot::analysis
