// Model      T = C_IT N_IT + C_TS N_TS + C_0, for every technique apart
// Idea       That of `havran`, where a step costs what it costs in this technique.
// Source     Havran 2000, who fits the constants to the implementation at hand
// Constants  C_IT, C_TS and C_0 of every technique.
// Weak when  Objects of several kinds are tested, and where few scenes were measured: three constants need more than three.
#include "analysis/cost_models/cost_model.h"

namespace rayshoot {

const analysis::CostModel& cost_model_havran_by_technique() {
  using namespace analysis;
  static const CostModel model{.id = "havran_by_technique",
                               .title = "Havran's model, constants of every technique",
                               .formula = "T = C_IT N_IT + C_TS N_TS + C_0",
                               .source = "Havran & Sixta 1999",
                               .assumptions = "a test and a step of a technique cost as much in every scene",
                               .constants = {{"C_IT", true}, {"C_TS", true}, {"C_0", true}},
                               .terms = [](const Group&, const Entry& entry) {
                                 return std::optional(std::vector{counted(entry, &report::Work::object_tests),
                                                                  counted(entry, &report::Work::steps), 1.0});
                               }};
  return model;
}

}  // namespace rayshoot
