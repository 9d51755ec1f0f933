// Model      T = I_tri N_tri + I_pol N_pol + I_ver N_ver + I_sph N_sph + I_con N_con + C_full N_full + C_empty N_empty
//            + C_TS N_TS + B N_volumes + C_0, with other prices for incoherent rays
// Idea       That of `counted_work`, but nobody says beforehand which prices techniques share. The logarithm of a price is that of
//            all techniques plus what is this one's, and it costs the fit something to tell a technique from the others: where a
//            technique tested few objects of a kind, it pays what all pay. So objects of every kind get prices of their own,
//            and something is said of every cell.
// Source     that of `havran`, with all counts of a report; partial pooling after Gelman & Hill 2007, chapter 12
// Constants  Those of the formula, of every technique but for I_ver, of a vertex of a polygon; and by what each is multiplied
//            where neighbouring rays have nothing to do with each other, in all techniques alike. Guesses for objects are what
//            a test took by itself, of rays through random points of the object's box: a triangle 20 ns, a sphere 26, a cone
//            89, a polygon 48 and 2.5 for every vertex.
// Weak when  A kind of objects, or polygons of many vertices, are in one scene alone: without it they are priced by guesses.
#include "analysis/cost_models/tested_objects.h"

namespace rayshoot {

namespace {

using analysis::counted, report::Work;

std::optional<std::vector<double>> terms(const analysis::Group& group, const analysis::Entry& entry) {
  if (!group.scene || group.scene->objects == 0) return std::nullopt;
  const report::TestedKinds kinds = analysis::tested_kinds(*group.scene, entry);
  const double tests = counted(entry, &Work::object_tests), empty = counted(entry, &Work::empty_cells);
  return std::vector{tests * kinds.triangles,
                     tests * kinds.polygons,
                     tests * kinds.polygon_vertices,
                     tests * kinds.spheres,
                     tests * kinds.cones,
                     counted(entry, &Work::cells) - empty,
                     empty,
                     counted(entry, &Work::steps),
                     counted(entry, &Work::volume_tests),
                     1.0};
}

std::vector<double> circumstances(const analysis::Group& group, const analysis::Entry&) {
  return {analysis::incoherent(group) ? 1.0 : 0.0};
}

}  // namespace

const analysis::CostModel& cost_model_pooled_work() {
  static const analysis::CostModel model{
      .id = "pooled_work",
      .title = "all that is counted, techniques pooled",
      .formula =
          "T = I_tri N_tri + I_pol N_pol + I_ver N_ver + I_sph N_sph + I_con N_con + C_full N_full + "
          "C_empty N_empty + C_TS N_TS + B N_volumes + C_0",
      .source = "this project, after Havran; Gelman & Hill 2007",
      .assumptions =
          "prices of a technique are like those of the others where it was seen little, a price is one for "
          "all tests of a kind whether they hit or miss, and what incoherent rays cost more is the same in "
          "all techniques",
      .constants = {{"I_tri", true, {20, 0.01, 1}},
                    {"I_pol", true, {48, 0.01, 1}},
                    {"I_ver", false, {2.5, 0.3}},
                    {"I_sph", true, {26, 0.01, 1}},
                    {"I_con", true, {89, 0.01, 1}},
                    {"C_full", true, {15}},
                    {"C_empty", true, {6}},
                    {"C_TS", true, {15}},
                    {"B", true, {6}},
                    {"C_0", true, {30}}},
      .terms = terms,
      .pooling = analysis::Pooling{.circumstances = {"incoherent"}, .amounts = circumstances}};
  return model;
}

}  // namespace rayshoot
