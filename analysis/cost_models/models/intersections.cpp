// Model      T = C_IT N_IT + C_0
// Idea       Only ray-object tests cost time; what it takes to find the objects is free, or the same for every ray.
// Source     what is left of the cost of ray tracing in Whitted 1980, who found three quarters of it in intersections
// Constants  C_IT, a ray-object test; C_0, a ray.
// Weak when  Techniques differ in how they find objects: it says that more dividing is always better.
#include "analysis/cost_models/cost_model.h"

namespace rayshoot {

const analysis::CostModel& cost_model_intersections() {
  using namespace analysis;
  static const CostModel model{
      .id = "intersections",
      .title = "ray-object tests alone",
      .formula = "T = C_IT N_IT + C_0",
      .source = "Whitted 1980",
      .assumptions = "finding the objects to test costs as much for every ray",
      .constants = {{"C_IT"}, {"C_0"}},
      .terms = [](const Group&, const Entry& entry) {
        return std::optional(std::vector{counted(entry, &report::Work::object_tests), 1.0});
      }};
  return model;
}

}  // namespace rayshoot
