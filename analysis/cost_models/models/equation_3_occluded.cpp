// Model      T = B E[n] + I E[m], the expected numbers of tests from how the actual rays run up to their nearest hits
// Idea       A volume is entered by those of a sample of rays that meet it no farther away than their nearest hit. The hits are
//            known of scene and rays, whatever technique is to find them.
// Source     equation (3) of Arvo & Kirk's survey without the assumptions that the survey names: uniform rays, no occlusion
// Constants  B and I as in equation (1).
// Weak when  A search meets other volumes before it finds the nearest hit, because volumes overlap or are not visited near to
//            far; and for rays that ask for any hit, which end at the first that is found, not at the nearest.
#include "analysis/cost_models/cost_model.h"

namespace rayshoot {

namespace {

std::optional<report::Predicted> expected(const report::Measurement& measurement) {
  const auto& sampled = measurement.sampled_prediction;
  return sampled ? std::optional(sampled->occluded) : std::nullopt;
}

}  // namespace

const analysis::CostModel& cost_model_equation_3_occluded() {
  using namespace analysis;
  static const CostModel model{
      .id = "equation_3_occluded",
      .title = "equation (3) with the chances of the actual rays up to their nearest hits",
      .formula = "T = B E[n] + I E[m]",
      .source = "this project, after Goldsmith & Salmon 1987",
      .assumptions =
          "a search knows the nearest hit before it begins, which it does not where volumes overlap or are "
          "visited in no order of distance; rays that ask for any hit end at the first that is found",
      .constants = {{"B"}, {"I"}},
      .terms = [](const Group&, const Entry& entry) { return test_terms(expected(*entry.measurement)); },
      .tests = ExpectedTests{"occluded", expected, true}};
  return model;
}

}  // namespace rayshoot
