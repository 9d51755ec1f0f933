#include "scenes/io/mesh.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "scenes/core/scene_builder.h"
#include "scenes/core/spec.h"
#include "scenes/geometry/polygon.h"
#include "scenes/io/triangulate.h"

namespace rayshoot {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const char* const kFormats[] = {"obj", "ply", "off", "stl"};

/// A folder of its own for each test.
class MeshFile : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return folder_ / name; }
  std::string file(const std::string& name, const std::string& contents) const {
    std::ofstream(path(name), std::ios::binary) << contents;
    return path(name);
  }
  Scene read(const std::string& name, const std::string& contents) const {
    return read_mesh(file(name, contents));
  }
  /// Why a file is refused, after its name.
  std::string refusal(const std::string& name, const std::string& contents) const {
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    std::string reason = "accepted";
    try {
      read(name, contents);
    } catch (const InputError& error) {
      reason = error.what();
      EXPECT_THAT(reason, StartsWith(path(name) + ":"));
      reason = reason.substr(std::min(reason.size(), path(name).size() + 1));
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr() + testing::internal::GetCapturedStdout(), "");
    EXPECT_THAT(reason, testing::Not(HasSubstr("\n")));
    return reason;
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / fmt::format("rayshoot_mesh_{}", ::getpid());
};

using Corners = std::vector<std::vector<int>>;

Scene scene_of(const std::vector<Vec3d>& vertices, const Corners& faces) {
  SceneBuilder builder;
  for (const auto& face : faces) {
    std::vector<Vec3d> corners;
    corners.reserve(face.size());
    for (const int corner : face) corners.push_back(vertices[static_cast<std::size_t>(corner)]);
    builder.polygon(corners);
  }
  return std::move(builder).finish();
}

std::vector<Vec3d> cube_vertices(const Vec3d& at = {}) {
  std::vector<Vec3d> vertices(8, at);
  for (int i = 0; i < 8; ++i)
    vertices[static_cast<std::size_t>(i)] += Vec3d{1.0 * (i & 1), 1.0 * (i >> 1 & 1), 1.0 * (i >> 2)};
  return vertices;
}
const Corners kCubeFaces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                            {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

Scene cube() { return scene_of(cube_vertices(), kCubeFaces); }

/// All faces, each as the list of its corners.
std::vector<std::vector<Vec3d>> faces(const Scene& scene) {
  std::vector<std::vector<Vec3d>> result(scene.size());
  for (std::uint32_t object = 0; object < scene.size(); ++object)
    for (std::uint32_t corner = 0; corner < scene.vertex_count(object); ++corner)
      result[object].push_back(scene.vertex(object, corner));
  return result;
}

double area(const Scene& scene) {
  double sum = 0;
  for (const auto& face : faces(scene)) sum += length(make_polygon<double>(face, 0).normal) / 2;
  return sum;
}

TEST_F(MeshFile, KeepsFacesAndTheirOrder) {
  for (const char* format : {"obj", "ply", "off"}) {
    write_mesh(cube(), path(std::string("cube.") + format));
    EXPECT_EQ(faces(read_mesh(path(std::string("cube.") + format))), faces(cube())) << format;
  }
}

TEST_F(MeshFile, KeepsSinglePrecisionExactly) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<float> coordinate(-1, 1);
  SceneBuilder builder;
  for (int i = 0; i < 1000; ++i) {
    const auto point = [&] {
      return Vec3d(Vec3<float>{coordinate(generator), coordinate(generator), coordinate(generator)});
    };
    builder.triangle(point(), point(), point());
  }
  const Scene scene = std::move(builder).finish();
  for (const char* format : kFormats) {
    const std::string name = path(std::string("SCENE.") + format);
    write_mesh(scene, name);
    EXPECT_EQ(faces(read_mesh(name)), faces(scene)) << format;
  }
}

TEST_F(MeshFile, TakesEndingsInAnyCase) {
  write_mesh(cube(), path("CUBE.OBJ"));
  EXPECT_EQ(faces(read_mesh(path("CUBE.OBJ"))), faces(cube()));
  write_mesh(cube(), path("CUBE.Ply"));
  EXPECT_EQ(faces(read_mesh(path("CUBE.Ply"))), faces(cube()));
}

TEST_F(MeshFile, StlHoldsTriangles) {
  write_mesh(cube(), path("cube.stl"));
  const Scene scene = read_mesh(path("cube.stl"));
  EXPECT_EQ(scene.triangles.size(), 12u);
  EXPECT_DOUBLE_EQ(area(scene), 6);
  EXPECT_TRUE(topology_of(scene)->closed);
}

TEST_F(MeshFile, ReadsBinaryStlWhoseHeaderSaysSolid) {
  write_mesh(cube(), path("cube.stl"));
  std::fstream(path("cube.stl"), std::ios::in | std::ios::out | std::ios::binary) << "solid cube";
  EXPECT_EQ(read_mesh(path("cube.stl")).size(), 12u);
}

TEST_F(MeshFile, CurvedObjectsAreTessellated) {
  SceneBuilder builder;
  builder.sphere({0, 0, 0}, 1);
  builder.cone({2, 0, 0}, 1, {2, 0, 1}, 0.5);
  builder.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const Scene scene = std::move(builder).finish();
  write_mesh(scene, path("scene.ply"), 2);
  EXPECT_EQ(read_mesh(path("scene.ply")).size(), 12 * 4 + 8 * 2 + 1u);
  EXPECT_EQ(tessellated(scene, 5).size(), 12 * 25 + 8 * 5 + 1u);
}

TEST_F(MeshFile, PolygonsWithManyCornersAreCut) {
  std::vector<Vec3d> star;
  for (int i = 0; i < 300; ++i) {
    const double angle = i * 2 * 3.14159265358979 / 300, radius = i % 2 ? 1 : 0.9;
    star.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  SceneBuilder builder;
  builder.polygon(star);
  const Scene scene = std::move(builder).finish();
  for (const char* format : kFormats) {
    const std::string name = path(std::string("star.") + format);
    write_mesh(scene, name);
    const Scene again = read_mesh(name);
    EXPECT_EQ(again.size(), 298u) << format;
    EXPECT_NEAR(area(again), area(scene), 1e-5) << format;
  }
}

TEST_F(MeshFile, ComplexFacesAreNotLost) {
  // Three triangles at one edge, one of them twice, one turned over, and one that names a vertex twice.
  const std::vector<Vec3d> v = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
  const Scene scene = scene_of(v, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {0, 1, 2}, {2, 1, 0}, {3, 4, 4, 2}});
  for (const char* format : {"ply", "off"}) {
    const std::string name = path(std::string("complex.") + format);
    write_mesh(scene, name);
    EXPECT_EQ(faces(read_mesh(name)), faces(scene)) << format;
  }
  EXPECT_EQ(topology_of(scene)->complex_faces, 4u);
}

TEST_F(MeshFile, FacesThatAreNotFlatBecomeTriangles) {
  const std::string bent = "v 0 0 0\nv 1 0 0\nv 1 1 0.1\nv 0 1 0\nf 1 2 3 4\n";
  EXPECT_EQ(read("bent.obj", bent).triangles.size(), 2u);
  const std::string flat = "v 0 0 0\nv 1 0 0\nv 1 1 0.0000001\nv 0 1 0\nf 1 2 3 4\n";
  EXPECT_EQ(read("flat.obj", flat).polygons.size(), 1u);
}

TEST_F(MeshFile, ReadsWhatOthersWrite) {
  const std::string vertices = "v 0 0 0 0.5 0.5 0.5\nv 1 0 0\n  v 0 1 0 # third\n";
  EXPECT_EQ(faces(read("a.obj", "mtllib none.mtl\no thing\n" + vertices +
                                    "vt 0 0\nvn 0 0 1\nusemtl x\ns off\nf 1/1/1 2/1/1 3//1\nf -3 -2 -1\n")),
            (std::vector<std::vector<Vec3d>>(2, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})));
  const std::vector<std::vector<Vec3d>> triangle = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  EXPECT_EQ(
      faces(read("a.off", "OFF # comment\n# counts\n3 1 0\n\n0 0 0\n1 0 0 # two\n0 1 0\n3 0 1 2 255 0 0")),
      triangle);
  EXPECT_EQ(faces(read("b.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")), triangle);
  EXPECT_EQ(faces(read("c.off", "CNOFF\n3 1 0\n0 0 0 0 0 1 9 9 9 9\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n")),
            triangle);
  EXPECT_EQ(faces(read("d.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")), triangle);
  EXPECT_EQ(faces(read("a.stl",
                       "solid x\nfacet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n"
                       "  vertex 0 1 0\n endloop\nendfacet\nendsolid x\n")),
            triangle);
  EXPECT_EQ(faces(read("a.ply",
                       "ply\nformat ascii 1.0\ncomment hi\nelement vertex 3\nproperty double x\n"
                       "property double y\nproperty double z\nproperty uchar red\nelement face 1\n"
                       "property list int int vertex_index\nend_header\n"
                       "0 0 0 7\n1 0 0 7\n0 1 0 7\n3 0 1 2")),
            triangle);
}

TEST_F(MeshFile, RefusesMalformedObj) {
  EXPECT_EQ(refusal("a.obj", ""), " holds no faces");
  EXPECT_EQ(refusal("a.obj", "v 0 0 0\nv 1 nan 0\n"), "2: the vertex is 'nan', not a finite number");
  EXPECT_EQ(refusal("a.obj", "v 0 0\n"), "1: the vertex is missing");
  EXPECT_EQ(refusal("a.obj", "v 0 0 1e39\n"), "1: the vertex is out of the range of single precision");
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(refusal("a.obj", three + "f 1 2\n"), "4: face has 2 vertices; at least 3 are needed");
  EXPECT_EQ(refusal("a.obj", three + "f 1 2 9\n"), " a face names vertex 9 of 3");
  EXPECT_EQ(refusal("a.obj", three + "f 1 2 -4\n"), "4: a face names no vertex by '-4'");
  EXPECT_EQ(refusal("a.obj", three + "f 1 2 0\n"), "4: a face names no vertex by '0'");
  EXPECT_EQ(refusal("a.obj", three + "f /1 /2 /3\n"), "4: a face names no vertex by '/1'");
  EXPECT_EQ(refusal("a.obj", three + "f 1 2 x\n"), "4: a face names no vertex by 'x'");
}

TEST_F(MeshFile, RefusesMalformedOff) {
  EXPECT_EQ(refusal("a.off", ""), " does not begin with OFF");
  EXPECT_EQ(refusal("a.off", "4OFF\n"), " does not begin with OFF");
  EXPECT_EQ(refusal("a.off", "OFF\n"), "1: the file ends where the number of vertices is missing");
  EXPECT_EQ(refusal("a.off", "OFF\n-3 1 0\n"),
            "2: the number of vertices is '-3', not an integer of at least 0");
  EXPECT_EQ(refusal("a.off", "OFF\n2 1 0\n0 0 0\n"), "3: the file ends where vertex 2 of 2 is missing");
  const std::string three = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_EQ(refusal("a.off", three), "5: the file ends where face 1 of 1 is missing");
  EXPECT_EQ(refusal("a.off", three + "2 0 1\n"), "6: face has 2 vertices; at least 3 are needed");
  EXPECT_EQ(refusal("a.off", three + "3 0 1\n"), "6: a vertex of the face is missing");
  EXPECT_EQ(refusal("a.off", three + "3 0 1 3\n"), " face 1 names vertex 3 of 3");
  EXPECT_EQ(refusal("a.off", three + "3 0 1 2\n3 0 1 2\n"), "7: the file goes on behind its 1 faces");
  EXPECT_EQ(refusal("a.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n"), " holds no faces");
}

TEST_F(MeshFile, RefusesMalformedStl) {
  EXPECT_THAT(refusal("a.stl", ""), HasSubstr("neither a text STL file"));
  EXPECT_THAT(refusal("a.stl", std::string(200, 'x')), HasSubstr("neither a text STL file"));
  EXPECT_EQ(refusal("a.stl", "solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 0 inf 0\n"),
            "5: the vertex is 'inf', not a finite number");
  EXPECT_EQ(refusal("a.stl", "solid\nfacet\nouter loop\nvertex 0 0 0\nendloop\n"),
            "5: vertex 2 of 3 is missing");
  EXPECT_EQ(refusal("a.stl", "solid\nvertex 0 0 0\n"), "2: a vertex outside of a loop of 3");
  EXPECT_EQ(refusal("a.stl", "solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"),
            "7: the file ends without 'endsolid'");
  EXPECT_THAT(refusal("a.stl", "solid\nsquare\n"), StartsWith("2: unknown record 'square'"));
  write_mesh(cube(), path("cube.stl"));
  std::string binary(84 + 12 * 50, '\0');
  std::ifstream(path("cube.stl"), std::ios::binary).read(binary.data(), 84 + 12 * 50);
  EXPECT_THAT(refusal("b.stl", binary.substr(0, 200)), HasSubstr("neither a text STL file"));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(binary.data() + 84 + 50 + 12, &nan, sizeof nan);
  EXPECT_EQ(refusal("b.stl", binary), " triangle 2 has a coordinate that is not a finite number");
}

TEST_F(MeshFile, RefusesMalformedPly) {
  EXPECT_EQ(refusal("a.ply", ""), "0: the file ends where the header is missing");
  EXPECT_EQ(refusal("a.ply", "plx\n"), "1: a PLY file begins with 'ply'");
  EXPECT_EQ(refusal("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"),
            "3: the file ends where 'end_header' is missing");
  EXPECT_THAT(refusal("a.ply", "ply\nformat xml 1.0\n"), StartsWith("2: the format is 'xml', not ascii"));
  EXPECT_EQ(refusal("a.ply", "ply\nformat ascii 1.0\nelement vertex -3\n"),
            "3: the number of elements is '-3', not an integer of at least 0");
  const auto ply = [](int vertices, const std::string& face_type, const std::string& body) {
    return fmt::format(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list {} int vertex_indices\nend_header\n{}",
        vertices, face_type, body);
  };
  const std::string three = "0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_THAT(refusal("a.ply", ply(3, "uchar", three)), HasSubstr("behind vertex 3 and face 0"));
  EXPECT_THAT(refusal("a.ply", ply(3, "uchar", "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n")),
              HasSubstr("behind vertex 2"));
  EXPECT_EQ(refusal("a.ply", ply(3, "uchar", three + "2 0 1\n")),
            " face 1 has 2 vertices; at least 3 are needed");
  EXPECT_EQ(refusal("a.ply", ply(3, "uchar", three + "3 0 1 7\n")), " face 1 names vertex 7 of 3");
  EXPECT_THAT(refusal("a.ply", ply(3, "uchar", three + "4000000000 0 1 2\n")),
              HasSubstr("behind vertex 3 and face 0"));
  EXPECT_THAT(refusal("a.ply", ply(2000000000, "uchar", three)), HasSubstr("more than it has bytes"));
  EXPECT_THAT(refusal("a.ply", ply(3, "short", three + "3 0 1 2\n")),
              StartsWith("8: the type of a list's length is 'short', not"));
  EXPECT_EQ(refusal("a.ply", "ply\nformat ascii 1.0\nproperty float x\n"),
            "3: 'property' should be element, property, comment or end_header");
  EXPECT_EQ(refusal("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\n"),
            "4: the coordinate x is not float or double");
  EXPECT_EQ(refusal("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n"),
            "5: the header lacks the property vertex y");
}

TEST_F(MeshFile, RefusesNumbersThatAreNoneInBinaryFiles) {
  write_mesh(cube(), path("cube.ply"));
  std::string binary(std::filesystem::file_size(path("cube.ply")), '\0');
  std::ifstream(path("cube.ply"), std::ios::binary)
      .read(binary.data(), static_cast<std::streamsize>(binary.size()));
  const float infinite = std::numeric_limits<float>::infinity();
  std::memcpy(binary.data() + binary.find("end_header\n") + 11 + 16, &infinite, sizeof infinite);
  EXPECT_EQ(refusal("b.ply", binary), " vertex 2 has a coordinate that is not a finite number");
}

TEST_F(MeshFile, SurvivesAnyDamage) {
  // Overwrite or cut off random bytes: whatever comes of it is a scene or one clear line.
  std::mt19937 generator(7);
  const auto random = [&](std::size_t end) {
    return std::uniform_int_distribution<std::size_t>(0, end - 1)(generator);
  };
  for (const char* format : kFormats) {
    const std::string name = std::string("cube.") + format;
    write_mesh(cube(), path(name));
    std::string contents(std::filesystem::file_size(path(name)), '\0');
    std::ifstream(path(name), std::ios::binary)
        .read(contents.data(), static_cast<std::streamsize>(contents.size()));
    for (int round = 0; round < 100; ++round) {
      std::string damaged = contents;
      for (std::size_t i = random(3) + 1; i > 0; --i)
        damaged[random(damaged.size())] =
            static_cast<char>(random(2) ? random(256) : "0 -.\n9e#/"[random(9)]);
      if (random(3) == 0) damaged.resize(random(damaged.size()));
      refusal("damaged." + std::string(format), damaged);
    }
  }
}

TEST_F(MeshFile, NamesUnusablePaths) {
  const auto message = [](const auto& action) {
    try {
      action();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(message([] { read_mesh("no/such/file.obj"); }),
            "cannot read no/such/file.obj: No such file or directory");
  EXPECT_EQ(message([&] { write_mesh(cube(), "no/such/folder/a.stl"); }),
            "cannot write no/such/folder/a.stl: No such file or directory");
  EXPECT_THAT(message([&] { write_mesh(cube(), path("a.xyz")); }),
              EndsWith("a mesh file ends in .obj, .ply, .off or .stl"));
  Scene far = cube();
  far.polygon_vertices[0].x = 1e300;
  EXPECT_THAT(message([&] { write_mesh(far, path("a.ply")); }), HasSubstr("not finite in single precision"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(MeshFile, ShowsTheWholeMesh) {
  const Scene scene = read("a.obj", "v 10 0 0\nv 12 0 0\nv 10 2 0\nf 1 2 3\n");
  EXPECT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.view.at, (Vec3d{11, 1, 0}));
  const Vec3d axis = normalized(scene.view.at - scene.view.from);
  for (std::uint32_t corner = 0; corner < 3; ++corner) {
    const Vec3d& vertex = scene.vertex(0, corner);
    const double cosine = dot(normalized(vertex - scene.view.from), axis);
    EXPECT_LT(std::acos(cosine) * 180 / 3.14159265, scene.view.angle / 2);
  }
}

TEST(Topology, TellsClosedFromOpen) {
  const MeshTopology closed = *topology_of(cube());
  EXPECT_EQ(closed.faces, 6u);
  EXPECT_EQ(closed.vertices, 8u);
  EXPECT_EQ(closed.boundary_edges, 0u);
  EXPECT_EQ(closed.complex_faces, 0u);
  EXPECT_EQ(closed.components, 1u);
  EXPECT_TRUE(closed.manifold && closed.closed);

  Corners open_faces = kCubeFaces;
  open_faces.pop_back();
  const MeshTopology open = *topology_of(scene_of(cube_vertices(), open_faces));
  EXPECT_EQ(open.boundary_edges, 4u);
  EXPECT_TRUE(open.manifold);
  EXPECT_FALSE(open.closed);
}

TEST(Topology, TellsManifoldFromNot) {
  const std::vector<Vec3d> v = {{0, 0, 0},  {1, 0, 0},  {0, 1, 0}, {0, 0, 1},
                                {0, -1, 0}, {-1, 0, 0}, {0, 0, -1}};
  const MeshTopology fin = *topology_of(scene_of(v, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
  EXPECT_EQ(fin.complex_faces, 1u);
  EXPECT_FALSE(fin.manifold);
  const MeshTopology turned = *topology_of(scene_of(v, {{0, 1, 2}, {0, 1, 3}}));
  EXPECT_FALSE(turned.manifold);
  const MeshTopology bow_tie = *topology_of(scene_of(v, {{0, 1, 2}, {0, 4, 5}}));
  EXPECT_EQ(bow_tie.complex_faces, 0u);
  EXPECT_EQ(bow_tie.components, 1u);
  EXPECT_FALSE(bow_tie.manifold);
}

TEST(Topology, WeldsEqualVerticesAndCountsComponents) {
  SceneBuilder builder;
  for (const Vec3d& at : {Vec3d{0, 0, 0}, Vec3d{5, 0, 0}, Vec3d{0, 5, 0}})
    for (const auto& face : faces(scene_of(cube_vertices(at), kCubeFaces))) builder.polygon(face);
  builder.triangle({-0.0, 0, 9}, {1, 0, 9}, {0, 1, 9});
  builder.triangle({1, 0, 9}, {0.0, -0.0, 9}, {0, -1, 9});
  const MeshTopology topology = *topology_of(std::move(builder).finish());
  EXPECT_EQ(topology.vertices, 3 * 8 + 4u);
  EXPECT_EQ(topology.components, 4u);
  EXPECT_EQ(topology.boundary_edges, 4u);
  EXPECT_TRUE(topology.manifold);
}

TEST(Topology, IsOfFacesOnly) {
  EXPECT_FALSE(topology_of(Scene{}));
  SceneBuilder builder;
  builder.sphere({0, 0, 0}, 1);
  EXPECT_FALSE(topology_of(std::move(builder).finish()));
}

TEST(Topology, BearsGarbage) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const MeshTopology topology = *topology_of(scene_of({{nan, 0, 0}, {1, nan, 0}, {0, 0, 0}, {1, 1, 1}},
                                                      {{0, 1, 2}, {0, 1, 2}, {2, 2, 2}, {2, 3, 2}}));
  EXPECT_EQ(topology.faces, 4u);
  EXPECT_EQ(topology.complex_faces, 2u);
}

TEST(Triangulate, CoversConcavePolygonsOnce) {
  // A comb, in three planes and both senses.
  std::vector<std::array<double, 2>> comb;
  for (int tooth = 0; tooth < 5; ++tooth)
    comb.push_back({2.0 * tooth, 3}), comb.push_back({2.0 * tooth + 1, 1});
  comb.push_back({9, 0}), comb.push_back({0, 0});
  for (int axis = 0; axis < 3; ++axis)
    for (const bool reversed : {false, true}) {
      std::vector<Vec3d> vertices;
      for (const auto& [u, v] : comb) {
        Vec3d& p = vertices.emplace_back(Vec3d{1, 1, 1});
        p[(axis + 1) % 3] = u, p[(axis + 2) % 3] = v;
      }
      if (reversed) std::reverse(vertices.begin(), vertices.end());
      const Vec3d whole = make_polygon<double>(vertices, 0).normal;
      Vec3d sum{};
      double total = 0;
      for (const auto& [a, b, c] : triangulate(vertices)) {
        const Vec3d part = cross(vertices[b] - vertices[a], vertices[c] - vertices[a]);
        EXPECT_GT(dot(part, whole), 0);
        sum += part, total += length(part);
      }
      EXPECT_EQ(sum, whole);
      EXPECT_DOUBLE_EQ(total, length(whole));
    }
}

TEST(Triangulate, EndsOnDegeneratePolygons) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(triangulate(std::vector<Vec3d>(5, {1, 1, 1})).size(), 3u);
  EXPECT_EQ(triangulate(std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}).size(), 2u);
  EXPECT_EQ(triangulate(std::vector<Vec3d>{{0, 0, 0}, {1, nan, 0}, {1, 1, 0}, {nan, 1, 0}}).size(), 2u);
}

}  // namespace
}  // namespace rayshoot
