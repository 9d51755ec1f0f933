#pragma once

#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "scenes/core/scene.h"
#include "scenes/geometry/polygon.h"

namespace rayshoot::test {

/// A number that describes a scene, and the magnitude of what it was computed from: for a sum, the sum of the
/// absolute summands. Where summands cancel, their rounding errors are a fraction of that, not of the result.
struct Quantity {
  double value = 0, magnitude = 0;

  Quantity() = default;
  Quantity(double v) : value(v), magnitude(std::abs(v)) {}
  void add(double summand) { value += summand, magnitude += std::abs(summand); }
};

/// Named lists of quantities, for example "polygon_vertex_sum" -> {x, y, z}.
using Aggregates = std::map<std::string, std::vector<Quantity>>;

/// Walks a scene once, in object order, and accumulates what characterises it. A record `p` is a flat
/// triangle or polygon, a `pp` one with vertex normals ("patch").
class Aggregator {
 public:
  explicit Aggregator(const Scene& scene) : scene_(scene) {
    for (std::uint32_t object = 0; object < scene.size(); ++object) visit(object);
    add_header();
    add_bounds();
    at("min_edge").value = min_edge_ == Box<double>::infinity() ? 0 : min_edge_;
    at("min_dot_first3_vs_newell_normal").value = flat_objects_ ? min_normal_dot_ : 0;
    at("max_nonplanarity").value = max_nonplanarity_;
    at("sphere_radius_min").value = scene.spheres.empty() ? 0 : min_radius_;
    at("sphere_radius_max").value = max_radius_;
  }

  const Aggregates& result() const { return result_; }

 private:
  Quantity& at(const std::string& name, std::size_t i = 0) {
    auto& list = result_[name];
    if (list.size() <= i) list.resize(i + 1);
    return list[i];
  }
  void add(const std::string& name, double summand) { at(name).add(summand); }
  void add(const std::string& name, const Vec3d& summand) {
    for (int k = 0; k < 3; ++k) at(name, k).add(summand[k]);
  }
  void add_squares(const std::string& name, const Vec3d& v) { add(name, {v.x * v.x, v.y * v.y, v.z * v.z}); }

  /// The checksum: every number of the file in order, weighted by a hash of its position.
  void weigh(std::initializer_list<double> numbers) {
    for (const double number : numbers) {
      const std::uint64_t hash = position_++ * 2654435761ull;
      add("order_weighted_sum", static_cast<double>(hash % 1000003) / 1000003 * number);
    }
  }

  void visit(std::uint32_t object) {
    add("counts.total", 1);
    const SceneObject& entry = scene_.objects[object];
    if (entry.kind == ObjectKind::sphere) return visit(scene_.spheres[entry.index]);
    if (entry.kind == ObjectKind::cone) return visit(scene_.cones[entry.index]);
    visit_flat(object);
  }

  void visit(const Sphere<double>& sphere) {
    const double r = sphere.radius;
    add("counts.sphere", 1);
    add("sphere_center_sum", sphere.centre), add_squares("sphere_center_sumsq", sphere.centre);
    add("sphere_radius_sum", r), add("sphere_radius_sumsq", r * r), add("sphere_radius_sumcube", r * r * r);
    add("sphere_area", 4 * std::numbers::pi * r * r);
    min_radius_ = std::min(min_radius_, r), max_radius_ = std::max(max_radius_, r);
    weigh({sphere.centre.x, sphere.centre.y, sphere.centre.z, r});
    curved_bounds_.include(exact_bounds(sphere));
  }

  void visit(const Cone<double>& cone) {
    const auto& [base, base_radius, apex, apex_radius] = cone;
    const double height = length(apex - base), slant = std::hypot(height, base_radius - apex_radius);
    add(base_radius == apex_radius ? "counts.cylinder" : "counts.cone", 1);
    add("conecyl_base_sum", base), add_squares("conecyl_base_sumsq", base);
    add("conecyl_apex_sum", apex), add_squares("conecyl_apex_sumsq", apex);
    add("conecyl_base_radius_sum", base_radius), add("conecyl_apex_radius_sum", apex_radius);
    add("conecyl_length_sum", height);
    add("conecyl_lateral_area", std::numbers::pi * (base_radius + apex_radius) * slant);
    weigh({base.x, apex.x, base.y, apex.y, base.z, apex.z, base_radius, apex_radius});
    curved_bounds_.include(exact_bounds(cone));
  }

  void visit_flat(std::uint32_t object) {
    const std::uint32_t first_normal = scene_.objects[object].first_normal;
    const std::string kind = first_normal == kNoObject ? "polygon" : "patch";
    std::vector<Vec3d> vertices;
    for (std::uint32_t i = 0; i < scene_.vertex_count(object); ++i)
      vertices.push_back(scene_.vertex(object, i));

    const Vec3d area = make_polygon<double>(vertices, 0).normal * 0.5;
    const Vec3d normal = normalized(area);
    add("counts." + kind, 1), add(kind + "_vertices", static_cast<double>(vertices.size()));
    add(kind + "_vertex_histogram." + std::to_string(vertices.size()), 1);
    add(kind + "_area", length(area)), add(kind + "_vector_area", area);
    Vec3d previous = vertices.back();
    for (const Vec3d& vertex : vertices) {
      add(kind + "_vertex_sum", vertex), add_squares(kind + "_vertex_sumsq", vertex);
      weigh({vertex.x, vertex.y, vertex.z});
      flat_bounds_.include(vertex);
      min_edge_ = std::min(min_edge_, length(vertex - previous));
      max_nonplanarity_ = std::max(max_nonplanarity_, std::abs(dot(normal, vertex - vertices[0])));
      previous = vertex;
    }
    if (first_normal == kNoObject) {
      const Vec3d first_three = normalized(cross(vertices[1] - vertices[0], vertices[2] - vertices[0]));
      min_normal_dot_ = std::min(min_normal_dot_, dot(first_three, normal));
      flat_objects_ = true;
      return;
    }
    for (std::size_t i = 0; i < vertices.size(); ++i)
      visit_normal(scene_.vertex_normals[first_normal + i], normal);
  }

  void visit_normal(const Vec3d& given, const Vec3d& facet) {
    add("patch_normal_sum", given), add_squares("patch_normal_sumsq", given);
    add("patch_sum_normal_dot_facet", dot(given, facet));
    add("patch_normals_opposing_facet", dot(given, facet) < 0 ? 1 : 0);
  }

  /// What precedes the objects: lights, view, background and materials.
  void add_header() {
    const auto list = [&](const std::string& name, std::initializer_list<double> numbers) {
      for (const double number : numbers) result_[name].push_back(number);
    };
    const auto point = [&](const std::string& name, const Vec3d& p) { list(name, {p.x, p.y, p.z}); };
    const View& view = scene_.view;
    for (const Light& light : scene_.lights) point("lights", light.position);
    point("view.from", view.from), point("view.at", view.at), point("view.up", view.up);
    list("view.angle", {view.angle}), list("view.hither", {view.hither});
    list("view.resolution", {static_cast<double>(view.width), static_cast<double>(view.height)});
    point("background", scene_.background);

    list("n_f_records", {static_cast<double>(scene_.materials.size())});
    std::set<std::array<double, 8>> distinct;
    for (const Material& m : scene_.materials)
      distinct.insert({m.colour.x, m.colour.y, m.colour.z, m.diffuse, m.specular, m.shine, m.transmittance,
                       m.index_of_refraction});
    for (const auto& material : distinct)
      for (const double number : material) list("distinct_materials", {number});
  }

  void add_bounds() {
    const auto box = [&](const std::string& name, const Box<double>& bounds) {
      if (bounds.empty()) return;
      for (int k = 0; k < 3; ++k) at(name + ".min", k) = bounds.lo[k], at(name + ".max", k) = bounds.hi[k];
    };
    box("bbox", scene_.bounds());
    box("bbox_polygons_and_patches", flat_bounds_);
    box("bbox_spheres_cones", curved_bounds_);
  }

  const Scene& scene_;
  Aggregates result_;
  std::uint64_t position_ = 0;
  Box<double> flat_bounds_, curved_bounds_;
  double min_edge_ = Box<double>::infinity(), min_normal_dot_ = 1, max_nonplanarity_ = 0;
  double min_radius_ = Box<double>::infinity(), max_radius_ = 0;
  bool flat_objects_ = false;
};

inline Aggregates aggregates_of(const Scene& scene) { return Aggregator(scene).result(); }

}  // namespace rayshoot::test
