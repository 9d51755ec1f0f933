#include "analysis/plots/plots.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <boost/property_tree/xml_parser.hpp>
#include <cmath>
#include <regex>
#include <sstream>

#include "analysis/plots/chart.h"
#include "analysis/plots/heat_scale.h"
#include "analysis/plots/svg.h"
#include "analysis/tests/small_report.h"

namespace rayshoot::analysis {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

std::vector<std::string> tick_labels(const Axis& axis) {
  std::vector<std::string> labels;
  for (const Axis::Tick& tick : axis.ticks()) labels.push_back(tick.label);
  return labels;
}

TEST(Axes, HaveTicksThatCanBeRead) {
  EXPECT_THAT(tick_labels(Axis(std::vector{1.0, 9.0}, "")), ElementsAre("1", "2", "5", "10"));
  EXPECT_THAT(tick_labels(Axis(std::vector{1e-9, 1e7}, "")),
              ElementsAre("10⁻⁹", "10⁻⁶", "0.001", "1", "1000", "10⁶"));
  EXPECT_THAT(tick_labels(Axis(std::vector{4.9e6, 5.1e6}, "")), ElementsAre("5·10⁶", "10⁷"));
}

TEST(Axes, HoldTheirValues) {
  const std::vector<double> values{0.3, 7, 1234};
  const Axis axis(values, "");
  for (const double value : values) {
    EXPECT_GE(axis.position(value), 0);
    EXPECT_LE(axis.position(value), 1);
  }
  EXPECT_NEAR(axis.position(100) - axis.position(10), axis.position(1000) - axis.position(100), 1e-12);
}

TEST(Axes, AreThereWithoutValues) {
  EXPECT_THAT(Axis({}, "").ticks(), Not(IsEmpty()));
  EXPECT_THAT(Axis(std::vector{0.0, -1.0, std::nan("")}, "").ticks(), Not(IsEmpty()));
}

/// Where the centres of circles of a plot lie.
std::vector<Point> circles(const std::string& svg) {
  static const std::regex circle("cx=\"([0-9.]+)\" cy=\"([0-9.]+)\"");
  std::vector<Point> points;
  for (std::sregex_iterator match(svg.begin(), svg.end(), circle), end; match != end; ++match)
    points.push_back({std::stod((*match)[1]), std::stod((*match)[2])});
  return points;
}

void expect_well_formed(const std::string& xml) {
  std::istringstream stream(xml);
  boost::property_tree::ptree tree;
  EXPECT_NO_THROW(boost::property_tree::read_xml(stream, tree)) << xml;
}

TEST(Svg, EscapesWhatWouldBeMarkup) {
  EXPECT_EQ(xml_escaped("<a href=\"x\" title='y'>&\x01é"),
            "&lt;a href=&quot;x&quot; title=&#39;y&#39;&gt;&amp; é");
  Svg svg(10, 10);
  svg.text({1, 2}, "</svg><script>");
  svg.marker({1, 2}, MarkerStyle(3), "a < b & \"c\"");
  svg.rectangle({0, 0}, 1, 1, "b0", "<&>");
  svg.upright_text({1, 2}, "]]>");
  expect_well_formed(svg_file(svg.element("\"quoted\" <title>")));
}

TEST(Svg, HasADifferentMarkerForEverySeries) {
  std::set<std::string> markers;
  for (std::size_t series = 0; series < 49; ++series) {
    Svg svg(100, 100);
    svg.marker({50, 50}, MarkerStyle(series));
    markers.insert(svg.element(""));
  }
  EXPECT_THAT(markers, SizeIs(49));
}

TEST(Charts, KeepNamesApart) {
  const std::vector<double> values{1, 2, 5, 10};
  Chart chart(Axis(values, ""), Axis(values, ""));
  int named = 0;
  for (int i = 0; i < 100; ++i) named += chart.name({3, 3}, "a_name_of_some_length");
  EXPECT_GT(named, 1);
  EXPECT_LT(named, 9) << "the places around a point";
}

std::vector<Group> groups_of(const report::Report& report) { return groups(report); }

/// Of the small report one cell has a prediction: 7.6 object tests where the strict optimizer does 8.
TEST(PredictedMeasured, LiesOnTheLineWhereBothAgree) {
  report::Report report = small_report();
  const auto height_above_line = [&] {
    const std::vector<Group> all = groups_of(report);
    const PlotSet set = predicted_measured_plots(all);
    EXPECT_THAT(set.plots, SizeIs(2));
    const std::string& svg = set.plots.at(0).svg;
    std::smatch line;
    EXPECT_TRUE(std::regex_search(svg, line,
                                  std::regex("reference\" d=\"M([0-9.]+) ([0-9.]+)L([0-9.]+) ([0-9.]+)\"")));
    const double x0 = std::stod(line[1]), y0 = std::stod(line[2]), x1 = std::stod(line[3]),
                 y1 = std::stod(line[4]);
    const Point point = circles(svg).at(0);
    return (y0 + (point.x - x0) / (x1 - x0) * (y1 - y0)) - point.y;
  };
  EXPECT_LT(height_above_line(), -1) << "predicted less than counted";
  report.measurements[5].predicted->object_tests_per_ray = 8;
  EXPECT_NEAR(height_above_line(), 0, 0.3);
  report.measurements[5].predicted->object_tests_per_ray = 8.4;
  EXPECT_GT(height_above_line(), 1);
}

TEST(Plots, SayWhyTheyAreNotThere) {
  const report::Report nothing;
  for (const PlotSet& set : all_plots(groups_of(nothing), {nothing}, {})) {
    EXPECT_THAT(set.plots, IsEmpty());
    EXPECT_NE(set.left_out, "") << set.kind;
  }
}

TEST(Plots, AreFilesOfTheirOwn) {
  report::Report report = small_report();
  for (report::Measurement& cell : report.measurements) {
    cell.technique += "<&\"'>";
    cell.errors =
        report::Errors{1000, {{"exact", 990}, {"wrong_object", 10}}, report::Ulps{0.5, 1, 2, 3}, {}};
  }
  report.scenes[0].id = report.ray_sets[0].scene = "a <scene> & \"more\"";
  for (report::Measurement& cell : report.measurements) cell.scene = report.scenes[0].id;
  const std::vector<Group> all = groups_of(report);
  std::size_t plots = 0;
  for (const PlotSet& set : all_plots(all, {report}, {}))
    for (const Plot& plot : set.plots) {
      ++plots;
      expect_well_formed(svg_file(plot.svg));
      EXPECT_TRUE(std::regex_match(plot.name, std::regex("[A-Za-z0-9._-]+"))) << plot.name;
    }
  EXPECT_EQ(plots, 7u);
}

std::string fill_of(double share) {
  const Colour colour = heat_colour(share);
  return fmt::format("fill=\"#{:02x}{:02x}{:02x}\"", colour[0], colour[1], colour[2]);
}

/// Nine eye rays in tiles of four, two, two and one; maps of the same rays share a scale, which ends at 10.
TEST(WorkMaps, ShowTestsPerRayOnOneScale) {
  report::Report report = small_report();
  report.measurements[5].work_map = report::WorkMap{3, 2, {40, 20, 10, 5}, {8, 0, 0, 0}};  // bvh_sah
  report.measurements[1].work_map = report::WorkMap{3, 2, {4, 2, 2, 1}, {0, 0, 0, 0}};     // uniform_grid
  const std::vector<Group> all = groups_of(report);
  const PlotSet set = work_map_plots(all);
  ASSERT_THAT(set.plots, SizeIs(3)) << "where no volume was tested there is nothing to see";
  const auto svg_of = [&](const std::string& begin) -> std::string {
    for (const Plot& plot : set.plots)
      if (plot.title.starts_with(begin)) return plot.svg;
    return "";
  };
  for (const Plot& plot : set.plots) expect_well_formed(svg_file(plot.svg));
  const std::string hierarchy = svg_of("Ray-object tests per eye ray: bvh_sah"),
                    grid = svg_of("Ray-object tests per eye ray: uniform_grid");
  EXPECT_THAT(hierarchy, HasSubstr(fill_of(63.5 / 64) + " d=\"M0 0h2v1h-2z\""));
  EXPECT_THAT(hierarchy, HasSubstr(fill_of(32.5 / 64) + " d=\"M0 1h2v1h-2z\""));
  EXPECT_THAT(grid, HasSubstr(fill_of(6.5 / 64) + " d=\"M0 0h2v1h-2zM0 1h2v1h-2z\""));
  EXPECT_THAT(set.plots[0].caption, HasSubstr("Tiles of 2 x 2 eye rays"));
}

/// Techniques whose time grows with the square root of the objects, and whose memory grows in proportion.
report::Report growing() {
  report::Report report;
  for (const std::uint64_t objects : {100u, 1000u, 10000u, 100000u}) {
    const std::string scene = fmt::format("tetra:{}", objects), rays = scene + "/chords";
    report.scenes.push_back({.id = scene, .generator = "tetra", .form = "patches", .objects = objects});
    report.ray_sets.push_back({.id = rays, .scene = scene, .rays = 10});
    report::Measurement cell{.scene = scene, .rays = rays, .technique = "bvh_sah", .scalar = "float"};
    cell.trace_ns = {70 * std::sqrt(static_cast<double>(objects))};
    cell.structure = report::Structure{.bytes = 48 * objects};
    report.measurements.push_back(cell);
  }
  return report;
}

TEST(ObjectScaling, FindsTheExponents) {
  const report::Report report = growing();
  const auto all = groups_of(report);
  const PlotSet set = object_scaling_plots(all);
  ASSERT_THAT(set.plots, SizeIs(2));
  EXPECT_EQ(set.plots[0].title, "Time over the number of objects: tetra as patches, chords, float");
  EXPECT_THAT(set.plots[0].svg, HasSubstr("bvh_sah: 0.50 [0.50, 0.50]"));
  EXPECT_EQ(set.plots[1].name, "scaling-memory-tetra-as-patches-float");
  EXPECT_THAT(set.plots[1].svg, HasSubstr("bvh_sah: 1.00 [1.00, 1.00]"));
}

TEST(ObjectScaling, HasNoMinusSignBeforeNothing) {
  report::Report report = growing();
  for (std::size_t i = 0; i < report.measurements.size(); ++i)
    report.measurements[i].trace_ns = {1000 - static_cast<double>(i)};
  const auto all = groups_of(report);
  EXPECT_THAT(object_scaling_plots(all).plots.at(0).svg, HasSubstr("bvh_sah: 0.00 [0.00, 0.00]"));
}

TEST(ObjectScaling, NeedsThreeSizes) {
  report::Report report = growing();
  report.measurements.resize(2);
  const auto all = groups_of(report);
  EXPECT_THAT(object_scaling_plots(all).plots, IsEmpty());
  EXPECT_THAT(object_scaling_plots(all).left_out, HasSubstr("3 sizes"));
}

TEST(PredictedMeasured, SaysHowManyLieWithinTheBands) {
  const std::vector<Point> pairs{{10, 11}, {10, 9}, {10, 6}, {10, 19}, {10, 21}, {10, 4}};
  EXPECT_EQ(bands_in_words(pairs), "Shaded: off by at most 1.2 times (2 of 6) and 2 times (4 of 6).");
  Chart chart(Axis(std::vector{1.0, 100.0}, ""), Axis(std::vector{1.0, 100.0}, ""));
  chart.equality_with_bands();
  const std::string svg = chart.svg().element("");
  const std::regex band("class=\"band\"");
  EXPECT_EQ(std::distance(std::sregex_iterator(svg.begin(), svg.end(), band), {}), 2);
}

/// The small report has one technique that two threads trace twice as fast.
TEST(ThreadScaling, DrawsWhatWasTimedWithMoreThreads) {
  const report::Report report = small_report();
  const auto all = groups_of(report);
  const PlotSet set = thread_scaling_plots(all);
  ASSERT_THAT(set.plots, SizeIs(1));
  EXPECT_THAT(
      set.plots[0].svg,
      HasSubstr("uniform_grid(density=1): 2.00 times faster with 2 times the threads, 1 scenes and rays"));
  EXPECT_THAT(set.plots[0].svg, Not(HasSubstr("bvh_sah")));
}

/// Two reports of the same cells, of which the second traced with four threads.
TEST(ThreadScaling, JoinsReportsThatDifferInTheirThreads) {
  const report::Report one = growing();
  report::Report four = growing();
  for (report::Measurement& cell : four.measurements) {
    cell.trace_threads = 4;
    for (double& time : cell.trace_ns) time /= 3;
  }
  auto all = groups_of(one);
  const auto more = groups_of(four);
  all.insert(all.end(), more.begin(), more.end());
  const PlotSet set = thread_scaling_plots(all);
  ASSERT_THAT(set.plots, SizeIs(1));
  EXPECT_THAT(set.plots[0].svg,
              HasSubstr("bvh_sah: 3.00 times faster with 4 times the threads, 4 scenes and rays"));
  const auto single = groups_of(one);
  EXPECT_THAT(thread_scaling_plots(single).left_out, HasSubstr("thread_scaling"));
}

TEST(StiffnessWork, FindsTheExponents) {
  report::Report report = growing();
  for (std::size_t i = 0; i < report.scenes.size(); ++i) {
    report.scenes[i].stiffness = 10 * static_cast<double>(i + 1);
    report.measurements[i].work = report::Work{.rays = 10, .object_tests = 50 * (i + 1) * (i + 1)};
  }
  for (report::RaySet& rays : report.ray_sets) rays.distribution = "chords";
  const auto all = groups_of(report);
  const PlotSet set = stiffness_work_plots(all, {report});
  ASSERT_THAT(set.plots, SizeIs(1)) << "no steps were counted";
  EXPECT_EQ(set.plots[0].title, "Ray-object tests over the stiffness of the scene: chords rays, float");
  EXPECT_THAT(set.plots[0].svg, HasSubstr("bvh_sah: 2.00 [2.00, 2.00]"));
  EXPECT_THAT(set.plots[0].svg, HasSubstr("bvh_sah: 5.00 at stiffness 10.0, tetra:100"));
  report.scenes.resize(2);
  EXPECT_THAT(stiffness_work_plots({}, {}).left_out, HasSubstr("3 scenes"));
}

TEST(StiffnessWork, TakesPlainSettingsOfTheNumericalSuite) {
  report::Report report;
  for (int i = 1; i <= 4; ++i) {
    report::Grading grading{.torture_case = "slivers",
                            .setting = fmt::format("x={}", i),
                            .technique = "kd_tree",
                            .scalar = "double"};
    grading.stiffness = std::pow(10, i);
    grading.work = report::Work{.rays = 1, .steps = static_cast<std::uint64_t>(7 * i)};
    report.gradings.push_back(grading);
    grading.base = grading.setting;
    grading.work->steps = 1000000;
    report.gradings.push_back(grading);
  }
  const PlotSet set = stiffness_work_plots({}, {report});
  ASSERT_THAT(set.plots, SizeIs(1));
  EXPECT_EQ(set.plots[0].title, "Steps over the stiffness of the scene: slivers, double");
  EXPECT_THAT(set.plots[0].svg, HasSubstr("kd_tree: 28.0 at stiffness 10000, x=4"));
  EXPECT_THAT(set.plots[0].svg, Not(HasSubstr("1.00e6")));
}

}  // namespace
}  // namespace rayshoot::analysis
