#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "scenes/core/placement.h"
#include "scenes/geometry/cone.h"
#include "scenes/geometry/sphere.h"
#include "scenes/geometry/triangle.h"

namespace rayshoot {

/// `placed` is a part that is placed in the scene as one object.
enum class ObjectKind : std::uint8_t { triangle, polygon, sphere, cone, placed };
inline constexpr std::array kObjectKindNames = {"triangle", "polygon", "sphere", "cone", "placed_part"};
using ObjectCounts = std::array<std::size_t, kObjectKindNames.size()>;

/// An NFF material: `f red green blue Kd Ks Shine T index_of_refraction`.
struct Material {
  Vec3d colour{1, 1, 1};
  double diffuse = 1;
  double specular = 0;
  double shine = 1;
  double transmittance = 0;
  double index_of_refraction = 1;

  bool reflects() const { return specular > 0 || transmittance > 0; }
  bool refracts() const { return transmittance > 0; }
  friend bool operator==(const Material&, const Material&) = default;
};

/// A point light; without a colour NFF leaves its intensity to the renderer.
struct Light {
  Vec3d position;
  std::optional<Vec3d> colour;

  friend bool operator==(const Light&, const Light&) = default;
};

/// The pinhole camera of NFF; `angle` is the full field of view in degrees.
struct View {
  Vec3d from{0, 0, -5}, at{0, 0, 0}, up{0, 1, 0};
  double angle = 45;
  double hither = 0;
  int width = 512, height = 512;

  friend bool operator==(const View&, const View&) = default;
};

/// One entry of a scene's object list, in the order in which objects were generated.
struct SceneObject {
  ObjectKind kind = ObjectKind::triangle;
  /// Position among the objects of its kind.
  std::uint32_t index = 0;
  std::uint32_t material = 0;
  /// First of this object's vertex normals, or `kNoObject` for a flat object.
  std::uint32_t first_normal = kNoObject;

  friend bool operator==(const SceneObject&, const SceneObject&) = default;
};

/// Vertices [first_vertex, first_vertex + vertex_count) of `Scene::polygon_vertices`.
struct VertexRange {
  std::uint32_t first_vertex = 0;
  std::uint32_t vertex_count = 0;

  friend bool operator==(const VertexRange&, const VertexRange&) = default;
};

/// Objects [first, last) that the modeller keeps together. Groups stand in the order in which they begin: those nested
/// in group i are the groups i + 1 to end - 1.
struct Group {
  std::uint32_t first = 0, last = 0;
  std::uint32_t end = 0;

  std::uint32_t size() const { return last - first; }
  friend bool operator==(const Group&, const Group&) = default;
};

/// Everything a file says about a scene, in double precision. Objects keep their order; each refers to one of
/// the arrays below it.
struct Scene {
  /// Canonical specification, for example "balls:4/patches"; the key under which reports know the scene.
  std::string id;
  Vec3d background{0, 0, 0};
  View view;
  std::vector<Light> lights;
  std::vector<Material> materials;

  std::vector<SceneObject> objects;
  std::vector<Triangle<double>> triangles;
  std::vector<VertexRange> polygons;
  std::vector<Vec3d> polygon_vertices;
  std::vector<Sphere<double>> spheres;
  std::vector<Cone<double>> cones;
  std::vector<Placement> placements;
  /// Vertex normals of smooth objects, as given: not necessarily of unit length.
  std::vector<Vec3d> vertex_normals;
  /// The modeller's hierarchy, whose first group is the whole scene; none where the modeller stated none, as in a file.
  /// No part of a scene's content: files do not hold it.
  std::vector<Group> groups;

  /// The number of each object's first and, behind the last object, of all, where some object is placed; empty elsewhere.
  /// Numbers count the objects of a placed part one by one, at every depth; where nothing is placed they are positions.
  std::vector<std::uint32_t> first_numbers;

  std::size_t size() const { return objects.size(); }
  /// How many objects there are, those of placed parts included.
  std::size_t numbers() const { return first_numbers.empty() ? objects.size() : first_numbers.back(); }
  std::uint32_t first_number(std::uint32_t object) const {
    return first_numbers.empty() ? object : first_numbers[object];
  }
  const Material& material_of(std::uint32_t number) const;

  /// Number of vertices of object `object`, which must be a triangle or a polygon.
  std::uint32_t vertex_count(std::uint32_t object) const;
  /// Vertex `corner` of object `object`, which must be a triangle or a polygon.
  const Vec3d& vertex(std::uint32_t object, std::uint32_t corner) const;
  /// The exact bounds of all objects in double precision, before any padding, and over all times; of a placed part the box
  /// about its box. Objects that are not finite or out of range are left out, as they are when tracing.
  Box<double> bounds() const;
  /// Number of objects of each kind, indexed by `ObjectKind`, those of placed parts included.
  ObjectCounts counts() const;
};

inline const std::vector<Placement>& placements_of(const Scene& scene) { return scene.placements; }

/// Same content, whatever the name: what a written file must read back to.
bool same_content(const Scene& a, const Scene& b);

/// Order-sensitive digest of a scene's content, as 16 hexadecimal digits.
std::string scene_hash(const Scene& scene);

/// Outward unit normal of the object of that number at `point` and a time: of the surface, or interpolated between vertex
/// normals where `smooth` is set and the object has them. Polygons and triangles point where their vertices run
/// counter-clockwise.
Vec3d surface_normal(const Scene& scene, std::uint32_t number, const Vec3d& point, bool smooth = true,
                     double time = 0);

}  // namespace rayshoot
