#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "analysis/cost_models/pooled_prices.h"
#include "analysis/cost_models/verdicts.h"

namespace rayshoot::analysis {
namespace {

using report::Measurement;
using report::Report;
using ::testing::AllOf;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::Gt;
using ::testing::Lt;
using ::testing::Optional;
using ::testing::SizeIs;

constexpr std::uint64_t kRays = 100, kScenes = 8, kTechniques = 4;

/// An amount per ray that differs from cell to cell, in no order.
std::uint64_t amount(std::uint64_t scene, std::uint64_t technique, std::uint64_t which) {
  return 100 + (7919 * (scene + 1) * (which + 3) + 104729 * (technique + 1) * (which + 1)) % 1900;
}

/// What a ray of a technique costs: steps cost from 2 to 8 ns, and all prices are half as much again for chords.
double law(const Measurement& cell, double technique, bool incoherent) {
  const report::TestedKinds& kinds = *cell.tested_kinds;
  const auto rate = [&](std::uint64_t count) { return static_cast<double>(count) / kRays; };
  const double tests = rate(cell.work->object_tests);
  return (incoherent ? 1.5 : 1) *
         (tests * (5 * kinds.triangles + 9 * kinds.spheres + 30 * kinds.cones + 12 * kinds.polygons +
                   0.5 * kinds.polygon_vertices) +
          7 * rate(cell.work->cells - cell.work->empty_cells) + 1.5 * rate(cell.work->empty_cells) +
          (2 + 2 * technique) * rate(cell.work->steps) + 3 * rate(cell.work->volume_tests) + 20);
}

/// Scenes of all kinds of objects, coherent and incoherent rays in each, and times that follow the law.
Report report_by_law() {
  Report report;
  for (std::uint64_t s = 0; s < kScenes; ++s) {
    const std::string scene = fmt::format("scene{}", s);
    report.scenes.push_back({.id = scene, .objects = 100, .counts = {{"triangle", 100}}});
    for (const std::string rays : {"primary", "chords"}) {
      report.ray_sets.push_back(
          {.id = fmt::format("{}/{}", scene, rays), .scene = scene, .distribution = rays, .rays = kRays});
      for (std::uint64_t t = 0; t < kTechniques; ++t) {
        Measurement cell{.scene = scene,
                         .rays = report.ray_sets.back().id,
                         .technique = fmt::format("technique{}", t),
                         .scalar = "float"};
        const std::uint64_t r = rays == "chords", cells = amount(s, t, 5 + r);
        cell.work = report::Work{.rays = kRays,
                                 .object_tests = amount(s, t, 1 + r),
                                 .distinct_objects = 100,
                                 .volume_tests = amount(s, t, 9 + r),
                                 .steps = amount(s, t, 3 + r),
                                 .cells = cells,
                                 .empty_cells = cells * (1 + s) / 10};
        const double first = 0.1 * static_cast<double>(s), cones = 0.05 * static_cast<double>(t);
        cell.tested_kinds =
            report::TestedKinds{first, 0.2, 0.8 - first - cones, cones, static_cast<double>(1 + (s + t) % 5)};
        cell.trace_ns = {kRays * law(cell, static_cast<double>(t), r == 1)};
        report.measurements.push_back(std::move(cell));
      }
    }
  }
  return report;
}

const CostModel& pooled_work() {
  for (const CostModel* model : cost_models())
    if (model->id == "pooled_work") return *model;
  throw std::out_of_range("pooled_work");
}

TEST(PooledWork, FindsPricesOfTechniquesAndWhatIncoherentRaysCostMore) {
  const Report report = report_by_law();
  const std::vector<Group> all = groups(report);
  const Validation validation = validate(all, {&pooled_work()}, {});
  const ModelFit& fit = validation.fits.at(0);
  EXPECT_EQ(fit.silent, 0u);
  EXPECT_THAT(fit.cells, SizeIs(2 * kScenes * kTechniques));
  EXPECT_LT(*validation.verdicts.at(0).median_error, 0.05)
      << "pooled techniques are drawn towards each other";
  // Steps are told apart, in their order, and drawn a little towards what all have in common.
  constexpr std::size_t kStep = 7;
  for (const auto& [technique, lower, upper] :
       {std::tuple{"technique0", 1.8, 3.6}, {"technique1", 3.3, 4.5}, {"technique3", 4.5, 8.2}})
    EXPECT_THAT(fit.constants.at(technique)[kStep], Optional(AllOf(Gt(lower), Lt(upper)))) << technique;
  EXPECT_FALSE(fit.constants.at("technique3")[2]) << "a vertex has one price";
  // All prices are half as much again, that of the dearest best known.
  constexpr std::size_t kCone = 4;
  EXPECT_NEAR(*fit.constants.at("all, incoherent")[kCone] / *fit.constants.at("all")[kCone], 1.5, 0.2);
}

/// A technique that nobody timed elsewhere has the prices of all: it is predicted, and so is a scene far from all others.
TEST(PooledWork, IsNeverSilent) {
  Report report = report_by_law();
  for (Measurement& cell : report.measurements)
    if (cell.scene == "scene3") {
      if (cell.technique == "technique2") cell.technique = "stranger";
      cell.work->steps *= 100;
    }
  const std::vector<Group> all = groups(report);
  const ModelFit fit = fit_models(all, {&pooled_work()}).at(0);
  EXPECT_EQ(fit.silent, 0u);
  for (const ModelCell& cell : fit.cells) {
    ASSERT_TRUE(cell.predicted);
    EXPECT_GT(*cell.predicted, 0);
  }
}

/// One scene is not predicted from itself.
TEST(PooledWork, DoesNotPredictASceneFromItself) {
  Report report = report_by_law();
  std::erase_if(report.measurements, [](const Measurement& cell) { return cell.scene != "scene0"; });
  const std::vector<Group> all = groups(report);
  const ModelFit fit = fit_models(all, {&pooled_work()}).at(0);
  EXPECT_EQ(fit.silent, fit.cells.size());
}

/// A scene in which all takes twice as long is still predicted as the others say.
TEST(PooledWork, KnowsNothingOfTheScenePredicted) {
  Report report = report_by_law();
  const auto predictions = [&] {
    const std::vector<Group> all = groups(report);
    std::map<std::pair<std::string, std::string>, double> predicted;
    const ModelFit fit = fit_models(all, {&pooled_work()}).at(0);
    for (const ModelCell& cell : fit.cells)
      if (cell.group->scene_id == "scene5")
        predicted[{cell.group->rays_id, cell.entry->label}] = cell.predicted.value();
    return predicted;
  };
  const auto before = predictions();
  for (Measurement& cell : report.measurements)
    if (cell.scene == "scene5")
      for (double& time : cell.trace_ns) time *= 2;
  EXPECT_THAT(before, SizeIs(2 * kTechniques));
  EXPECT_EQ(predictions(), before);
}

/// The unknowns of two constants, a circumstance and two techniques, of which the second constant has none of its own.
TEST(PooledPrices, AreProductsOfWhatIsCommonAndWhatIsNot) {
  const CostModel model{.constants = {{"a", true, {4, 0.5, 2}}, {"b", false, {1, 0.25}}},
                        .pooling = Pooling{.circumstances = {"wild"}, .indifferent = 0.125}};
  const PooledPrices prices(model, {"one", "two"});
  std::vector<double> values, weights;
  for (const Belief& belief : prices.beliefs())
    values.push_back(belief.value), weights.push_back(belief.weight);
  EXPECT_THAT(values, ElementsAre(DoubleNear(std::log(4), 1e-12), 0, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(weights, ElementsAre(0.5, 0.25, 0.125, 0.125, 2, 0.3, 2, 0.3));
  const std::vector<double> unknowns{0.1, 0.2, 0.3, 0.4, 0.5, 100, 0.7, 100};
  EXPECT_DOUBLE_EQ(value_of(prices.sum_of({"two", {3, 5}, {0.5}}), unknowns),
                   3 * std::exp(0.1 + 0.15 + 0.7) + 5 * std::exp(0.2 + 0.2));
  EXPECT_DOUBLE_EQ(value_of(prices.sum_of({"three", {3, 5}, {0}}), unknowns),
                   3 * std::exp(0.1) + 5 * std::exp(0.2));
  EXPECT_THAT(
      prices.constants("one", {1}, unknowns),
      ElementsAre(DoubleNear(std::exp(0.1 + 0.3 + 0.5), 1e-12), DoubleNear(std::exp(0.2 + 0.4), 1e-12)));
}

}  // namespace
}  // namespace rayshoot::analysis
