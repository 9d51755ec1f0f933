#include "scenes/core/scene_builder.h"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <numbers>

#include "scenes/core/spec.h"

namespace rayshoot {

namespace {

constexpr double kPi = std::numbers::pi;

/// Give the builder what made `object`.
void add_again(SceneBuilder& builder, const Scene& scene, std::uint32_t object) {
  const SceneObject& entry = scene.objects[object];
  if (entry.kind == ObjectKind::sphere) {
    const Sphere<double>& sphere = scene.spheres[entry.index];
    return builder.sphere(sphere.centre, sphere.radius);
  }
  if (entry.kind == ObjectKind::cone) {
    const Cone<double>& cone = scene.cones[entry.index];
    return builder.cone(cone.base, cone.base_radius, cone.apex, cone.apex_radius);
  }
  std::vector<Vec3d> vertices;
  for (std::uint32_t corner = 0; corner < scene.vertex_count(object); ++corner)
    vertices.push_back(scene.vertex(object, corner));
  if (entry.first_normal == kNoObject) return builder.polygon(vertices);
  builder.polygon(vertices, {scene.vertex_normals.data() + entry.first_normal, vertices.size()});
}

/// Opens and closes the groups of a scene while its objects are given to a builder again.
class GroupsAgain {
 public:
  GroupsAgain(const Scene& scene, SceneBuilder& builder) : groups_(scene.groups), builder_(builder) {}

  void before(std::uint32_t object) {
    for (; next_ < groups_.size() && groups_[next_].first == object; ++next_) {
      open_.push_back(std::make_unique<SceneBuilder::GroupScope>(builder_));
      last_.push_back(groups_[next_].last);
    }
  }
  void behind(std::uint32_t object) {
    for (; !open_.empty() && last_.back() == object + 1; last_.pop_back()) open_.pop_back();
  }

 private:
  std::span<const Group> groups_;
  SceneBuilder& builder_;
  /// The first group is the whole scene, which the builder adds itself.
  std::size_t next_ = 1;
  std::vector<std::unique_ptr<SceneBuilder::GroupScope>> open_;
  std::vector<std::uint32_t> last_;
};

}  // namespace

SceneBuilder::SceneBuilder(const SceneOptions& options) : options_(options) {}

void SceneBuilder::open_group() {
  if (scene_.groups.empty()) scene_.groups.emplace_back();
  open_groups_.push_back(static_cast<std::uint32_t>(scene_.groups.size()));
  scene_.groups.push_back({.first = static_cast<std::uint32_t>(scene_.size())});
}

/// A group without objects is none.
void SceneBuilder::close_group() {
  Group& group = scene_.groups[open_groups_.back()];
  group.last = static_cast<std::uint32_t>(scene_.size());
  group.end = static_cast<std::uint32_t>(scene_.groups.size());
  if (group.size() == 0) scene_.groups.pop_back();
  open_groups_.pop_back();
}

namespace {

/// Number the objects of placed parts one by one.
void number_objects(Scene& scene) {
  if (scene.placements.empty()) return;
  std::uint64_t number = 0;
  for (const SceneObject& object : scene.objects) {
    scene.first_numbers.push_back(static_cast<std::uint32_t>(number));
    number += object.kind == ObjectKind::placed ? scene.placements[object.index].part->numbers() : 1;
    if (number >= kNoObject)
      throw InputError(fmt::format(
          "more than {} objects, those of placed parts included: choose a smaller size", kNoObject - 1));
  }
  scene.first_numbers.push_back(static_cast<std::uint32_t>(number));
}

}  // namespace

Scene SceneBuilder::finish() && {
  number_objects(scene_);
  if (!scene_.groups.empty())
    scene_.groups.front() = {0, static_cast<std::uint32_t>(scene_.size()),
                             static_cast<std::uint32_t>(scene_.groups.size())};
  return std::move(scene_);
}

void SceneBuilder::add_object(ObjectKind kind, std::size_t index, std::uint32_t first_normal) {
  if (scene_.materials.empty()) scene_.materials.emplace_back();
  scene_.objects.push_back({kind, static_cast<std::uint32_t>(index),
                            static_cast<std::uint32_t>(scene_.materials.size() - 1), first_normal});
}

void SceneBuilder::triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  add_object(ObjectKind::triangle, scene_.triangles.size());
  scene_.triangles.push_back({a, b, c});
}

void SceneBuilder::patch(const std::array<Vec3d, 3>& vertices, const std::array<Vec3d, 3>& normals) {
  polygon(vertices, normals);
}

void SceneBuilder::polygon(std::span<const Vec3d> vertices) {
  if (vertices.size() == 3) return triangle(vertices[0], vertices[1], vertices[2]);
  add_object(ObjectKind::polygon, scene_.polygons.size());
  scene_.polygons.push_back({static_cast<std::uint32_t>(scene_.polygon_vertices.size()),
                             static_cast<std::uint32_t>(vertices.size())});
  scene_.polygon_vertices.insert(scene_.polygon_vertices.end(), vertices.begin(), vertices.end());
}

void SceneBuilder::polygon(std::span<const Vec3d> vertices, std::span<const Vec3d> normals) {
  polygon(vertices);
  scene_.objects.back().first_normal = static_cast<std::uint32_t>(scene_.vertex_normals.size());
  scene_.vertex_normals.insert(scene_.vertex_normals.end(), normals.begin(), normals.end());
}

void SceneBuilder::sphere(const Vec3d& centre, double radius) {
  if (options_.form == SceneForm::patches) return tessellate_sphere(centre, radius);
  add_object(ObjectKind::sphere, scene_.spheres.size());
  scene_.spheres.push_back({frame_(centre), scale_ * radius});
}

void SceneBuilder::cone(const Vec3d& base, double base_radius, const Vec3d& apex, double apex_radius) {
  if (options_.form == SceneForm::patches) return tessellate_cone({base, base_radius, apex, apex_radius});
  add_object(ObjectKind::cone, scene_.cones.size());
  scene_.cones.push_back({frame_(base), scale_ * base_radius, frame_(apex), scale_ * apex_radius});
}

void SceneBuilder::place(std::shared_ptr<const Scene> part, const Affine& scene_from_part,
                         const Vec3d& velocity) {
  add_object(ObjectKind::placed, scene_.placements.size());
  scene_.placements.push_back({std::move(part), scene_from_part, velocity});
}

void SceneBuilder::placed_patch(const std::array<Vec3d, 3>& vertices, const std::array<Vec3d, 3>& normals) {
  const auto normal = [&](const Vec3d& n) { return frame_.direction(n) * (1 / (scale_ * scale_)); };
  patch({frame_(vertices[0]), frame_(vertices[1]), frame_(vertices[2])},
        {normal(normals[0]), normal(normals[1]), normal(normals[2])});
}

/// A grid on one face of a cube, blown up to the sphere, serves all six faces: it is turned in place before
/// each.
void SceneBuilder::tessellate_sphere(const Vec3d& centre, double radius) {
  const GroupScope together = group();
  const int cells = options_.tessellation;
  std::vector<std::vector<Vec3d>> grid(cells + 1, std::vector<Vec3d>(cells + 1));
  for (int u = 0; u <= cells; ++u)
    for (int v = 0; v <= cells; ++v) {
      const double a = kPi / 4 * (2.0 * u / cells - 1), b = kPi / 4 * (2.0 * v / cells - 1);
      grid[u][v] =
          normalized(Vec3d{std::sin(a) * std::cos(b), -std::cos(a) * std::sin(b), std::cos(a) * std::cos(b)});
    }
  for (int face = 0; face < 6; ++face) {
    for (auto& row : grid)
      for (Vec3d& p : row)
        p = face % 3 == 0   ? Vec3d{-p.z, p.y, p.x}
            : face % 3 == 1 ? Vec3d{-p.y, p.x, p.z}
                            : Vec3d{p.x, -p.z, p.y};
    for (int u = 0; u < cells; ++u)
      for (int v = 0; v < cells; ++v) {
        const Vec3d &q0 = grid[u][v], &q1 = grid[u][v + 1], &q2 = grid[u + 1][v + 1], &q3 = grid[u + 1][v];
        const auto on_sphere = [&](const Vec3d& q) { return centre + q * radius; };
        placed_patch({on_sphere(q0), on_sphere(q1), on_sphere(q2)}, {q0, q1, q2});
        placed_patch({on_sphere(q2), on_sphere(q3), on_sphere(q0)}, {q2, q3, q0});
      }
  }
}

void SceneBuilder::tessellate_cone(const Cone<double>& cone) {
  const GroupScope together = group();
  const Vec3d span = cone.apex - cone.base;
  const double height = length(span);
  const Vec3d axis = span * (1 / height);

  // Start in a direction across the axis, and tilt the normal by the slope of the cone.
  Vec3d start = cross(span, Vec3d{0, 0, 1});
  if (length(start) < 1e-6) start = cross(span, Vec3d{1, 0, 0});
  start = normalized(start);
  const Vec3d tilted = cone.base_radius == cone.apex_radius
                           ? start
                           : normalized(start * height + axis * (cone.base_radius - cone.apex_radius));

  // Walk around the axis, two triangles a facet.
  const int facets = 4 * options_.tessellation;
  double angle = 0;
  Vec3d previous_apex = cone.apex + start * cone.apex_radius;
  Vec3d previous_base = cone.base + start * cone.base_radius;
  Vec3d previous_normal = tilted;
  for (int facet = 0; facet < facets; ++facet) {
    angle += 2 * kPi / facets;
    const Affine turn = rotation(axis, angle);
    const Vec3d around = turn(start);
    const Vec3d apex = cone.apex + around * cone.apex_radius;
    const Vec3d base = cone.base + around * cone.base_radius;
    const Vec3d normal = turn(tilted);
    placed_patch({apex, previous_apex, previous_base}, {normal, previous_normal, previous_normal});
    placed_patch({base, apex, previous_base}, {normal, normal, previous_normal});
    previous_apex = apex, previous_base = base, previous_normal = normal;
  }
}

namespace {

/// By scenes, what their tessellated parts are.
using TessellatedParts = std::map<const Scene*, std::shared_ptr<const Scene>>;

Scene tessellated(const Scene& scene, int tessellation, const TessellatedParts& parts) {
  SceneBuilder builder({.form = SceneForm::patches, .tessellation = tessellation});
  builder.background(scene.background);
  builder.view(scene.view);
  for (const Light& light : scene.lights) builder.light(light.position, light.colour);
  GroupsAgain groups(scene, builder);
  for (std::uint32_t object = 0; object < scene.size(); ++object) {
    groups.before(object);
    const SceneObject& entry = scene.objects[object];
    if (object == 0 || entry.material != scene.objects[object - 1].material)
      builder.material(scene.materials[entry.material]);
    if (entry.kind == ObjectKind::placed) {
      const Placement& placement = scene.placements[entry.index];
      builder.place(parts.at(placement.part.get()), placement.scene_from_part, placement.velocity);
    } else {
      add_again(builder, scene, object);
    }
    groups.behind(object);
  }
  Scene result = std::move(builder).finish();
  result.id = scene.id;
  return result;
}

}  // namespace

Scene tessellated(const Scene& scene, int tessellation) {
  TessellatedParts parts;
  for (const Scene* part : distinct_parts(scene))
    parts.emplace(part, std::make_shared<const Scene>(tessellated(*part, tessellation, parts)));
  return tessellated(scene, tessellation, parts);
}

double patches_of_sphere(const SceneOptions& options) {
  return options.form == SceneForm::patches ? 12.0 * options.tessellation * options.tessellation : 1.0;
}

double patches_of_cone(const SceneOptions& options) {
  return options.form == SceneForm::patches ? 8.0 * options.tessellation : 1.0;
}

double shine_from_highlight_angle(double degrees) {
  if (degrees <= 0) return 100000;
  if (degrees >= 90) return 1;
  return std::log(0.5) / std::log(std::cos(degrees * kPi / 180));
}

}  // namespace rayshoot
