#include "scenes/io/mesh_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <set>
#include <vector>

#include "scenes/core/spec.h"
#include "scenes/io/text_reader.h"

namespace rayshoot {

namespace {

/// The next three numbers of the line as a line, provided that single precision can hold them.
std::string coordinates(TextReader& text, const char* what) {
  const Vec3d p = text.point(what);
  if (max_abs(p) > std::numeric_limits<float>::max())
    text.fail(fmt::format("{} is out of the range of single precision", what));
  return fmt::format("{} {} {}\n", p.x, p.y, p.z);
}

void begin_line(TextReader& text, const std::string& expected) {
  if (!text.next_line()) text.fail(fmt::format("the file ends where {} is missing", expected));
}

/// The vertex that a face names, counted from 1: its number, or minus how far back it lies among those so
/// far.
long long obj_vertex(TextReader& text, long long vertices_so_far) {
  const std::string_view word = text.word();
  long long number = 0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  const bool whole = stop == word.data() + word.size() || *stop == '/';
  const long long vertex = number < 0 ? vertices_so_far + 1 + number : number;
  if (error != std::errc{} || !whole || vertex < 1)
    text.fail(fmt::format("a face names no vertex by '{}'", shown(word)));
  return vertex;
}

void expect_word(TextReader& text, const std::string& what, const std::vector<std::string>& accepted) {
  const std::string word = shown(text.word());
  if (std::find(accepted.begin(), accepted.end(), word) == accepted.end())
    text.fail(fmt::format("{} is '{}', not {}", what, word, fmt::join(accepted, ", ")));
}

/// The name of a property whose types OpenMesh can read: its vertices have real coordinates, its faces lists
/// of integers.
std::string ply_property(TextReader& text) {
  static const std::vector<std::string> kIntegers = {"char", "uchar", "short", "ushort", "int",   "uint",
                                                     "int8", "uint8", "int16", "uint16", "int32", "uint32"};
  static const std::vector<std::string> kReals = {"float", "double", "float32", "float64"};
  const std::string type(text.word());
  const bool is_real = std::count(kReals.begin(), kReals.end(), type) > 0;
  if (type == "list") {
    expect_word(text, "the type of a list's length", {"uchar", "uint8", "int"});
    text.word();
  } else if (!is_real && std::count(kIntegers.begin(), kIntegers.end(), type) == 0) {
    text.fail(fmt::format("'{}' is not the type of a property", shown(type)));
  }
  std::string property(text.word());
  if (property.empty()) text.fail("the property has no name");
  const bool is_coordinate = property == "x" || property == "y" || property == "z";
  if (is_coordinate && !is_real) text.fail(fmt::format("the coordinate {} is not float or double", property));
  return property;
}

constexpr std::uintmax_t kStlHeaderBytes = 84, kStlTriangleBytes = 50;

/// The number of triangles that a binary STL file declares.
std::uint32_t read_stl_header(std::istream& in) {
  char header[kStlHeaderBytes] = {};
  in.read(header, kStlHeaderBytes);
  std::uint32_t triangles = 0;
  std::memcpy(&triangles, header + 80, sizeof triangles);
  return triangles;
}

}  // namespace

std::string plain_obj(std::istream& in, const std::string& name) {
  TextReader text(in, name);
  std::string plain, faces;
  long long vertices = 0, highest = 0;
  while (text.next_line()) {
    const std::string_view record = text.word();
    if (record == "v") {
      plain += "v " + coordinates(text, "the vertex");
      ++vertices;
    } else if (record == "f") {
      int corners = 0;
      faces += 'f';
      for (; !text.line_is_done(); ++corners) {
        const long long vertex = obj_vertex(text, vertices);
        highest = std::max(highest, vertex);
        faces += fmt::format(" {}", vertex);
      }
      faces += '\n';
      if (corners < 3) text.fail(fmt::format("face has {} vertices; at least 3 are needed", corners));
    }
  }
  if (highest > vertices)
    throw InputError(fmt::format("{}: a face names vertex {} of {}", name, highest, vertices));
  return plain + faces;
}

std::string plain_off(std::istream& in, const std::string& name) {
  TextReader text(in, name);
  begin_line(text, "the header");
  const std::string header(text.word());
  constexpr std::array kHeaders = {"OFF", "COFF", "NOFF", "CNOFF", "STOFF", "STCOFF", "STNOFF", "STCNOFF"};
  if (std::find(kHeaders.begin(), kHeaders.end(), header) == kHeaders.end())
    text.fail("an OFF file of three dimensions begins with OFF, COFF, NOFF or the like");
  const bool with_normals = header.find('N') != std::string::npos;

  if (text.line_is_done()) begin_line(text, "the number of vertices");
  const int vertices = text.integer("the number of vertices", 0);
  const int faces = text.integer("the number of faces", 0);
  std::string plain = fmt::format("{}\n{} {} 0\n", header, vertices, faces);
  for (int i = 0; i < vertices; ++i) {
    begin_line(text, fmt::format("vertex {} of {}", i + 1, vertices));
    plain += coordinates(text, "the vertex");
    if (with_normals) plain.back() = ' ', plain += coordinates(text, "the vertex normal");
  }
  for (int i = 0; i < faces; ++i) {
    begin_line(text, fmt::format("face {} of {}", i + 1, faces));
    const int corners = text.integer("the number of vertices", 0);
    if (corners < 3) text.fail(fmt::format("face has {} vertices; at least 3 are needed", corners));
    plain += std::to_string(corners);
    for (int corner = 0; corner < corners; ++corner)
      plain += fmt::format(" {}", text.integer("a vertex of the face", 0));
    plain += '\n';
  }
  if (text.next_line()) text.fail(fmt::format("the file goes on behind its {} faces", faces));
  return plain;
}

std::string plain_stl(std::istream& in, const std::string& name) {
  TextReader text(in, name);
  std::string plain = "solid\n";
  if (!text.next_line() || text.word() != "solid")
    text.fail("neither a text STL file, which begins with 'solid', nor a binary one as long as it says");
  bool ended = false;
  while (text.next_line()) {
    const std::string_view record = text.word();
    ended = record == "endsolid";
    if (record == "outer") {
      plain += "facet normal 0 0 0\nouter loop\n";
      for (int corner = 1; corner <= 3; ++corner) {
        begin_line(text, fmt::format("vertex {} of 3", corner));
        if (text.word() != "vertex") text.fail(fmt::format("vertex {} of 3 is missing", corner));
        plain += "vertex " + coordinates(text, "the vertex");
        text.end_line();
      }
      plain += "endloop\nendfacet\n";
    } else if (record == "vertex") {
      text.fail("a vertex outside of a loop of 3");
    } else if (!ended && record != "facet" && record != "endloop" && record != "endfacet" &&
               record != "solid") {
      text.fail(unknown_name("record", shown(record),
                             {"facet", "outer", "vertex", "endloop", "endfacet", "endsolid"}));
    }
  }
  if (!ended) text.fail("the file ends without 'endsolid'");
  return plain + "endsolid\n";
}

void check_ply_header(std::istream& in, const std::string& name) {
  TextReader text(in, name);
  begin_line(text, "the header");
  if (text.word() != "ply") text.fail("a PLY file begins with 'ply'");
  begin_line(text, "the format");
  expect_word(text, "the format", {"format"});
  expect_word(text, "the format", {"ascii", "binary_little_endian", "binary_big_endian"});
  expect_word(text, "the version", {"1.0"});
  text.end_line();

  std::string element;
  std::set<std::string> properties;
  while (true) {
    begin_line(text, "'end_header'");
    const std::string_view record = text.word();
    if (record == "end_header") break;
    if (record == "comment" || record == "obj_info") continue;
    if (record == "element") {
      element = text.word();
      text.integer("the number of elements", 0);
    } else if (record == "property" && !element.empty()) {
      properties.insert(element + ' ' + ply_property(text));
    } else {
      text.fail(fmt::format("'{}' should be element, property, comment or end_header", shown(record)));
    }
    text.end_line();
  }
  for (const char* needed : {"vertex x", "vertex y", "vertex z"})
    if (!properties.contains(needed)) text.fail(fmt::format("the header lacks the property {}", needed));
  if (!properties.contains("face vertex_indices") && !properties.contains("face vertex_index"))
    text.fail("the header lacks the property face vertex_indices");
}

bool is_binary_stl(std::istream& in, std::uintmax_t bytes) {
  in.clear(), in.seekg(0);
  return bytes >= kStlHeaderBytes && bytes == kStlHeaderBytes + kStlTriangleBytes * read_stl_header(in);
}

void check_binary_stl(std::istream& in, const std::string& name) {
  in.clear(), in.seekg(0);
  const std::uint32_t triangles = read_stl_header(in);
  for (std::uint32_t i = 0; i < triangles; ++i) {
    char record[kStlTriangleBytes] = {};
    in.read(record, kStlTriangleBytes);
    std::array<float, 12> numbers;
    std::memcpy(numbers.data(), record, sizeof numbers);
    if (!std::all_of(numbers.begin() + 3, numbers.end(), [](float x) { return std::isfinite(x); }))
      throw InputError(
          fmt::format("{}: triangle {} has a coordinate that is not a finite number", name, i + 1));
  }
}

}  // namespace rayshoot
