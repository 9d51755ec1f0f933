// Model      T = sum I_k N_k + C_full N_full + C_empty N_empty + C_TS N_TS + B N_volumes + C_0
// Idea       Everything that is counted has a price. An object of a kind costs the same whatever technique tests it, and so
//            does a cell whose list of objects is looked at; a step, a volume and a ray cost what they cost in this technique.
// Source     that of `havran`, with all counts of a report
// Constants  I of triangles, polygons, spheres and cones, C_full and C_empty of cells, shared; C_TS, B and C_0 of every
//            technique.
// Weak when  A kind of object is in no other scene, or objects are not tested in the proportions in which the scene has
//            their kinds: a report counts tests of all kinds together. Exhaustive search is far from it: a test in a
//            long loop costs a fraction of one at the end of a search.
#include "analysis/cost_models/cost_model.h"

namespace rayshoot {

namespace {

constexpr const char* kKinds[] = {"triangle", "polygon", "sphere", "cone"};

std::optional<std::vector<double>> terms(const analysis::Group& group, const analysis::Entry& entry) {
  using analysis::counted, report::Work;
  const double searched = counted(entry, &Work::steps) + counted(entry, &Work::volume_tests);
  if (!group.scene || group.scene->objects == 0 || searched == 0) return std::nullopt;
  std::vector<double> terms;
  for (const char* kind : kKinds) {
    const auto found = group.scene->counts.find(kind);
    const double objects = found == group.scene->counts.end() ? 0 : static_cast<double>(found->second);
    terms.push_back(counted(entry, &Work::object_tests) * objects /
                    static_cast<double>(group.scene->objects));
  }
  const double empty = counted(entry, &Work::empty_cells);
  terms.insert(terms.end(), {counted(entry, &Work::cells) - empty, empty, counted(entry, &Work::steps),
                             counted(entry, &Work::volume_tests), 1});
  return terms;
}

}  // namespace

const analysis::CostModel& cost_model_counted_work() {
  static const analysis::CostModel model{
      .id = "counted_work",
      .title = "all that is counted",
      .formula = "T = sum I_k N_k + C_full N_full + C_empty N_empty + C_TS N_TS + B N_volumes + C_0",
      .source = "this project, after Havran",
      .assumptions =
          "kinds of objects are tested in the proportions in which the scene has them, for a price that all "
          "techniques share",
      .constants = {{"I_triangle"},
                    {"I_polygon"},
                    {"I_sphere"},
                    {"I_cone"},
                    {"C_full"},
                    {"C_empty"},
                    {"C_TS", true},
                    {"B", true},
                    {"C_0", true}},
      .terms = terms};
  return model;
}

}  // namespace rayshoot
