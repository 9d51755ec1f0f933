// Model      T = I N + C_full N_full + C_empty N_empty + C_TS N_TS + B N_volumes + C_0, and for incoherent rays besides
//            I' N + C'_TS N_TS
// Idea       Everything that is counted has a price. An object costs the same whatever technique tests it, and so does a cell whose
//            list of objects is looked at; a step, a volume and a ray cost what they cost in this technique. Where neighbouring
//            rays have nothing to do with each other, a processor guesses branches badly and finds little in its caches: then
//            tests and steps cost more, in all techniques alike.
// Source     that of `havran`, with all counts of a report
// Constants  I of a triangle, C_full and C_empty of cells, I' and C'_TS, shared; C_TS, B and C_0 of every technique. The prices
//            of other kinds are multiples of a triangle's, from results/reports/chooser-fit.json: a sphere 4/3, a cone 5, a
//            polygon 1 and 0.04 for every vertex. Prices of their own, fitted, would be unknown where a kind is in no
//            other scene.
// Weak when  Structures do not fit the caches. Exhaustive search is far from it: a test in a long loop costs a
//            fraction of one at the end of a search.
#include "analysis/cost_models/tested_objects.h"

namespace rayshoot {

namespace {

using analysis::counted, analysis::incoherent, report::Work;

constexpr double kPolygon = 1, kVertex = 0.04, kSphere = 4.0 / 3, kCone = 5;

/// Object tests, in triangles.
double priced_tests(const report::Scene& scene, const analysis::Entry& entry) {
  const report::TestedKinds kinds = analysis::tested_kinds(scene, entry);
  return counted(entry, &Work::object_tests) *
         (kinds.triangles + kPolygon * kinds.polygons + kVertex * kinds.polygon_vertices +
          kSphere * kinds.spheres + kCone * kinds.cones);
}

std::optional<std::vector<double>> terms(const analysis::Group& group, const analysis::Entry& entry) {
  const double steps = counted(entry, &Work::steps), volumes = counted(entry, &Work::volume_tests);
  if (!group.scene || group.scene->objects == 0 || steps + volumes == 0) return std::nullopt;
  const double tests = priced_tests(*group.scene, entry), empty = counted(entry, &Work::empty_cells);
  const double chance = incoherent(group) ? 1 : 0;
  return std::vector{tests, tests * chance, steps * chance, counted(entry, &Work::cells) - empty,
                     empty, steps,          volumes,        1.0};
}

}  // namespace

const analysis::CostModel& cost_model_counted_work() {
  static const analysis::CostModel model{
      .id = "counted_work",
      .title = "all that is counted",
      .formula = "T = (I + I') N + C_full N_full + C_empty N_empty + (C_TS + C'_TS) N_TS + B N_volumes + C_0",
      .source = "this project, after Havran",
      .assumptions =
          "an object test costs as much in all techniques, a cone five times what a triangle does, and "
          "what incoherent rays cost more is the same for all steps and for all tests",
      .constants =
          {{"I"}, {"I'"}, {"C'_TS"}, {"C_full"}, {"C_empty"}, {"C_TS", true}, {"B", true}, {"C_0", true}},
      .terms = terms};
  return model;
}

}  // namespace rayshoot
