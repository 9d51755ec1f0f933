#include "analysis/compare/compare.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "analysis/compare/compare_tables.h"
#include "analysis/compare/exact_counts.h"
#include "analysis/tests/small_report.h"

namespace rayshoot::analysis {
namespace {

using report::Report;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

/// How far repetitions of one run spread on an idle machine: half of the cells of the suite `quick` less, nine of
/// ten less than 2.4 %.
constexpr double kSpread = 0.015;

/// A report of the suite `quick`, 25 techniques on 8 scenes, nine repetitions each: times of one true value,
/// slower by a factor, and noise.
Report simulated(std::mt19937_64& generator, double factor = 1) {
  std::lognormal_distribution<double> noise(0, kSpread);
  Report report;
  report.run.id = "simulated";
  for (int scene = 0; scene < 8; ++scene) {
    const std::string id = fmt::format("scene{}", scene), rays = id + "/rays";
    report.scenes.push_back({.id = id, .hash = "1"});
    report.ray_sets.push_back({.id = rays, .scene = id, .rays = 1000, .hash = "2"});
    for (int technique = 0; technique < 25; ++technique) {
      report::Measurement cell{.scene = id,
                               .rays = rays,
                               .technique = fmt::format("technique{}", technique),
                               .scalar = "float",
                               .query = "closest"};
      cell.work = report::Work{1000, 1200, 1000, 0, 950, 900, 200, 30};
      for (int i = 0; i < 9; ++i) cell.trace_ns.push_back(1e6 * (1 + technique) * factor * noise(generator));
      for (int i = 0; i < 9; ++i) cell.build_ns.push_back(1e6 * noise(generator));
      report.measurements.push_back(std::move(cell));
    }
  }
  return report;
}

std::size_t count(const Comparison& comparison, Judgement judgement) {
  std::size_t cells = 0;
  for (const ComparedCell& cell : comparison.cells) cells += cell.trace.judgement == judgement;
  return cells;
}

TEST(Compare, FlagsNothingWhereNothingChanged) {
  std::mt19937_64 generator(1);
  std::size_t flagged = 0, tables = 0, excluded = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const Report before = simulated(generator), after = simulated(generator);
    const Comparison comparison = compare(before, after, {.tolerance = 0});
    ASSERT_THAT(comparison.cells, SizeIs(200));
    flagged += 200 - count(comparison, Judgement::same);
    tables += comparison.failed();
    for (const ComparedCell& cell : comparison.cells)
      excluded += cell.trace.ratio->interval->low > 1 || cell.trace.ratio->interval->high < 1;
  }
  EXPECT_LE(flagged, 20u * 200 / 20) << "at most 5 % of cells";
  EXPECT_LE(tables, 4u) << "at most 5 % of tables, within the noise of 20";
  EXPECT_NEAR(static_cast<double>(excluded) / (20 * 200), 0.04, 0.015)
      << "single intervals err as often as they say";
}

TEST(Compare, FlagsASlowdownByTenPerCent) {
  std::mt19937_64 generator(2);
  for (const double tolerance : {0.0, 0.02, CompareOptions{}.tolerance}) {
    std::size_t slower = 0;
    for (int trial = 0; trial < 5; ++trial) {
      const Report before = simulated(generator), after = simulated(generator, 1.1);
      const Comparison comparison = compare(before, after, {.tolerance = tolerance});
      slower += count(comparison, Judgement::slower);
      EXPECT_TRUE(comparison.failed());
    }
    EXPECT_GE(slower, 950u) << "of 1000 at " << tolerance;
  }
}

/// One slower cell among 200: nothing else takes part of the correction from it.
TEST(Compare, FlagsASingleCell) {
  std::mt19937_64 generator(3);
  int found = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const Report before = simulated(generator);
    Report after = simulated(generator);
    for (double& time : after.measurements[77].trace_ns) time *= 1.1;
    const Comparison comparison = compare(before, after, {.tolerance = 0.02});
    found += comparison.cells[77].trace.judgement == Judgement::slower;
    EXPECT_LE(count(comparison, Judgement::slower), 1u);
  }
  EXPECT_GE(found, 19);
}

TEST(Compare, CallsFasterWhatIsFasterAndDoesNotFail) {
  std::mt19937_64 generator(4);
  const Report before = simulated(generator, 1.2), after = simulated(generator);
  const Comparison comparison = compare(before, after, {});
  EXPECT_EQ(count(comparison, Judgement::faster), 200u);
  EXPECT_FALSE(comparison.failed());
}

/// Only what lies beyond the tolerance in its own interval is flagged.
TEST(Compare, FlagsOnlyWhatTheIntervalExcludes) {
  std::mt19937_64 generator(5);
  std::size_t slower = 0;
  const Report before = simulated(generator), after = simulated(generator, 1.07);
  for (const ComparedCell& cell : compare(before, after, {}).cells)
    if (cell.trace.judgement == Judgement::slower) {
      ++slower;
      EXPECT_GT(cell.trace.ratio->interval->low, 1.05);
    }
  EXPECT_GT(slower, 0u);
  EXPECT_LT(slower, 200u);
}

TEST(Compare, TakesAwayWhatMadeAllOfARunSlower) {
  std::mt19937_64 generator(6);
  const Report before = simulated(generator), after = simulated(generator, 1.2);
  EXPECT_EQ(count(compare(before, after, {}), Judgement::slower), 200u);
  EXPECT_EQ(count(compare(before, after, {.relative_to = "technique3"}), Judgement::slower), 0u);
  EXPECT_THROW(compare(before, after, {.relative_to = "nothing"}), report::ReportError);
}

/// Each count of the small report, changed by one.
TEST(Compare, FlagsEveryCountThatChanges) {
  const Report before = small_report();
  EXPECT_FALSE(compare(before, before, {}).failed());
  const auto flagged = [&](auto change) {
    Report after = small_report();
    change(after.measurements[1]);
    const Comparison comparison = compare(before, after, {});
    EXPECT_TRUE(comparison.failed());
    EXPECT_THAT(comparison.cells[1].counts, SizeIs(1));
    return comparison.cells[1].counts.at(0).name;
  };
  using report::Measurement;
  EXPECT_EQ(flagged([](Measurement& m) { ++m.work->object_tests; }), "work.object_tests");
  EXPECT_EQ(flagged([](Measurement& m) { --m.work->mailbox_hits; }), "work.mailbox_hits");
  EXPECT_EQ(flagged([](Measurement& m) { m.work->events["new"] = 0; }), "work.events.new");
  EXPECT_EQ(flagged([](Measurement& m) { ++m.strict_work->steps; }), "strict_work.steps");
  EXPECT_EQ(flagged([](Measurement& m) { ++m.structure->bytes; }), "structure.bytes");
  EXPECT_EQ(flagged([](Measurement& m) { ++m.verdict.checked_rays; }), "verdict.checked_rays");
  // What is not counted of a wrong answer is no further change.
  EXPECT_EQ(flagged([](Measurement& m) { m.verdict.status = report::Status::wrong, m.work.reset(); }),
            "verdict.status");
}

/// Reports of the numerical suite have counts as well.
TEST(Compare, FlagsCountsOfTheNumericalSuite) {
  Report before;
  before.gradings = {{.torture_case = "closed_vertex",
                      .setting = "level=2",
                      .property = "always_hit",
                      .technique = "bvh_sah",
                      .scalar = "float",
                      .rays = 1000,
                      .leaks = 0},
                     {.torture_case = "closed_vertex",
                      .setting = "level=3",
                      .property = "always_hit",
                      .technique = "bvh_sah",
                      .scalar = "float",
                      .rays = 1000,
                      .leaks = 0}};
  Report after = before;
  EXPECT_FALSE(compare(before, after, {}).failed());
  after.gradings[1].leaks = 1;
  const Comparison comparison = compare(before, after, {});
  EXPECT_TRUE(comparison.failed());
  ASSERT_THAT(comparison.cells, SizeIs(2));
  EXPECT_THAT(comparison.cells[0].counts, IsEmpty());
  EXPECT_EQ(comparison.cells[1].group, "closed_vertex, level=3, float");
  EXPECT_EQ(comparison.cells[1].counts.at(0).name, "grading.leaks");
  EXPECT_EQ(comparison.cells[1].counts.at(0).after, "1");
  after.gradings.pop_back();
  EXPECT_THAT(compare(before, after, {}).only_before, ElementsAre("bvh_sah (closed_vertex, level=3, float)"));
  EXPECT_THAT(render_compare(comparison, Format::text, true), HasSubstr("grading.leaks"));
}

TEST(Compare, CountsToTheLastDigit) {
  std::mt19937_64 generator(7);
  const Report before = simulated(generator);
  for (std::size_t cell = 0; cell < before.measurements.size(); ++cell) {
    Report after = before;
    after.measurements[cell].work->distinct_objects = (1ull << 60) + 1;
    Report close = before;
    close.measurements[cell].work->distinct_objects = 1ull << 60;
    EXPECT_TRUE(compare(close, after, {}).failed()) << cell;
  }
}

/// Builds of half a millisecond and less, and times of other numbers of threads, are no evidence.
TEST(Compare, DoesNotJudgeShortBuildsNorOtherThreads) {
  std::mt19937_64 generator(8);
  const auto changed = [&](double build_scale) {
    Report before = simulated(generator), after = simulated(generator);
    for (Report* report : {&before, &after})
      for (double& time : report->measurements[0].build_ns) time *= build_scale;
    for (double& time : after.measurements[0].build_ns) time *= 1.5;
    return compare(before, after, {}).cells[0].build.judgement;
  };
  EXPECT_EQ(changed(1), Judgement::slower);
  EXPECT_EQ(changed(0.4), Judgement::not_judged);
  const Report before = simulated(generator);
  Report after = simulated(generator, 2);
  after.measurements[0].trace_threads = 4;
  const Comparison comparison = compare(before, after, {});
  EXPECT_EQ(comparison.cells[0].trace.judgement, Judgement::not_judged);
  EXPECT_EQ(comparison.cells[1].trace.judgement, Judgement::slower);
}

TEST(Compare, DoesNotPassOverChangedInputs) {
  Report before = small_report(), after = small_report();
  after.ray_sets[0].hash = "other";
  const Comparison comparison = compare(before, after, {});
  EXPECT_THAT(comparison.inputs_changed, ElementsAre("balls:2/curves/whitted@9"));
  EXPECT_THAT(comparison.cells, IsEmpty());
  EXPECT_TRUE(comparison.failed());
  EXPECT_THAT(render_compare(comparison, Format::markdown, false), HasSubstr("Other rays or objects"));
}

TEST(Compare, NamesCellsThatOnlyOneReportHas) {
  const Report before = small_report();
  Report after = small_report();
  std::erase_if(after.measurements, [](const auto& cell) { return cell.technique == "bvh_sah"; });
  const Comparison comparison = compare(before, after, {});
  EXPECT_THAT(comparison.only_before, ElementsAre("bvh_sah (balls:2/curves, whitted@9, float)"));
  EXPECT_THAT(comparison.only_after, IsEmpty());
  EXPECT_FALSE(comparison.failed());
  after.measurements.clear();
  EXPECT_THROW(compare(before, after, {}), report::ReportError);
}

TEST(Compare, SaysWhereNothingCanBeFlagged) {
  Report before = small_report();
  for (report::Measurement& cell : before.measurements)
    if (cell.technique == "bvh_sah") cell.trace_ns.resize(3);
  const Comparison comparison = compare(before, before, {});
  EXPECT_THAT(render_compare(comparison, Format::text, false), HasSubstr("2 cells have too few repetitions"))
      << "this one and the fine grid";
}

TEST(Compare, SaysInWordsWhatChanged) {
  const Report before = small_report();
  Report after = small_report();
  ++after.measurements[1].work->steps;
  for (double& time : after.measurements[5].trace_ns) time *= 3;
  const Comparison comparison = compare(before, after, {});
  EXPECT_EQ(in_words(comparison), "Of 7 cells: 1 slower, 0 faster, 1 with another count");
  const std::string shown = render_compare(comparison, Format::markdown, false);
  EXPECT_THAT(shown, HasSubstr("| bvh\\_sah | balls:2/curves, whitted@9, float |"));
  EXPECT_THAT(shown, HasSubstr("| slower |"));
  EXPECT_THAT(shown, HasSubstr("| work.steps | 950 | 951 |"));
  EXPECT_THAT(shown, Not(HasSubstr("All cells")));
  EXPECT_THAT(render_compare(comparison, Format::text, true), HasSubstr("All cells"));
}

/// How many changes of one count of a cell by one are not flagged, of how many.
std::pair<std::size_t, std::size_t> missed_counts(const Report& report, const report::Measurement& cell) {
  using report::Structure, report::Work;
  Report before{.scenes = report.scenes, .ray_sets = report.ray_sets, .measurements = {cell}};
  std::size_t missed = 0, all = 0;
  const auto change = [&](std::uint64_t& count) {
    const Report kept = before;
    ++count;
    missed += !compare(kept, before, {}).failed();
    --count;
    ++all;
  };
  report::Measurement& changed = before.measurements[0];
  for (auto* work : {&changed.work, &changed.strict_work})
    if (*work)
      for (const auto member :
           {&Work::rays, &Work::object_tests, &Work::distinct_objects, &Work::volume_tests, &Work::steps,
            &Work::cells, &Work::empty_cells, &Work::mailbox_hits})
        change((**work).*member);
  if (changed.structure)
    for (const auto member : {&Structure::nodes, &Structure::leaves, &Structure::empty_leaves,
                              &Structure::references, &Structure::max_depth})
      change((*changed.structure).*member);
  return {missed, all};
}

TEST(LongCompare, FlagsEveryCountOfEveryCellOfTheProject) {
  std::size_t missed = 0, all = 0;
  for (const char* name : {"hybrids", "jevans-1990", "speed-bvh-wide", "compositions"}) {
    const Report report =
        report::read_report(fmt::format("{}/results/reports/{}.json", RAYSHOOT_SOURCE, name));
    for (const report::Measurement& cell : report.measurements) {
      const auto [missed_here, all_here] = missed_counts(report, cell);
      missed += missed_here, all += all_here;
    }
  }
  EXPECT_EQ(missed, 0u);
  EXPECT_GT(all, 1000u);
}

/// The bytes of Embree's structure are its own affair, and those of others are not.
TEST(Compare, PassesOverTheBytesOfEmbree) {
  const Report before = small_report();
  for (const auto& [technique, is_flagged] : {std::pair("embree", false), std::pair("bvh_sah", true)}) {
    Report one = before, other = before;
    for (Report* report : {&one, &other})
      for (report::Measurement& cell : report->measurements)
        if (cell.technique == technique)
          cell.structure = report::Structure{.bytes = report == &one ? 100u : 101u};
    EXPECT_EQ(compare(one, other, {}).failed(), is_flagged) << technique;
  }
}

}  // namespace
}  // namespace rayshoot::analysis
