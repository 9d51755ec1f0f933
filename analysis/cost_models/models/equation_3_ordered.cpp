// Model      T = B E[n] + I E[m], the expected numbers of tests from how the actual rays run, in the order of the search
// Idea       Of a sample of rays all hits are known, whatever technique is to find them. A volume is entered by those rays that
//            no hit has ended, or shortened to before it, when the search comes to it.
// Source     equation (3) of Arvo & Kirk's survey, with occlusion in the order in which a technique visits its volumes
// Constants  B and I as in equation (1).
// Weak when  The sample is small. For the rays in it there is no error, so this says what the sample is worth, and beside
//            `equation_3_occluded` what the order costs.
#include "analysis/cost_models/cost_model.h"

namespace rayshoot {

namespace {

std::optional<report::Predicted> expected(const report::Measurement& measurement) {
  const auto& sampled = measurement.sampled_prediction;
  return sampled ? std::optional(sampled->ordered) : std::nullopt;
}

}  // namespace

const analysis::CostModel& cost_model_equation_3_ordered() {
  using namespace analysis;
  static const CostModel model{
      .id = "equation_3_ordered",
      .title = "equation (3) with the chances of the actual rays in the order of the search",
      .formula = "T = B E[n] + I E[m]",
      .source = "this project, after Goldsmith & Salmon 1987",
      .assumptions = "the sampled rays, of which all hits are known, are like the others",
      .constants = {{"B"}, {"I"}},
      .terms = [](const Group&, const Entry& entry) { return test_terms(expected(*entry.measurement)); },
      .tests = ExpectedTests{"ordered", expected, true}};
  return model;
}

}  // namespace rayshoot
