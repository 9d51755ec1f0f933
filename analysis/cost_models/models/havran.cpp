// Model      T = C_IT N_IT + C_TS N_TS + C_0
// Idea       A ray costs its ray-object tests, its steps from cell to cell or node to node, and what every ray costs.
// Source     Havran & Sixta 1999, Havran 2000: T_R = N_rays (C_IT N_IT + C_TS N_TS) + T_app
// Constants  C_IT, C_TS and C_0, the same for all techniques.
// Weak when  A step of one technique is dearer than a step of another, as they mostly are, and where volumes are tested
//            in a step: those tests are taken for steps as good as any.
#include "analysis/cost_models/cost_model.h"

namespace rayshoot {

const analysis::CostModel& cost_model_havran() {
  using namespace analysis;
  static const CostModel model{.id = "havran",
                               .title = "Havran's model, one set of constants",
                               .formula = "T = C_IT N_IT + C_TS N_TS + C_0",
                               .source = "Havran & Sixta 1999",
                               .assumptions = "a test and a step cost as much in every technique",
                               .constants = {{"C_IT"}, {"C_TS"}, {"C_0"}},
                               .terms = [](const Group&, const Entry& entry) {
                                 return std::optional(std::vector{counted(entry, &report::Work::object_tests),
                                                                  counted(entry, &report::Work::steps), 1.0});
                               }};
  return model;
}

}  // namespace rayshoot
