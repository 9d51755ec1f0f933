// closed_edge, STIFF 2: rays from inside a closed mesh to its edges
//
// Construction  The solids of closed_vertex. Even rays aim from the lattice at the midpoint of an edge, which
//               is a float as their vertices are even multiples of its last place, and meet it exactly; odd
//               rays aim at a random point of an edge, rounded, from anywhere inside.
// Property      Every ray hits. All that it crosses is among the strict optimizer's candidates.
// Metric        Leaks per 10^9 rays; crossings lost.
// Size          As closed_vertex.
// Anchor        Edges are the easier half: tests that lose a tenth of the vertices lose few edges or none.

#include "scenes/stiff/parts/solids.h"

namespace rayshoot {

namespace {

using namespace stiff;

using Edges = std::vector<std::array<std::uint32_t, 2>>;

Ray<double> ray_to_edge(const Solid& solid, const Edges& edges, const RandomNumbers& random,
                        std::uint64_t number) {
  const auto& [from, to] = edges[random.bits(number, 0) % edges.size()];
  const Vec3d &a = solid.mesh.vertices[from], &b = solid.mesh.vertices[to];
  const bool at_midpoint = number % 2 == 0;
  const double share = at_midpoint ? 0.5 : random.uniform(number, 1);
  return ray_to(point_inside(solid, random, number, at_midpoint), a * (1 - share) + b * share);
}

std::vector<StiffSetting> settings(int size, std::uint64_t seed) {
  return settings_inside_solids("closed_edge", size, seed, [](const Solid& solid) -> RayMaker {
    return [&solid, edges = edges_of(solid.mesh)](const RandomNumbers& random, std::uint64_t number) {
      return ray_to_edge(solid, edges, random, number);
    };
  });
}

}  // namespace

const StiffCase& stiff_closed_edge() {
  static const StiffCase entry{
      .id = "closed_edge",
      .number = 2,
      .title = "From inside a closed mesh to its edges",
      .construction = "the solids of closed_vertex; rays to exact midpoints and to random points of edges",
      .property = "at least one hit, always; no crossing is lost",
      .metric = "leaks per 10^9 rays, crossings lost",
      .settings = settings};
  return entry;
}

}  // namespace rayshoot
