#include "analysis/html/report_page.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <limits>
#include <regex>
#include <set>
#include <tuple>

#include "analysis/tests/small_report.h"

namespace rayshoot::analysis {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Every tag of a page that is opened and not closed, or closed and not open, and ids that are there twice.
std::vector<std::string> faults(std::string html) {
  html = std::regex_replace(html, std::regex("<(script|style)>[^<]*</(script|style)>"), "");
  static const std::set<std::string> empty_tags{"meta", "wbr", "!DOCTYPE"};
  static const std::regex tag("<(/?)([A-Za-z!][A-Za-z0-9]*)([^<>]*)>|<");
  std::vector<std::string> open, found;
  std::set<std::string> ids;
  for (std::sregex_iterator match(html.begin(), html.end(), tag), end; match != end; ++match) {
    const std::string name = (*match)[2], rest = (*match)[3];
    if (name.empty()) found.push_back("a stray <");
    std::smatch id;
    if (std::regex_search(rest, id, std::regex(" id=\"([^\"]*)\"")) && !ids.insert(id[1]).second)
      found.push_back("twice " + id[1].str());
    if (empty_tags.contains(name) || rest.ends_with("/")) continue;
    if ((*match)[1] == "") {
      open.push_back(name);
    } else if (!open.empty() && open.back() == name) {
      open.pop_back();
    } else {
      found.push_back("</" + name);
    }
  }
  found.insert(found.end(), open.begin(), open.end());
  return found;
}

std::string page_of(const report::Report& report) { return report_page({report}).html; }

TEST(ReportPage, IsWellFormed) {
  EXPECT_THAT(faults(page_of(small_report())), IsEmpty());
  EXPECT_THAT(faults(page_of(report::Report{})), IsEmpty());
  EXPECT_THAT(faults("<p><b></p>"), Not(IsEmpty()));
}

/// Every text of a report, made of what would be markup.
TEST(ReportPage, EscapesWhatWouldBeMarkup) {
  const std::string hostile = "</td><script>alert('\"')</script><b a=\"";
  report::Report report = small_report();
  report.run.id = report.run.command = report.environment.cpu = report.environment.flags = hostile;
  report.scenes[0].id = report.ray_sets[0].scene = hostile;
  report.scenes[0].left_out = {{hostile, hostile}};
  report.left_out[0].why = report.left_out[0].technique = hostile;
  for (report::Measurement& cell : report.measurements) {
    cell.scene = hostile;
    cell.technique += hostile;
    cell.config[hostile] = cell.technique;
    if (cell.verdict.message) cell.verdict.message = hostile;
  }
  const std::string page = page_of(report);
  EXPECT_THAT(faults(page), IsEmpty());
  EXPECT_THAT(page, Not(HasSubstr("alert('")));
}

/// Numbers at the ends of their ranges: nothing is drawn at a place that is no number.
TEST(ReportPage, DrawsNothingWithoutAPlace) {
  const double most = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::denorm_min();
  const std::uint64_t all = std::numeric_limits<std::uint64_t>::max();
  for (const auto& [time, count, prediction] :
       {std::tuple(0.0, std::uint64_t{0}, 0.0), std::tuple(most, all, most), std::tuple(least, all, least),
        std::tuple(1.0, std::uint64_t{1}, most), std::tuple(most, std::uint64_t{0}, 1.0)}) {
    report::Report report = small_report();
    for (report::Measurement& cell : report.measurements) {
      if (!cell.trace_ns.empty()) cell.trace_ns.assign(6, time);
      cell.build_ns.assign(6, time);
      cell.work = cell.strict_work = report::Work{1, count, count, count, count, count, count, count};
      cell.structure = report::Structure{count, count, count, count, count, count};
      cell.predicted = report::Predicted{prediction, prediction};
      cell.errors = report::Errors{1, {{"wrong_object", count}}, report::Ulps{time, time, time, time}, {}};
    }
    report.scenes[0].objects = count;
    report.measurements[1].trace_ns = {1, 2, 3, 4, 5, 6};
    const ReportPage page = report_page({report});
    EXPECT_THAT(faults(page.html), IsEmpty());
    for (const auto& [name, svg] : page.plots)
      EXPECT_FALSE(std::regex_search(svg, std::regex("=\"[^\"]*(nan|inf)[^\"]*\"")))
          << name << time << " " << count;
  }
}

TEST(ReportPage, NeedsNoOtherFile) {
  const std::string page = page_of(small_report());
  EXPECT_THAT(page, Not(ContainsRegex(" src=|<link|@import|url\\(")));
  const std::regex address("https?://[^\"]*");
  for (std::sregex_iterator match(page.begin(), page.end(), address), end; match != end; ++match)
    EXPECT_EQ(match->str(), "http://www.w3.org/2000/svg");
}

TEST(ReportPage, SaysWhatTheReportSays) {
  const std::string page = page_of(small_report());
  EXPECT_THAT(page, HasSubstr("6 techniques on 1 scene with 2 ray sets: 7 cells."));
  EXPECT_THAT(page, HasSubstr("1 cell with wrong answers and 1 cell that failed have no time"));
  EXPECT_THAT(
      page,
      HasSubstr("Fastest over balls:2/curves, whitted@9, float: bvh_sah with 90.0 ns per ray, 16.0 times "
                "zero overhead, 0.500 times as fast as Embree."));
  EXPECT_THAT(
      page,
      HasSubstr("Fewest ray-object tests over balls:2/curves, whitted@9, float: bvh_sah with 3.00 per ray"));
  EXPECT_THAT(page, HasSubstr("the ray-object tests of 1 cell with a median error of 5.00 %"));
  EXPECT_THAT(page, HasSubstr("3 cells were left out"));
  EXPECT_THAT(page,
              HasSubstr("<th scope=\"row\">exhaustive</th><td class=\"words\">balls:2/curves/whitted@9</td>"
                        "<td class=\"words\">it would take an hour</td>"));
  EXPECT_THAT(page, HasSubstr("<td class=\"bad\">WRONG</td>"));
  EXPECT_THAT(page, HasSubstr("<td>12.0</td>")) << "tests per ray of the coarse grid";
}

/// A number that changes in the report changes on the page.
TEST(ReportPage, HasItsNumbersFromTheReport) {
  report::Report report = small_report();
  report.measurements[5].trace_ns = {77700, 77700, 77700, 77700, 77700, 77700};
  EXPECT_THAT(page_of(report), HasSubstr("<td>777</td>"));
  EXPECT_THAT(page_of(small_report()), Not(HasSubstr("<td>777</td>")));
}

TEST(ReportPage, HasItsPlotsAlsoAsFiles) {
  report::Report report = small_report();
  for (report::Measurement& cell : report.measurements)
    cell.errors = report::Errors{1000, {{"wrong_object", 10}}, report::Ulps{0.5, 1, 2, 3}, {}};
  // Other rays, whose name makes the same name of a file.
  report.ray_sets[1].id = "balls:2/curves/whitted(9)";
  for (report::Measurement cell : std::vector(report.measurements)) {
    cell.rays = report.ray_sets[1].id;
    report.measurements.push_back(cell);
  }
  const ReportPage page = report_page({report});
  std::set<std::string> names;
  for (const auto& [name, svg] : page.plots) {
    EXPECT_TRUE(names.insert(name).second) << name << " is there twice";
    EXPECT_TRUE(name.ends_with(".svg"));
    EXPECT_THAT(svg, HasSubstr("<style>"));
  }
  EXPECT_GE(names.size(), 8u);
  EXPECT_THAT(faults(page.html), IsEmpty());
}

}  // namespace
}  // namespace rayshoot::analysis
