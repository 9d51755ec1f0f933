#include "scenes/core/scene.h"

#include <fmt/format.h>

#include <map>
#include <span>

#include "scenes/core/digest.h"
#include "scenes/geometry/polygon.h"

namespace rayshoot {

std::uint32_t Scene::vertex_count(std::uint32_t object) const {
  const SceneObject& entry = objects[object];
  return entry.kind == ObjectKind::triangle ? 3 : polygons[entry.index].vertex_count;
}

const Vec3d& Scene::vertex(std::uint32_t object, std::uint32_t corner) const {
  const SceneObject& entry = objects[object];
  if (entry.kind == ObjectKind::polygon) return polygon_vertices[polygons[entry.index].first_vertex + corner];
  const Triangle<double>& triangle = triangles[entry.index];
  return corner == 0 ? triangle.a : corner == 1 ? triangle.b : triangle.c;
}

const Material& Scene::material_of(std::uint32_t number) const {
  const ObjectInPart found = object_in_part(*this, number);
  return found.scene->materials[found.scene->objects[found.object].material];
}

namespace {

/// What `of(scene, parts)` says of a scene, which asks for what it said of the parts placed there: of each once.
template <class Value, class Of>
Value from_parts_up(const Scene& whole, const Of& of) {
  std::map<const Scene*, Value> parts;
  for (const Scene* part : distinct_parts(whole)) parts.emplace(part, of(*part, parts));
  return of(whole, parts);
}

Box<double> bounds_of_own(const Scene& scene) {
  Box<double> all;
  const auto include = [&](std::span<const Vec3d> points, const Box<double>& box) {
    if (std::all_of(points.begin(), points.end(), in_range<double>) && !box.empty()) all.include(box);
  };
  const auto include_flat = [&](std::span<const Vec3d> vertices) {
    Box<double> box;
    for (const Vec3d& vertex : vertices) box.include(vertex);
    include(vertices, box);
  };
  for (const auto& [a, b, c] : scene.triangles) include_flat(std::array{a, b, c});
  for (const VertexRange& range : scene.polygons)
    include_flat(std::span(scene.polygon_vertices).subspan(range.first_vertex, range.vertex_count));
  for (const Sphere<double>& sphere : scene.spheres)
    include(std::array{sphere.centre, Vec3d{sphere.radius, 0, 0}}, exact_bounds(sphere));
  for (const Cone<double>& cone : scene.cones)
    include(std::array{cone.base, cone.apex, Vec3d{cone.base_radius, cone.apex_radius, 0}},
            exact_bounds(cone));
  return all;
}

/// The bounds of a scene whose parts' bounds are known.
Box<double> bounds_of(const Scene& scene, const std::map<const Scene*, Box<double>>& parts) {
  Box<double> all = bounds_of_own(scene);
  for (const Placement& placement : scene.placements) {
    const Box<double> box = image(placement.scene_from_part, parts.at(placement.part.get()));
    if (box.empty() || !in_range<double>(box.lo) || !in_range<double>(box.hi) ||
        !in_range<double>(placement.velocity))
      continue;
    all.include(box);
    all.include({box.lo + placement.velocity, box.hi + placement.velocity});
  }
  return all;
}

}  // namespace

Box<double> Scene::bounds() const { return from_parts_up<Box<double>>(*this, bounds_of); }

ObjectCounts Scene::counts() const {
  return from_parts_up<ObjectCounts>(*this, [](const Scene& scene, const auto& parts) {
    ObjectCounts counts = {scene.triangles.size(), scene.polygons.size(), scene.spheres.size(),
                           scene.cones.size(), scene.placements.size()};
    for (const Placement& placement : scene.placements)
      for (std::size_t kind = 0; kind < counts.size(); ++kind)
        counts[kind] += parts.at(placement.part.get())[kind];
    return counts;
  });
}

namespace {

bool same_own_content(const Scene& a, const Scene& b) {
  return a.background == b.background && a.view == b.view && a.lights == b.lights &&
         a.materials == b.materials && a.objects == b.objects && a.triangles == b.triangles &&
         a.polygons == b.polygons && a.polygon_vertices == b.polygon_vertices && a.spheres == b.spheres &&
         a.cones == b.cones && a.vertex_normals == b.vertex_normals;
}

}  // namespace

bool same_content(const Scene& a, const Scene& b) {
  // Scenes are the same where their parts are, in the order in which they come up, and the same of these is placed.
  const std::vector<const Scene*> parts_of_a = distinct_parts(a), parts_of_b = distinct_parts(b);
  if (parts_of_a.size() != parts_of_b.size()) return false;
  std::map<const Scene*, const Scene*> counterparts;
  const auto same = [&](const Scene& one, const Scene& other) {
    const auto same_placement = [&](const Placement& p, const Placement& q) {
      return counterparts.at(p.part.get()) == q.part.get() && p.scene_from_part == q.scene_from_part &&
             p.velocity == q.velocity;
    };
    return same_own_content(one, other) &&
           std::equal(one.placements.begin(), one.placements.end(), other.placements.begin(),
                      other.placements.end(), same_placement);
  };
  for (std::size_t i = 0; i < parts_of_a.size(); ++i) {
    if (!same(*parts_of_a[i], *parts_of_b[i])) return false;
    counterparts.emplace(parts_of_a[i], parts_of_b[i]);
  }
  return same(a, b);
}

namespace {

void add_own_content(Digest& digest, const Scene& scene) {
  const View& view = scene.view;
  digest.add(scene.background), digest.add(view.from), digest.add(view.at), digest.add(view.up);
  digest.add(std::array{view.angle, view.hither}), digest.add(std::array{view.width, view.height});
  for (const Light& light : scene.lights) {
    digest.add(light.position);
    if (light.colour) digest.add(*light.colour);
  }
  for (const SceneObject& object : scene.objects)
    digest.add(std::array{static_cast<std::uint32_t>(object.kind), object.index, object.material,
                          object.first_normal});
  digest.add_all(scene.triangles), digest.add_all(scene.polygons), digest.add_all(scene.polygon_vertices);
  digest.add_all(scene.spheres), digest.add_all(scene.cones), digest.add_all(scene.vertex_normals);
  for (const Material& material : scene.materials) digest.add(material);
}

}  // namespace

std::string scene_hash(const Scene& scene) {
  return from_parts_up<Digest>(scene,
                               [](const Scene& one, const auto& parts) {
                                 Digest digest;
                                 add_own_content(digest, one);
                                 for (const Placement& placement : one.placements) {
                                   digest.add(parts.at(placement.part.get()).value());
                                   digest.add(placement.scene_from_part), digest.add(placement.velocity);
                                 }
                                 return digest;
                               })
      .hex();
}

namespace {

/// Barycentric weights of `point` in the projection of a triangle onto its dominant plane.
Vec3d barycentric(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& point) {
  const Vec3d normal = cross(b - a, c - a);
  const double whole = dot(normal, normal);
  const double weight_b = dot(cross(point - a, c - a), normal) / whole;
  const double weight_c = dot(cross(b - a, point - a), normal) / whole;
  return {1 - weight_b - weight_c, weight_b, weight_c};
}

Vec3d flat_normal(const Scene& scene, std::uint32_t object) {
  const std::uint32_t count = scene.vertex_count(object);
  const Vec3d& anchor = scene.vertex(object, 0);
  Vec3d sum{};
  for (std::uint32_t corner = 1; corner + 1 < count; ++corner)
    sum += cross(scene.vertex(object, corner) - anchor, scene.vertex(object, corner + 1) - anchor);
  return normalized(sum);
}

Vec3d smooth_normal(const Scene& scene, std::uint32_t object, const Vec3d& point) {
  // Interpolate within the fan triangle about vertex 0 that holds the point best.
  const Vec3d* normals = &scene.vertex_normals[scene.objects[object].first_normal];
  Vec3d best{};
  double best_least_weight = -Box<double>::infinity();
  for (std::uint32_t corner = 1; corner + 1 < scene.vertex_count(object); ++corner) {
    const Vec3d w = barycentric(scene.vertex(object, 0), scene.vertex(object, corner),
                                scene.vertex(object, corner + 1), point);
    const double least = std::min({w.x, w.y, w.z});
    if (least <= best_least_weight) continue;
    best_least_weight = least;
    best = normals[0] * w.x + normals[corner] * w.y + normals[corner + 1] * w.z;
  }
  return normalized(best);
}

Vec3d cone_normal(const Cone<double>& cone, const Vec3d& point) {
  const Vec3d span = cone.apex - cone.base;
  const double height = length(span);
  const Vec3d axis = span * (1 / height);
  const Vec3d aside = (point - cone.base) - axis * dot(point - cone.base, axis);
  return normalized(normalized(aside) + axis * ((cone.base_radius - cone.apex_radius) / height));
}

Vec3d own_normal(const Scene& scene, std::uint32_t object, const Vec3d& point, bool smooth) {
  const SceneObject& entry = scene.objects[object];
  switch (entry.kind) {
    case ObjectKind::sphere:
      return normalized(point - scene.spheres[entry.index].centre);
    case ObjectKind::cone:
      return cone_normal(scene.cones[entry.index], point);
    default:
      break;
  }
  const bool interpolate = smooth && entry.first_normal != kNoObject;
  return interpolate ? smooth_normal(scene, object, point) : flat_normal(scene, object);
}

}  // namespace

Vec3d surface_normal(const Scene& scene, std::uint32_t number, const Vec3d& point, bool smooth, double time) {
  const ObjectInPart found = object_in_part(scene, number, point, time);
  return found.normal_outside(own_normal(*found.scene, found.object, found.point, smooth));
}

}  // namespace rayshoot
