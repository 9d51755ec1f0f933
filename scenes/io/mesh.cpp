#include "scenes/io/mesh.h"

#include <fmt/format.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/IO/reader/OFFReader.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <numeric>
#include <sstream>
#include <unordered_map>

#include "scenes/core/digest.h"
#include "scenes/core/scene_builder.h"
#include "scenes/core/spec.h"
#include "scenes/geometry/polygon.h"
#include "scenes/io/mesh_text.h"
#include "scenes/io/output_file.h"
#include "scenes/io/triangulate.h"

namespace rayshoot {

namespace {

using OpenMesh::FaceHandle;
using OpenMesh::VertexHandle;
using HalfEdgeMesh = OpenMesh::PolyMesh_ArrayKernelT<>;

/// Faces as lists of vertices: what a mesh file holds.
struct FaceList {
  std::vector<Vec3d> vertices;
  std::vector<std::uint32_t> corners;
  /// Where in `corners` each face ends.
  std::vector<std::size_t> ends;

  std::size_t faces() const { return ends.size(); }
  std::span<const std::uint32_t> face(std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : ends[i - 1];
    return {corners.data() + begin, ends[i] - begin};
  }
  void end_face() { ends.push_back(corners.size()); }
};

/// What OpenMesh would tell the user: kept from the terminal, and quoted when a file is refused.
class Overheard {
 public:
  Overheard()
      : cerr_(std::cerr.rdbuf(&text_)), clog_(std::clog.rdbuf(&text_)), cout_(std::cout.rdbuf(&text_)) {
    omerr().enable();  // which a reader that was left by an exception keeps disabled
  }
  ~Overheard() {
    std::cerr.rdbuf(cerr_);
    std::clog.rdbuf(clog_);
    std::cout.rdbuf(cout_);
  }
  Overheard(const Overheard&) = delete;
  Overheard& operator=(const Overheard&) = delete;

  std::string first_line() const {
    const std::string text = text_.str();
    return text.substr(0, text.find('\n'));
  }

 private:
  std::stringbuf text_;
  std::streambuf *cerr_, *clog_, *cout_;
};

// ---------------------------------------------------------------- reading

/// Takes every face as the file gives it, whether or not a half-edge structure could hold it.
class FaceImporter : public OpenMesh::IO::ImporterT<HalfEdgeMesh> {
 public:
  FaceImporter(const std::string& name, std::uintmax_t file_bytes)
      : ImporterT(unused_), name_(name), file_bytes_(file_bytes) {}

  FaceList take() {
    if (declared_ && (declared_->first != n_vertices() || declared_->second != n_faces()))
      fail(fmt::format("declares {} vertices and {} faces, holds {} and {}", declared_->first,
                       declared_->second, n_vertices(), n_faces()));
    if (list_.faces() == 0) fail("holds no faces");
    return std::move(list_);
  }

  void reserve(unsigned int vertices, unsigned int, unsigned int faces) override {
    if (std::uintmax_t{vertices} + faces > file_bytes_)
      fail(fmt::format("declares {} vertices and {} faces, more than it has bytes", vertices, faces));
    declared_ = {vertices, faces};
  }
  VertexHandle add_vertex() override {
    list_.vertices.emplace_back();
    return VertexHandle(static_cast<int>(list_.vertices.size() - 1));
  }
  VertexHandle add_vertex(const OpenMesh::Vec3f& p) override { return add_vertex(OpenMesh::Vec3d(p)); }
  VertexHandle add_vertex(const OpenMesh::Vec3d& p) override {
    const VertexHandle vertex = add_vertex();
    set(vertex, {p[0], p[1], p[2]});
    return vertex;
  }
  void set_point(VertexHandle vertex, const OpenMesh::Vec3f& p) override { set(vertex, {p[0], p[1], p[2]}); }
  FaceHandle add_face(const VHandles& corners) override {
    if (corners.size() < 3)
      fail(fmt::format("face {} has {} vertices; at least 3 are needed", n_faces() + 1, corners.size()));
    for (const VertexHandle corner : corners) {
      if (corner.idx() < 0 || static_cast<std::size_t>(corner.idx()) >= n_vertices())
        fail(fmt::format("face {} names vertex {} of {}", n_faces() + 1, corner.idx(), n_vertices()));
      list_.corners.push_back(static_cast<std::uint32_t>(corner.idx()));
    }
    list_.end_face();
    return FaceHandle(static_cast<int>(list_.faces() - 1));
  }
  void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<OpenMesh::Vec2f>&) override {}
  void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<OpenMesh::Vec3f>&) override {}
  std::size_t n_vertices() const override { return list_.vertices.size(); }
  std::size_t n_faces() const override { return list_.faces(); }

 private:
  void set(VertexHandle vertex, const Vec3d& p) {
    if (!is_finite(p))
      fail(fmt::format("vertex {} has a coordinate that is not a finite number", vertex.idx() + 1));
    list_.vertices[static_cast<std::size_t>(vertex.idx())] = p;
  }
  [[noreturn]] void fail(const std::string& reason) const {
    throw InputError(fmt::format("{}: {}", name_, reason));
  }

  HalfEdgeMesh unused_;
  std::string name_;
  std::uintmax_t file_bytes_;
  std::optional<std::pair<std::size_t, std::size_t>> declared_;
  FaceList list_;
};

/// The ending of a path without its dot, in lower case; InputError unless it is that of a mesh format.
std::string format_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  for (const char* known : {".obj", ".ply", ".off", ".stl"})
    if (ending == known) return ending.substr(1);
  throw InputError(fmt::format("{}: a mesh file ends in .obj, .ply, .off or .stl", path));
}

std::ifstream open_for_reading(const std::string& path) {
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(fmt::format("cannot read {}: {}", path, std::strerror(errno)));
  if (!std::filesystem::is_regular_file(path))
    throw InputError(fmt::format("cannot read {}: it is not a regular file", path));
  return in;
}

/// Whether the first line of a file holds `word`.
bool first_line_has(const std::string& path, const std::string& word) {
  std::ifstream in = open_for_reading(path);
  char line[256] = {};
  in.read(line, sizeof line - 1);
  const std::string_view text(line);
  return text.substr(0, text.find('\n')).find(word) != std::string_view::npos;
}

/// Let one of OpenMesh's readers loose on what has been checked.
void read_checked(std::istream& in, const std::string& path, const std::string& format,
                  OpenMesh::IO::Options options, FaceImporter& importer) {
  Overheard overheard;
  bool understood = false;
  try {
    understood = OpenMesh::IO::IOManager().read(in, format, importer, options);
  } catch (const std::ios_base::failure&) {
    throw InputError(
        fmt::format("{}: ends too early, or has something else where a number should be, behind vertex {} "
                    "and face {}",
                    path, importer.n_vertices(), importer.n_faces()));
  }
  if (!understood) throw InputError(fmt::format("{}: {}", path, overheard.first_line()));
}

FaceList read_faces(const std::string& path) {
  const std::string format = format_of(path);
  std::ifstream in = open_for_reading(path);
  const std::uintmax_t bytes = std::filesystem::file_size(path);
  FaceImporter importer(path, bytes);
  const auto read_plain = [&](const std::string& text) {
    std::istringstream plain(text);
    read_checked(plain, path, format, {}, importer);
  };
  const auto read_raw = [&](const OpenMesh::IO::Options& options) {
    in.clear();
    in.seekg(0);
    in.exceptions(std::ios::failbit | std::ios::badbit);
    read_checked(in, path, format, options, importer);
  };

  if (format == "obj") {
    read_plain(plain_obj(in, path));
  } else if (format == "off") {
    // OpenMesh's OFF reader learns the kind of file from the file alone, and remembers it.
    if (!OpenMesh::IO::OFFReader().can_u_read(path))
      throw InputError(fmt::format("{}: does not begin with OFF", path));
    first_line_has(path, "BINARY") ? read_raw({}) : read_plain(plain_off(in, path));
  } else if (format == "ply") {
    check_ply_header(in, path);
    read_raw({});
  } else if (is_binary_stl(in, bytes)) {
    check_binary_stl(in, path);
    read_raw(OpenMesh::IO::Options::Binary);
  } else {
    in.clear(), in.seekg(0);
    read_plain(plain_stl(in, path));
  }
  return importer.take();
}

/// Whether no vertex lies farther from the polygon's plane than single precision accounts for.
bool is_flat(std::span<const Vec3d> vertices) {
  constexpr double kTolerance = 1e-5;
  const Polygon<double> polygon = make_polygon<double>(vertices, 0);
  const double limit = kTolerance * length(polygon.box.extent()) * length(polygon.normal);
  return std::all_of(vertices.begin(), vertices.end(),
                     [&](const Vec3d& v) { return std::abs(dot(polygon.normal, v - vertices[0])) <= limit; });
}

void add_face(SceneBuilder& builder, std::span<const Vec3d> vertices) {
  if (vertices.size() == 3 || is_flat(vertices)) return builder.polygon(vertices);
  for (const auto& [a, b, c] : triangulate(vertices)) builder.triangle(vertices[a], vertices[b], vertices[c]);
}

/// Look at the whole box from the front, the right and above, with a light over the shoulder.
void set_stage(SceneBuilder& builder, const Box<double>& box) {
  const Vec3d centre = box.centre();
  const double radius = std::max(0.5 * length(box.extent()), std::numeric_limits<double>::min());
  const View view{
      .from = centre + normalized(Vec3d{0.5, -1, 0.5}) * (2.7 * radius), .at = centre, .up = {0, 0, 1}};
  builder.background({0.078, 0.361, 0.753});
  builder.view(view);
  builder.light(view.from + Vec3d{-2, 0, 3} * radius);
  builder.material({.colour = {0.8, 0.8, 0.8}});
}

// ---------------------------------------------------------------- writing

/// Vertices with equal coordinates are one.
class Welder {
 public:
  explicit Welder(std::vector<Vec3d>& vertices) : vertices_(vertices) {}

  std::uint32_t vertex(const Vec3d& p) {
    const auto [entry, is_new] = numbers_.try_emplace(p, static_cast<std::uint32_t>(vertices_.size()));
    if (is_new) vertices_.push_back(p);
    return entry->second;
  }

 private:
  struct Hash {
    std::size_t operator()(const Vec3d& p) const {
      Digest digest;
      digest.add(p + Vec3d{});  // which makes one zero of two
      return digest.value();
    }
  };
  std::vector<Vec3d>& vertices_;
  std::unordered_map<Vec3d, std::uint32_t, Hash> numbers_;
};

/// The faces of a scene of triangles and polygons over welded vertices; those of more than `most_corners` are
/// cut into triangles.
FaceList faces_of(const Scene& scene, std::size_t most_corners) {
  FaceList list;
  Welder welder(list.vertices);
  std::vector<Vec3d> vertices;
  for (std::uint32_t object = 0; object < scene.size(); ++object) {
    vertices.clear();
    for (std::uint32_t corner = 0; corner < scene.vertex_count(object); ++corner)
      vertices.push_back(scene.vertex(object, corner));
    if (vertices.size() <= most_corners) {
      for (const Vec3d& vertex : vertices) list.corners.push_back(welder.vertex(vertex));
      list.end_face();
      continue;
    }
    for (const auto& triangle : triangulate(vertices)) {
      for (const std::uint32_t corner : triangle) list.corners.push_back(welder.vertex(vertices[corner]));
      list.end_face();
    }
  }
  return list;
}

/// Gives every face to a writer, whether or not a half-edge structure could hold it.
class FaceExporter : public OpenMesh::IO::ExporterT<HalfEdgeMesh> {
 public:
  explicit FaceExporter(const FaceList& list) : ExporterT(unused_), list_(list) {}

  OpenMesh::Vec3f point(VertexHandle vertex) const override {
    const Vec3<float> p(list_.vertices[static_cast<std::size_t>(vertex.idx())]);
    return {p.x, p.y, p.z};
  }
  unsigned int get_vhandles(FaceHandle face, std::vector<VertexHandle>& corners) const override {
    corners.clear();
    for (const std::uint32_t corner : list_.face(static_cast<std::size_t>(face.idx())))
      corners.emplace_back(static_cast<int>(corner));
    return static_cast<unsigned int>(corners.size());
  }
  std::size_t n_vertices() const override { return list_.vertices.size(); }
  std::size_t n_faces() const override { return list_.faces(); }

 private:
  HalfEdgeMesh unused_;
  const FaceList& list_;
};

// ---------------------------------------------------------------- topology

bool names_a_vertex_twice(std::span<const std::uint32_t> face) {
  for (std::size_t i = 0; i < face.size(); ++i)
    if (std::find(face.begin() + static_cast<std::ptrdiff_t>(i) + 1, face.end(), face[i]) != face.end())
      return true;
  return false;
}

/// Give the faces to a half-edge structure; returns how many it refused.
std::size_t build_half_edges(const FaceList& list, HalfEdgeMesh& mesh) {
  const Overheard overheard;
  std::size_t refused = 0;
  mesh.reserve(list.vertices.size(), list.corners.size(), list.faces());
  for (std::size_t i = 0; i < list.vertices.size(); ++i) mesh.new_vertex();
  std::vector<VertexHandle> corners;
  for (std::size_t i = 0; i < list.faces(); ++i) {
    corners.clear();
    for (const std::uint32_t corner : list.face(i)) corners.emplace_back(static_cast<int>(corner));
    if (names_a_vertex_twice(list.face(i)) || !mesh.add_face(corners).is_valid()) ++refused;
  }
  return refused;
}

/// Number of sets of faces that share vertices, by union and find over the vertices.
std::size_t count_components(const FaceList& list) {
  std::vector<std::uint32_t> parent(list.vertices.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t vertex) {
    while (parent[vertex] != vertex) vertex = parent[vertex] = parent[parent[vertex]];
    return vertex;
  };
  std::size_t components = list.vertices.size();
  for (std::size_t i = 0; i < list.faces(); ++i)
    for (const std::uint32_t corner : list.face(i)) {
      const std::uint32_t a = root(list.face(i)[0]), b = root(corner);
      if (a != b) parent[b] = a, --components;
    }
  return components;
}

}  // namespace

Scene read_mesh(const std::string& path) {
  const FaceList list = read_faces(path);
  Box<double> box;
  for (const std::uint32_t corner : list.corners) box.include(list.vertices[corner]);
  SceneBuilder builder;
  set_stage(builder, box);
  std::vector<Vec3d> vertices;
  for (std::size_t i = 0; i < list.faces(); ++i) {
    vertices.clear();
    for (const std::uint32_t corner : list.face(i)) vertices.push_back(list.vertices[corner]);
    add_face(builder, vertices);
  }
  return std::move(builder).finish();
}

void write_mesh(const Scene& scene, const std::string& path, int tessellation) {
  const std::string format = format_of(path);
  require_nothing_placed(scene, path);
  const bool curved = !scene.spheres.empty() || !scene.cones.empty();
  // STL has triangles only; a PLY file counts a face's vertices in one byte.
  const std::size_t most_corners = format == "stl" ? 3 : 255;
  const FaceList list = faces_of(curved ? tessellated(scene, tessellation) : scene, most_corners);
  for (const Vec3d& vertex : list.vertices)
    if (!is_finite(Vec3<float>(vertex)))
      throw InputError(fmt::format("cannot write {}: a coordinate is not finite in single precision", path));

  OutputFile file(path);
  FaceExporter exporter(list);
  const bool binary = format == "ply" || format == "stl";
  const OpenMesh::IO::Options options =
      binary ? OpenMesh::IO::Options::Binary : OpenMesh::IO::Options::Default;
  Overheard overheard;
  if (!OpenMesh::IO::IOManager().write(file.stream(), format, exporter, options, 17))
    throw InputError(fmt::format("cannot write {}: {}", path, overheard.first_line()));
  file.commit();
}

std::optional<MeshTopology> topology_of(const Scene& scene) {
  if (scene.objects.empty() || !scene.spheres.empty() || !scene.cones.empty() || !scene.placements.empty())
    return std::nullopt;
  const FaceList list = faces_of(scene, std::numeric_limits<std::size_t>::max());
  HalfEdgeMesh mesh;
  MeshTopology topology{.faces = list.faces(), .vertices = list.vertices.size()};
  topology.complex_faces = build_half_edges(list, mesh);
  topology.components = count_components(list);
  topology.boundary_edges = static_cast<std::size_t>(
      std::count_if(mesh.edges_begin(), mesh.edges_end(), [&](auto edge) { return mesh.is_boundary(edge); }));
  topology.manifold = topology.complex_faces == 0 && std::all_of(mesh.vertices_begin(), mesh.vertices_end(),
                                                                 [&](auto v) { return mesh.is_manifold(v); });
  topology.closed = topology.manifold && topology.boundary_edges == 0;
  return topology;
}

}  // namespace rayshoot
