#include "scenes/rays/ray_tree_rules.h"

#include "scenes/core/spec.h"

namespace rayshoot {

const std::vector<RayTreeRules>& all_ray_tree_rules() {
  static const std::vector<RayTreeRules> rules = {
      {.id = "clean", .description = "a correct tracer on a grid from edge to edge"},
      {.id = "haines",
       .description = "Haines' package: rays through the pixel corners of a 512 x 512 image",
       .grid = PixelGrid::pixel_corners_512},
      // Inferred from the counts that Havran published: they follow from these conventions and from no others
      // tried.
      {.id = "havran",
       .description =
           "Havran's GOLEM: epsilon 0.01, light on outward sides alone, cones met from outside alone",
       .epsilon = 0.01,
       .epsilon_adapts = false,
       .normals_face_the_ray = false,
       .cone_sides = ConeSides::outside,
       .tilts_cone_normals_by_base = true}};
  return rules;
}

const RayTreeRules& ray_tree_rules(const std::string& id) {
  std::vector<std::string> known;
  for (const RayTreeRules& rules : all_ray_tree_rules()) {
    if (rules.id == id) return rules;
    known.push_back(rules.id);
  }
  throw InputError(unknown_name("rules", id, known));
}

namespace {

Vec3d normal_tilted_by_base(const Cone<double>& cone, const Vec3d& point) {
  const Vec3d axis = normalized(cone.apex - cone.base);
  const Vec3d aside = (point - cone.base) - axis * dot(point - cone.base, axis);
  return normalized(normalized(aside) + axis * ((cone.base_radius - cone.apex_radius) / cone.base_radius));
}

}  // namespace

Vec3d outward_normal(const RayTreeRules& rules, const Scene& scene, std::uint32_t number, const Vec3d& point,
                     double time) {
  const ObjectInPart met = object_in_part(scene, number, point, time);
  const SceneObject& entry = met.scene->objects[met.object];
  const bool tilted = entry.kind == ObjectKind::cone && rules.tilts_cone_normals_by_base;
  const Vec3d normal =
      tilted ? met.normal_outside(normal_tilted_by_base(met.scene->cones[entry.index], met.point))
             : surface_normal(scene, number, point, true, time);
  if (is_finite(normal)) return normal;
  const Vec3d flat = surface_normal(scene, number, point, false, time);
  return is_finite(flat) ? flat : Vec3d{0, 0, 1};
}

double first_distance(const RayTreeRules& rules, double scene_diagonal, const Vec3d& origin) {
  if (!rules.epsilon_adapts) return rules.epsilon;
  const double rounding = 32 * std::numeric_limits<double>::epsilon() * max_abs(origin);
  return std::max(rules.epsilon * std::min(1.0, scene_diagonal), rounding);
}

}  // namespace rayshoot
