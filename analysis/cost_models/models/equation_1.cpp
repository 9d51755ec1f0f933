// Model      T = B n + I m
// Idea       A hierarchy of bounding volumes costs the tests of its volumes and of the objects that they let through.
// Source     Weghorst, Hooper & Greenberg 1984; equation (1) of Arvo & Kirk's survey
// Constants  B, a ray-volume test, and I, a ray-object test, of all hierarchies.
// Weak when  Volumes or objects of several kinds are tested, whose costs differ; says nothing where no volume is tested.
#include "analysis/cost_models/cost_model.h"

namespace rayshoot {

const analysis::CostModel& cost_model_equation_1() {
  using namespace analysis;
  static const CostModel model{
      .id = "equation_1",
      .title = "equation (1), tests counted",
      .formula = "T = B n + I m",
      .source = "Weghorst, Hooper & Greenberg 1984",
      .assumptions = "all volumes cost one price, all objects another, and nothing else costs time",
      .constants = {{"B"}, {"I"}},
      .terms = [](const Group&, const Entry& entry) -> std::optional<std::vector<double>> {
        const double volumes = counted(entry, &report::Work::volume_tests);
        if (volumes == 0) return std::nullopt;
        return std::vector{volumes, counted(entry, &report::Work::object_tests)};
      }};
  return model;
}

}  // namespace rayshoot
