// Model      T = B E[n] + I E[m], the expected numbers of tests from surface areas
// Idea       A ray that hits the root of a hierarchy hits a node inside with the chance S(node) / S(root), so the tests
//            can be expected before a ray is shot.
// Source     Goldsmith & Salmon 1987; equation (3) of Arvo & Kirk's survey
// Constants  B and I as in equation (1).
// Weak when  Rays are not uniformly distributed, and where objects occlude each other: a nearest hit ends a search
//            that the equation carries on.
#include "analysis/cost_models/cost_model.h"

namespace rayshoot {

const analysis::CostModel& cost_model_equation_3() {
  using namespace analysis;
  static const CostModel model{
      .id = "equation_3",
      .title = "equation (3), tests expected",
      .formula = "T = B E[n] + I E[m]",
      .source = "Goldsmith & Salmon 1987",
      .assumptions = "rays are uniformly distributed and nothing occludes",
      .constants = {{"B"}, {"I"}},
      .terms = [](const Group&, const Entry& entry) -> std::optional<std::vector<double>> {
        const auto& predicted = entry.measurement->predicted;
        if (!predicted) return std::nullopt;
        return std::vector{predicted->volume_tests_per_ray, predicted->object_tests_per_ray};
      },
      .tests = ExpectedTests{
          "areas", [](const report::Measurement& measurement) -> std::optional<report::Predicted> {
            // Without volumes there is no hierarchy that it speaks of.
            const auto& predicted = measurement.predicted;
            return predicted && predicted->volume_tests_per_ray > 0 ? predicted : std::nullopt;
          }}};
  return model;
}

}  // namespace rayshoot
