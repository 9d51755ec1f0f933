// Model      T = C n M + C_0
// Idea       A ray costs as much as it has candidates: M is the share of the n objects that an optimizer leaves to be
//            tested, each once.
// Source     Revelles & Ureña's formalization, equation (21); they measure optimizers by M and leave time aside
// Constants  C, a candidate; C_0, a ray.
// Weak when  Objects are tested more than once, and wherever `intersections` is.
#include "analysis/cost_models/cost_model.h"

namespace rayshoot {

const analysis::CostModel& cost_model_candidates() {
  using namespace analysis;
  static const CostModel model{
      .id = "candidates",
      .title = "Revelles and Ureña's M",
      .formula = "T = C n M + C_0",
      .source = "Revelles & Ureña, equation (21)",
      .assumptions = "a candidate is tested once, and finding it costs as much for every ray",
      .constants = {{"C"}, {"C_0"}},
      .terms = [](const Group& group, const Entry& entry) -> std::optional<std::vector<double>> {
        const auto& efficiency = entry.measurement->efficiency;
        if (!efficiency || !group.scene) return std::nullopt;
        return std::vector{efficiency->m * static_cast<double>(group.scene->objects), 1.0};
      }};
  return model;
}

}  // namespace rayshoot
