// closed_vertex, STIFF 1: rays from inside a closed mesh to its vertices
//
// Construction  Icospheres, a tetrahedron, a ring and two random solids made by subdivision. Every ray starts
//               inside and aims at a vertex that is the same float in both precisions: even rays from a
//               lattice on which the difference is a float too, so that they meet the vertex exactly; odd
//               rays from anywhere, rounded. (No part of the SPD teapot is closed; the ring stands for shapes
//               that no inner point sees whole.)
// Property      Every ray hits. The mesh is closed, so a miss is a leak by topology alone; no oracle is
//               needed.
// Metric        Leaks per 10^9 rays with their 95 % upper bound, which is 3/n after n rays without a leak.
// Size          Icospheres up to level 2 + size, at most 8.
// Anchor        Of 10^6 such rays at a unit icosphere Embree loses 129,603, Embree ROBUST 3,603, madmann91's
//               bvh 15,610 and its robust form 8,850; a watertight test after Woop et al. none of 20,000.

#include "scenes/stiff/parts/solids.h"

namespace rayshoot {

namespace {

using namespace stiff;

Ray<double> ray_to_vertex(const Solid& solid, const RandomNumbers& random, std::uint64_t number) {
  const std::vector<Vec3d>& vertices = solid.mesh.vertices;
  const Vec3d& target = vertices[random.bits(number, 0) % vertices.size()];
  return ray_to(point_inside(solid, random, number, number % 2 == 0), target);
}

std::vector<StiffSetting> settings(int size, std::uint64_t seed) {
  return settings_inside_solids("closed_vertex", size, seed, [](const Solid& solid) -> RayMaker {
    return [&solid](const RandomNumbers& random, std::uint64_t number) {
      return ray_to_vertex(solid, random, number);
    };
  });
}

}  // namespace

const StiffCase& stiff_closed_vertex() {
  static const StiffCase entry{
      .id = "closed_vertex",
      .number = 1,
      .title = "From inside a closed mesh to its vertices",
      .construction = "icospheres, a tetrahedron, a ring and random solids; rays from inside to every vertex",
      .property = "at least one hit, always",
      .metric = "leaks per 10^9 rays, with the upper bound 3/n at 95 %",
      .settings = settings};
  return entry;
}

}  // namespace rayshoot
