#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <regex>

#include "analysis/cost_models/far_cells.h"
#include "analysis/cost_models/verdicts.h"
#include "analysis/plots/plots.h"
#include "analysis/tests/find_cell.h"
#include "analysis/tests/report_by_law.h"

namespace rayshoot::analysis {
namespace {

using report::Measurement;
using report::Report;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Optional;
using ::testing::SizeIs;

std::vector<double> values(const std::vector<std::optional<double>>& constants) {
  std::vector<double> result;
  for (const auto& constant : constants) result.push_back(constant.value());
  return result;
}

/// A report, its groups, and one model held against it.
struct Held {
  Report report;
  std::vector<Group> all;
  Validation validation;

  Held(Report given, const std::string& id, ModelBounds bounds = {})
      : report(std::move(given)), all(groups(report)), validation(validate(all, {&model(id)}, bounds)) {}
  const ModelFit& fit() const { return validation.fits.at(0); }
  const ModelVerdict& verdict() const { return validation.verdicts.at(0); }
};

TEST(CostModels, SayWhatTheyAre) {
  EXPECT_GE(cost_models().size(), 7u);
  const Report report = report_by_law(havrans_law);
  for (const CostModel* one : cost_models()) {
    EXPECT_NE(one->title, "");
    EXPECT_THAT(one->formula, HasSubstr("T = "));
    EXPECT_NE(one->source, "");
    EXPECT_NE(one->assumptions, "");
    for (const Group& group : groups(report))
      for (const Entry& entry : group.entries) {
        const auto terms = one->terms(group, entry);
        EXPECT_EQ(terms ? terms->size() : one->constants.size(), one->constants.size()) << one->id;
      }
  }
}

TEST(Havran, FindsTheConstantsThatAreThere) {
  const Held held(report_by_law(havrans_law), "havran");
  EXPECT_THAT(values(held.fit().constants.at("all")),
              ElementsAre(DoubleNear(8, 1e-6), DoubleNear(3, 1e-6), DoubleNear(20, 1e-6)));
  EXPECT_EQ(held.verdict().predicted, 30u);
  EXPECT_LT(*held.verdict().max_error, 1e-6);
  // Equal times are told apart by the rounding of their predictions.
  EXPECT_GT(*held.verdict().spearman, 0.999);
  EXPECT_GT(*held.verdict().kendall, 0.99);
  EXPECT_GT(*held.verdict().spearman_within, 0.99);
  EXPECT_EQ(held.verdict().in_words(), "predicts times");
}

/// A step that costs from 1 to 5 ns, by technique: one set of constants does not do.
TEST(HavranByTechnique, FindsTheConstantsOfEveryTechnique) {
  const auto law = [](const report::Scene&, const Measurement& cell, double technique) {
    return 8 * rate(cell, &report::Work::object_tests) + (1 + technique) * rate(cell, &report::Work::steps) +
           20;
  };
  const Held apart(report_by_law(law), "havran_by_technique"), together(report_by_law(law), "havran");
  EXPECT_THAT(values(apart.fit().constants.at("technique4")),
              ElementsAre(DoubleNear(8, 1e-6), DoubleNear(5, 1e-6), DoubleNear(20, 1e-6)));
  EXPECT_LT(*apart.verdict().max_error, 1e-6);
  EXPECT_GT(*together.verdict().median_error, 0.01);
}

TEST(CountedWork, FindsPricesThatAllShareAndThoseOfATechnique) {
  // Scenes of an odd number have chords, which are incoherent; where no kinds are told, they are those of the scene.
  const auto law = [](const report::Scene& scene, const Measurement& cell, double technique) {
    const double incoherent = (scene.id.back() - '0') % 2;
    const double triangles = cell.tested_kinds ? 0.5 + 5 * 0.25 + 0.25 * (1 + 0.04 * 12)
                                               : (static_cast<double>(scene.counts.at("triangle")) +
                                                  4.0 / 3 * static_cast<double>(scene.counts.at("sphere"))) /
                                                     100;
    const double empty = rate(cell, &report::Work::empty_cells);
    return (6 + 3 * incoherent) * triangles * rate(cell, &report::Work::object_tests) +
           4 * (rate(cell, &report::Work::cells) - empty) + 2 * empty +
           (1 + technique + 0.5 * incoherent) * rate(cell, &report::Work::steps) +
           7 * rate(cell, &report::Work::volume_tests) + 10 * technique;
  };
  for (const bool told : {false, true}) {
    Report report = report_by_law(law);
    for (std::size_t i = 0; told && i < report.measurements.size(); ++i) {
      Measurement& cell = report.measurements[i];
      cell.tested_kinds = report::TestedKinds{0.5, 0.25, 0, 0.25, 0.25 * 12};
      cell.trace_ns = {100 * law(report.scenes[i / 5], cell, static_cast<double>(i % 5))};
    }
    const Held held(std::move(report), "counted_work");
    const auto& shared = held.fit().constants.at("all");
    EXPECT_THAT(shared[0], Optional(DoubleNear(6, 1e-4))) << "triangle";
    EXPECT_THAT(shared[1], Optional(DoubleNear(3, 1e-4))) << "incoherent triangle";
    EXPECT_THAT(shared[2], Optional(DoubleNear(0.5, 1e-4))) << "incoherent step";
    EXPECT_THAT(shared[3], Optional(DoubleNear(4, 1e-4))) << "full cell";
    EXPECT_FALSE(shared[5]) << "a step has no price that all share";
    EXPECT_THAT(held.fit().constants.at("technique3")[5], Optional(DoubleNear(4, 1e-4))) << "step";
    EXPECT_THAT(held.fit().constants.at("technique1")[6], Optional(DoubleNear(7, 1e-4))) << "volume";
    EXPECT_LT(*held.verdict().max_error, 1e-4);
  }
}

TEST(Equations, SpeakOfHierarchiesAlone) {
  const auto law = [](const report::Scene&, const Measurement& cell, double) {
    return 5 * rate(cell, &report::Work::volume_tests) + 9 * rate(cell, &report::Work::object_tests);
  };
  const Held counted_tests(report_by_law(law), "equation_1");
  EXPECT_THAT(values(counted_tests.fit().constants.at("all")),
              ElementsAre(DoubleNear(5, 1e-6), DoubleNear(9, 1e-6)));
  EXPECT_EQ(counted_tests.verdict().predicted, 12u);
  EXPECT_EQ(counted_tests.fit().silent, 18u);
  const auto expected_law = [](const report::Scene&, const Measurement& cell, double) {
    return cell.predicted
               ? 2 * cell.predicted->volume_tests_per_ray + 3 * cell.predicted->object_tests_per_ray
               : 1;
  };
  const Held expected_tests(report_by_law(expected_law), "equation_3");
  EXPECT_THAT(values(expected_tests.fit().constants.at("all")),
              ElementsAre(DoubleNear(2, 1e-6), DoubleNear(3, 1e-6)));
}

/// M = 0.02 + 0.01 (s + t) of 100 objects.
TEST(Candidates, PricesM) {
  const auto law = [](const report::Scene&, const Measurement& cell, double) {
    return 7 * 100 * cell.efficiency->m + 11;
  };
  const Held held(report_by_law(law), "candidates");
  EXPECT_THAT(values(held.fit().constants.at("all")), ElementsAre(DoubleNear(7, 1e-6), DoubleNear(11, 1e-6)));
}

/// A scene that is twice as slow as the others say is predicted by the others: by half of its time.
TEST(Validation, PredictsASceneWithoutItsOwnTimes) {
  Report report = report_by_law(havrans_law);
  for (Measurement& cell : report.measurements)
    if (cell.scene == "scene2")
      for (double& time : cell.trace_ns) time *= 2;
  const Held held(std::move(report), "havran");
  for (const ModelCell& cell : held.fit().cells)
    if (cell.group->scene_id == "scene2") {
      EXPECT_NEAR(*cell.predicted / cell.measured, 0.5, 1e-6);
    }
  const auto tables = validation_tables(held.validation, true);
  EXPECT_NEAR(number_in(tables.at(1), "scene2", "havran_float"), -0.5, 1e-6);
  EXPECT_GT(number_in(tables.at(1), "scene1", "havran_float"), 0)
      << "the slow scene raises what others are expected to take";
  EXPECT_NEAR(find_cell(tables.at(0), "havran, float", "max_error_percent").number.value(), 50, 1e-4);
  EXPECT_THAT(row_names(tables.at(2)), ElementsAre("chords", "whitted"));
  EXPECT_THAT(tables.back().rows, SizeIs(30)) << "every cell";
}

/// What has eleven times the steps of all other scenes is beyond what they say.
TEST(Validation, IsSilentFarFromWhatWasMeasured) {
  Report report = report_by_law(havrans_law);
  report.measurements[7].work->steps = 20000;
  const Held held(std::move(report), "havran");
  EXPECT_EQ(held.fit().silent, 1u);
  EXPECT_EQ(held.verdict().predicted, 29u);
}

TEST(Validation, LeavesOutBaselinesAndWhatIsWrong) {
  Report report = report_by_law(havrans_law);
  report.measurements[0].technique = kZeroOverhead;
  report.measurements[1].technique = "embree_user";
  report.measurements[2].verdict.status = report::Status::graded;
  report.measurements[3].work.reset();
  report.measurements[4].trace_ns.clear();
  EXPECT_THAT(Held(std::move(report), "havran").fit().cells, SizeIs(25));
}

TEST(Validation, FailsWhereABoundIsNotKept) {
  const auto law = [](const report::Scene& scene, const Measurement& cell, double technique) {
    return havrans_law(scene, cell, technique) * (1 + 0.3 * technique);
  };
  EXPECT_TRUE(Held(report_by_law(law), "havran").validation.holds());
  EXPECT_TRUE(
      Held(report_by_law(law), "havran", {.max_median_error = 0.9, .min_spearman = 0}).validation.holds());
  const Held inexact(report_by_law(law), "havran", {.max_median_error = 0.001});
  EXPECT_FALSE(inexact.validation.holds());
  EXPECT_THAT(inexact.verdict().failures, ElementsAre("median error above 0.100 %"));
  const Held disordered(report_by_law(law), "havran", {.min_spearman = 1});
  EXPECT_THAT(disordered.verdict().failures, ElementsAre("Spearman below 1.00"));
  EXPECT_THAT(
      find_cell(validation_tables(disordered.validation, false).at(0), "havran, float", "verdict").text,
      HasSubstr("FAILS: Spearman below 1.00"));
}

/// Havran's law, which its model finds: all points lie on the line of equality.
TEST(ModelTime, ShowsTheModelThatErrsLeast) {
  const Report report = report_by_law(havrans_law);
  const std::vector<Group> all = groups(report);
  const PlotSet set =
      model_time_plots(all, judged(fit_models(all, {cost_models().begin(), cost_models().end()}), {}));
  ASSERT_THAT(set.plots, SizeIs(1));
  EXPECT_THAT(set.plots[0].title, HasSubstr("havran"));
  std::smatch line;
  const std::string& svg = set.plots[0].svg;
  ASSERT_TRUE(
      std::regex_search(svg, line, std::regex("reference\" d=\"M([0-9.]+) ([0-9.]+)L([0-9.]+) ([0-9.]+)\"")));
  const double x0 = std::stod(line[1]), y0 = std::stod(line[2]), x1 = std::stod(line[3]),
               y1 = std::stod(line[4]);
  const std::regex circle("cx=\"([0-9.]+)\" cy=\"([0-9.]+)\"");
  std::size_t points = 0;
  for (std::sregex_iterator match(svg.begin(), svg.end(), circle), end; match != end; ++match) {
    const double x = std::stod((*match)[1]), y = std::stod((*match)[2]);
    if (y > y0 + 30) continue;  // the legend
    ++points;
    EXPECT_NEAR(y0 + (x - x0) / (x1 - x0) * (y1 - y0), y, 0.3);
  }
  EXPECT_EQ(points, 30u);
}

/// One cause at a time is planted into a model's predictions: a scene, its odd rays, a technique, one cell.
TEST(FarCells, NameTheAssumptionThatFails) {
  const auto fails = [](const std::function<bool(const Measurement&, std::size_t)>& planted) {
    const Report report = report_by_law(havrans_law);
    std::vector<Group> all = groups(report);
    std::vector<ModelFit> fits = fit_models(all, {&model("havran")});
    // Every other ray set becomes a second one of the scene before it.
    for (std::size_t i = 1; i < all.size(); i += 2) all[i].scene_id = all[i - 1].scene_id;
    for (std::size_t i = 0; i < fits[0].cells.size(); ++i) {
      ModelCell& cell = fits[0].cells[i];
      cell.predicted = cell.measured * (planted(*cell.entry->measurement, i) ? 1.5 : 1.01);
    }
    std::map<Assumption, int> counts;
    for (const FarCell& far : far_cells(fits[0])) {
      EXPECT_NEAR(far.error, 0.5, 1e-9);
      EXPECT_NEAR(far.of_scene + far.of_rays + far.of_technique + far.rest, std::log(1.5), 1e-9);
      ++counts[far.assumption()];
    }
    const auto tables = far_cells_tables(fits, true);
    EXPECT_THAT(tables, SizeIs(counts.empty() ? 0 : 2));
    if (!tables.empty()) {
      EXPECT_EQ(number_in(tables[0], "havran, float", "cells"), 30);
      EXPECT_EQ(number_in(tables[0], "havran, float", "far_off"), static_cast<double>(tables[1].rows.size()));
    }
    return counts;
  };
  using ::testing::Pair;
  EXPECT_THAT(fails([](const Measurement& cell, std::size_t) { return cell.scene <= "scene1"; }),
              ElementsAre(Pair(Assumption::scenes, 10)));
  EXPECT_THAT(fails([](const Measurement& cell, std::size_t) { return cell.technique == "technique3"; }),
              ElementsAre(Pair(Assumption::technique, 6)));
  EXPECT_THAT(fails([](const Measurement&, std::size_t i) { return i == 17; }),
              ElementsAre(Pair(Assumption::counts, 1)));
  EXPECT_THAT(fails([](const Measurement&, std::size_t) { return false; }), IsEmpty());
}

/// On every third ray set of a scene all techniques are off.
TEST(FarCells, TellRaysFromScenes) {
  const Report report = report_by_law(havrans_law);
  std::vector<Group> all = groups(report);
  std::vector<ModelFit> fits = fit_models(all, {&model("havran")});
  for (std::size_t i = 0; i < all.size(); ++i) all[i].scene_id = all[i / 3 * 3].scene_id;
  for (ModelCell& cell : fits[0].cells)
    cell.predicted = cell.measured * (cell.group == &all[2] || cell.group == &all[5] ? 0.5 : 1.0);
  const std::vector<FarCell> far = far_cells(fits[0]);
  EXPECT_THAT(far, SizeIs(10));
  for (const FarCell& cell : far) EXPECT_EQ(cell.assumption(), Assumption::rays);
}

TEST(EndPointOverlap, PricesBothParts) {
  Report report = report_by_law(havrans_law);
  for (std::size_t i = 0; i < report.measurements.size(); ++i) {
    Measurement& cell = report.measurements[i];
    if (!cell.predicted) continue;
    const auto x = static_cast<double>(i);
    cell.end_point_overlap = report::EndPointOverlap{100, 0.1 * x, 10 / (1 + x)};
    const double sah = 0.6 * cell.predicted->volume_tests_per_ray + cell.predicted->object_tests_per_ray,
                 overlap = 0.6 * cell.end_point_overlap->volume_tests_per_point +
                           cell.end_point_overlap->object_tests_per_point;
    cell.trace_ns = {100 * (3 * sah + 2 * overlap)};
  }
  const Held held(std::move(report), "end_point_overlap");
  EXPECT_EQ(held.verdict().predicted, 12u);
  EXPECT_EQ(held.fit().silent, 18u);
  for (const char* technique : {"technique0", "technique1"})
    EXPECT_THAT(values(held.fit().constants.at(technique)),
                ElementsAre(DoubleNear(3, 1e-6), DoubleNear(2, 1e-6)));
}

/// One scene has no other to be predicted from: a bound that cannot be checked is not kept.
TEST(Validation, FailsWhereNothingCouldBePredicted) {
  Report report = report_by_law(havrans_law);
  report.measurements.resize(5);
  const Held held(std::move(report), "havran", {.max_median_error = 10});
  EXPECT_EQ(held.verdict().predicted, 0u);
  EXPECT_FALSE(held.validation.holds());
  const Report nothing;
  const std::vector<Group> none = groups(nothing);
  EXPECT_THROW(validate(none, {&model("havran")}, {}), report::ReportError);
}

}  // namespace
}  // namespace rayshoot::analysis
