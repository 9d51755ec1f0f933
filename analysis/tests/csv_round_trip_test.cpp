// CSV is for programs: what they read is what the report has, to the last digit.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "analysis/compare/compare_tables.h"
#include "analysis/tables/comparison.h"
#include "analysis/tables/labels.h"
#include "analysis/tests/small_report.h"

namespace rayshoot::analysis {
namespace {

using report::Measurement;
using report::Report;
using Record = std::map<std::string, std::string>;

std::vector<Record> records_of(std::vector<std::vector<std::string>> lines) {
  EXPECT_EQ(lines.back(), std::vector<std::string>{""}) << "ends with an end of line";
  lines.pop_back();
  std::vector<Record> records;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    EXPECT_EQ(lines[i].size(), lines[0].size());
    records.emplace_back();
    for (std::size_t j = 0; j < std::min(lines[0].size(), lines[i].size()); ++j)
      records.back()[lines[0][j]] = lines[i][j];
  }
  return records;
}

/// RFC 4180, read back: fields by the names in the first record.
std::vector<Record> read_csv(const std::string& text) {
  std::vector<std::vector<std::string>> lines{{""}};
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"')
      lines.back().back() += text[++i];
    else if (c == '"')
      quoted = !quoted;
    else if (!quoted && c == ',')
      lines.back().emplace_back();
    else if (!quoted && c == '\n' && lines.back() == std::vector<std::string>{""})
      return records_of(lines);  // what comes after an empty line has other columns
    else if (!quoted && c == '\n')
      lines.push_back({""});
    else
      lines.back().back() += c;
  }
  EXPECT_FALSE(quoted);
  return records_of(lines);
}

/// A number as programs read it.
double number(const Record& record, const std::string& key) {
  return std::strtod(record.at(key).c_str(), nullptr);
}

template <class Part>
void expect_part(const Record& record, const std::string& key, const std::optional<Part>& part,
                 double value) {
  if (part)
    EXPECT_EQ(number(record, key), value) << key;
  else
    EXPECT_EQ(record.at(key), "") << key;
}

void expect_counts(const Record& record, const Measurement& cell) {
  const auto per_ray = [&](const std::string& key, const std::optional<report::Work>& work,
                           std::uint64_t report::Work::*count) {
    const report::Work of = work.value_or(report::Work{1});
    expect_part(record, key, work, static_cast<double>(of.*count) / static_cast<double>(of.rays));
  };
  per_ray("object_tests_per_ray", cell.work, &report::Work::object_tests);
  per_ray("volume_tests_per_ray", cell.work, &report::Work::volume_tests);
  per_ray("steps_per_ray", cell.work, &report::Work::steps);
  per_ray("distinct_objects_per_ray", cell.work, &report::Work::distinct_objects);
  per_ray("cells_per_ray", cell.work, &report::Work::cells);
  per_ray("empty_cells_per_ray", cell.work, &report::Work::empty_cells);
  per_ray("mailbox_hits_per_ray", cell.work, &report::Work::mailbox_hits);
  per_ray("strict_object_tests_per_ray", cell.strict_work, &report::Work::object_tests);
  per_ray("strict_volume_tests_per_ray", cell.strict_work, &report::Work::volume_tests);
  const report::Structure structure = cell.structure.value_or(report::Structure{});
  expect_part(record, "nodes", cell.structure, static_cast<double>(structure.nodes));
  expect_part(record, "leaves", cell.structure, static_cast<double>(structure.leaves));
  expect_part(record, "empty_leaves", cell.structure, static_cast<double>(structure.empty_leaves));
  expect_part(record, "references", cell.structure, static_cast<double>(structure.references));
  expect_part(record, "max_depth", cell.structure, static_cast<double>(structure.max_depth));
  expect_part(record, "memory_mb", cell.structure, static_cast<double>(structure.bytes) / 1e6);
  const report::Efficiency efficiency = cell.efficiency.value_or(report::Efficiency{});
  expect_part(record, "m", cell.efficiency, efficiency.m);
  expect_part(record, "m_low", cell.efficiency, efficiency.m_ci95[0]);
  expect_part(record, "m_high", cell.efficiency, efficiency.m_ci95[1]);
  expect_part(record, "m_strict", cell.efficiency, efficiency.m_strict);
  expect_part(record, "m_strict_low", cell.efficiency, efficiency.m_strict_ci95[0]);
  expect_part(record, "m_strict_high", cell.efficiency, efficiency.m_strict_ci95[1]);
  const report::Predicted predicted = cell.predicted.value_or(report::Predicted{});
  expect_part(record, "predicted_object_tests_per_ray", cell.predicted, predicted.object_tests_per_ray);
  expect_part(record, "predicted_volume_tests_per_ray", cell.predicted, predicted.volume_tests_per_ray);
  EXPECT_EQ(number(record, "checked_rays"), static_cast<double>(cell.verdict.checked_rays));
  EXPECT_EQ(number(record, "wrong_rays"), static_cast<double>(cell.verdict.wrong_rays));
}

void expect_times(const Record& record, const Report& report, const Measurement& cell) {
  EXPECT_EQ(number(record, "repetitions"), static_cast<double>(cell.trace_ns.size()));
  EXPECT_EQ(number(record, "builds"), static_cast<double>(cell.build_ns.size()));
  EXPECT_EQ(number(record, "trace_threads"), cell.trace_threads);
  std::vector<double> builds_ms;
  for (const double ns : cell.build_ns) builds_ms.push_back(ns / 1e6);
  const auto build = median(builds_ms), trace = median(cell.trace_ns);
  expect_part(record, "build_ms", build, build ? build->value : 0);
  for (const report::RaySet& rays : report.ray_sets)
    if (rays.id == cell.rays && cell.verdict.status != report::Status::wrong)
      expect_part(record, "trace_ns_per_ray", trace,
                  trace ? trace->value / static_cast<double>(rays.rays) : 0);
}

std::string key_of(const Measurement& cell) {
  return fmt::format("{} {} {} {} {} {}", cell.scene, cell.rays, cell.technique, config_text(cell.config),
                     cell.scalar, cell.intersector);
}

/// How many cells were compared.
std::size_t compare_csv(const Report& report) {
  std::map<std::string, const Measurement*> cells;
  for (const Measurement& cell : report.measurements) cells[key_of(cell)] = &cell;
  const auto records = read_csv(render_comparison({report}, Format::csv));
  EXPECT_EQ(records.size(), report.measurements.size());
  for (const Record& record : records) {
    const auto cell = cells.find(fmt::format("{} {} {} {} {} {}", record.at("scene"), record.at("rays"),
                                             record.at("technique"), record.at("config"), record.at("scalar"),
                                             record.at("intersector")));
    if (cell == cells.end()) {
      ADD_FAILURE() << record.at("technique");
      continue;
    }
    SCOPED_TRACE(cell->first);
    expect_counts(record, *cell->second);
    expect_times(record, report, *cell->second);
  }
  return records.size();
}

TEST(CsvRoundTrip, OfTheSmallReport) { EXPECT_EQ(compare_csv(small_report()), 7u); }

/// Numbers with all digits and names with all that separates fields.
TEST(CsvRoundTrip, OfNumbersAndNamesThatAreHardToWrite) {
  Report report = small_report();
  report.scenes[0].id = report.ray_sets[0].scene = "a,\"b\"\nc";
  report.ray_sets[0].rays = 12347;
  for (Measurement& cell : report.measurements) {
    cell.scene = report.scenes[0].id;
    if (cell.work) cell.work->rays = 7, cell.work->object_tests = (1ull << 53) - 1;
    if (cell.efficiency) cell.efficiency->m = 0.1 + 0.2, cell.efficiency->m_strict = 5e-324;
    for (double& time : cell.trace_ns) time = std::nextafter(time, 2 * time);
  }
  EXPECT_EQ(compare_csv(report), 7u);
}

/// The cells of a comparison: the ratio of equal samples is 1, to the last digit.
TEST(CsvRoundTrip, OfAComparison) {
  const Report report = small_report();
  const auto records = read_csv(render_compare(compare(report, report, {}), Format::csv, false));
  EXPECT_EQ(records.size(), 7u);
  for (const Record& record : records) {
    if (record.at("trace_ratio").empty()) continue;
    EXPECT_EQ(number(record, "trace_ratio"), 1);
    EXPECT_EQ(number(record, "before_ns_per_ray"), number(record, "after_ns_per_ray"));
  }
}

TEST(LongCsvRoundTrip, OfTheReportsOfTheProject) {
  std::size_t cells = 0;
  for (const auto& file :
       std::filesystem::directory_iterator(std::filesystem::path(RAYSHOOT_SOURCE) / "results/reports"))
    if (file.path().extension() == ".json") {
      SCOPED_TRACE(file.path().string());
      // Reports of the numerical suite have answers in place of cells, and another CSV.
      const Report report = report::read_report(file.path().string());
      if (!report.measurements.empty()) cells += compare_csv(report);
    }
  EXPECT_GT(cells, 1000u);
}

}  // namespace
}  // namespace rayshoot::analysis
