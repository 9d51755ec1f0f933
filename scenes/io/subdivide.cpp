#include "scenes/io/subdivide.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/Sqrt3T.hh>

#include "scenes/core/spec.h"

namespace rayshoot {

namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

HalfEdgeMesh half_edges(const TriangleMesh& mesh) {
  HalfEdgeMesh result;
  std::vector<OpenMesh::VertexHandle> handles;
  for (const Vec3d& p : mesh.vertices) handles.push_back(result.add_vertex({p.x, p.y, p.z}));
  for (const auto& [a, b, c] : mesh.triangles)
    if (!result.add_face(handles[a], handles[b], handles[c]).is_valid())
      throw InputError("cannot subdivide: the mesh must be manifold");
  return result;
}

TriangleMesh triangles_of(const HalfEdgeMesh& mesh) {
  TriangleMesh result;
  for (const auto vertex : mesh.vertices()) {
    const OpenMesh::Vec3d p = mesh.point(vertex);
    result.vertices.push_back({p[0], p[1], p[2]});
  }
  for (const auto face : mesh.faces()) {
    std::array<std::uint32_t, 3> corners{};
    std::size_t corner = 0;
    for (const auto vertex : mesh.fv_range(face))
      corners[corner++] = static_cast<std::uint32_t>(vertex.idx());
    result.triangles.push_back(corners);
  }
  return result;
}

}  // namespace

TriangleMesh subdivided(const TriangleMesh& mesh, SubdivisionRule rule) {
  HalfEdgeMesh half_edge_mesh = half_edges(mesh);
  if (rule == SubdivisionRule::loop) {
    OpenMesh::Subdivider::Uniform::LoopT<HalfEdgeMesh, double> subdivider;
    subdivider(half_edge_mesh, 1);
  } else {
    OpenMesh::Subdivider::Uniform::Sqrt3T<HalfEdgeMesh, double> subdivider;
    subdivider(half_edge_mesh, 1);
  }
  return triangles_of(half_edge_mesh);
}

}  // namespace rayshoot
