#pragma once

#include <optional>
#include <string>

#include "scenes/core/scene.h"

namespace rayshoot {

/// The scene in a mesh file, by its ending .obj, .ply, .off or .stl: its faces as triangles and polygons (a
/// face that is not flat as several triangles), one grey material, a view of the whole and one light.
/// Coordinates have single precision, as OpenMesh reads them. Throws InputError, one line, on a file that is
/// not wholly understood.
Scene read_mesh(const std::string& path);

/// Write the faces of a scene, spheres and cones as the triangles that `tessellation` makes of them, in the
/// format that the path's ending names, in single precision: OBJ and OFF as text, PLY and STL (triangles
/// only) in binary. Throws InputError when the file cannot be written or single precision cannot hold a
/// coordinate.
void write_mesh(const Scene& scene, const std::string& path, int tessellation = 3);

/// How the faces of a scene hang together where their vertices have equal coordinates.
struct MeshTopology {
  std::size_t faces = 0;
  /// Distinct vertices.
  std::size_t vertices = 0;
  /// Edges with a face on one side only.
  std::size_t boundary_edges = 0;
  /// Faces that no surface can have beside the others: a third face at an edge, one turned against its
  /// neighbour, a second fan at a vertex already surrounded, a vertex named twice.
  std::size_t complex_faces = 0;
  /// Sets of faces connected by vertices.
  std::size_t components = 0;
  /// Whether every edge and every vertex looks like a surface: no complex face, no vertex where two fans
  /// meet.
  bool manifold = false;
  /// Whether the surface is manifold and has no boundary.
  bool closed = false;
};

/// The topology of a scene of triangles and polygons, from OpenMesh's half-edge structure; nothing for a
/// scene that has spheres or cones, or no faces.
std::optional<MeshTopology> topology_of(const Scene& scene);

}  // namespace rayshoot
