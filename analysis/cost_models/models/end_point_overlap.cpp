// Model      T = N ((1 - a) SAH + a EPO)
// Idea       Equation (3) is about rays that pass by. A ray also ends somewhere, and there it is inside of every volume about that
//            point, of which those are in vain that the object of the point is not in. Overlap there is what makes trees of equal
//            expected cost unequal.
// Source     Aila, Karras & Laine 2013, with their costs: 1.2 for the two volumes of a node, 1 for an object
// Constants  N (1 - a) and N a of every technique, each 0 or more: a, which the authors fit scene by scene, is their share.
// Weak when  Rays seldom end in the scene, or see only a part of its surfaces; and where the order of a search costs more than
//            its volumes.
#include "analysis/cost_models/cost_model.h"

namespace rayshoot {

namespace {

constexpr double kVolumeTest = 0.6, kObjectTest = 1;

}  // namespace

const analysis::CostModel& cost_model_end_point_overlap() {
  using namespace analysis;
  static const CostModel model{
      .id = "end_point_overlap",
      .title = "equation (3) and end-point overlap",
      .formula = "T = N ((1 - a) SAH + a EPO)",
      .source = "Aila, Karras & Laine 2013",
      .assumptions =
          "rays are uniformly distributed, end anywhere on the surfaces, and a test of a technique costs as "
          "much in every scene",
      .constants = {{"N(1-a)", true}, {"N a", true}},
      .terms = [](const Group&, const Entry& entry) -> std::optional<std::vector<double>> {
        const auto& predicted = entry.measurement->predicted;
        const auto& overlap = entry.measurement->end_point_overlap;
        if (!predicted || !overlap) return std::nullopt;
        const auto cost = [](double volumes, double objects) {
          return kVolumeTest * volumes + kObjectTest * objects;
        };
        return std::vector{cost(predicted->volume_tests_per_ray, predicted->object_tests_per_ray),
                           cost(overlap->volume_tests_per_point, overlap->object_tests_per_point)};
      }};
  return model;
}

}  // namespace rayshoot
