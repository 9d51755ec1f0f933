// Model      T = B E[n] + I E[m], the expected numbers of tests from how the actual rays run
// Idea       Equation (3) takes the chance that a ray meets a volume from its surface area, which is right for uniform rays. Here it
//            is the share of a sample of the actual rays that meet it: the sum over all volumes is the mean work of a search
//            that no hit ends.
// Source     equation (3) of Arvo & Kirk's survey without its first assumption, that rays are uniformly distributed
// Constants  B and I as in equation (1).
// Weak when  Objects occlude each other. The sample, of one ray in four or fewer, has an error of its own.
#include "analysis/cost_models/cost_model.h"

namespace rayshoot {

namespace {

std::optional<report::Predicted> expected(const report::Measurement& measurement) {
  const auto& sampled = measurement.sampled_prediction;
  return sampled ? std::optional(sampled->unoccluded) : std::nullopt;
}

}  // namespace

const analysis::CostModel& cost_model_equation_3_by_rays() {
  using namespace analysis;
  static const CostModel model{
      .id = "equation_3_by_rays",
      .title = "equation (3) with the chances of the actual rays",
      .formula = "T = B E[n] + I E[m]",
      .source = "this project, after Goldsmith & Salmon 1987",
      .assumptions = "nothing occludes",
      .constants = {{"B"}, {"I"}},
      .terms = [](const Group&, const Entry& entry) { return test_terms(expected(*entry.measurement)); },
      .tests = ExpectedTests{"rays", expected, true}};
  return model;
}

}  // namespace rayshoot
