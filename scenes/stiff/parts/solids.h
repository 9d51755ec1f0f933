#pragma once

#include <memory>
#include <string>

#include "scenes/core/scene.h"
#include "scenes/core/triangle_mesh.h"
#include "scenes/io/subdivide.h"
#include "scenes/stiff/parts/rays.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot::stiff {

/// Vertices of solids are multiples of this, and their coordinates below 1, so that midpoints of edges are multiples
/// of half of it, and differences to points on that finer lattice are floats.
inline constexpr double kStep = 0x1p-21;

struct Ball {
  Vec3d centre;
  double radius = 0;
};

/// A closed mesh, and balls that lie inside with room to spare.
struct Solid {
  std::string name;
  TriangleMesh mesh;
  std::vector<Ball> inside;
};

/// An icosahedron whose faces have been divided into four `level` times, blown up to a radius just under 1.
Solid icosphere(int level);
/// A regular tetrahedron.
Solid tetrahedron();
/// A ring of quadrangles, each two triangles, around the z axis: no point sees all of it from inside.
Solid ring(int around, int along);
/// An icosahedron that is given random dents and subdivided, `steps` times.
Solid random_solid(SubdivisionRule rule, int steps, std::uint64_t seed);

/// The triangles of a mesh as a scene.
std::shared_ptr<const Scene> scene_of(const TriangleMesh& mesh, const std::string& id);
/// The pairs of vertices that an edge connects, each once, the lower first.
std::vector<std::array<std::uint32_t, 2>> edges_of(const TriangleMesh& mesh);
/// A point inside of the solid that is a float: on the lattice of half `kStep`, or any.
Vec3d point_inside(const Solid& solid, const RandomNumbers& random, std::uint64_t number, bool on_lattice);

/// The closed meshes of the short form, and of larger forms: icospheres, a tetrahedron, a ring, random solids.
std::vector<Solid> solids(int size, std::uint64_t seed);
/// A setting of the case `id` for each of these solids, with rays from inside, all of which hit. `rays_in` makes rays for
/// a solid, which outlives them.
std::vector<StiffSetting> settings_inside_solids(const std::string& id, int size, std::uint64_t seed,
                                                 const std::function<RayMaker(const Solid&)>& rays_in);

}  // namespace rayshoot::stiff
