#pragma once

#include <array>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "scenes/core/placed.h"
#include "scenes/core/scene.h"
#include "scenes/geometry/exact.h"
#include "scenes/geometry/intersector.h"
#include "scenes/geometry/watertight.h"

namespace rayshoot {

/// Which side of a cone or cylinder can be hit; spheres, triangles and polygons are always two-sided.
enum class ConeSides { both, outside };

/// How bounds are drawn around objects. tight: as near as allows for rounding. havran: as Havran's tracer GOLEM did, so that
/// structures come out as he published them: exact boxes, but a polygon's is widened by 0.02 on both sides of every axis along
/// which it is thinner than that; the scene's box by 0.001 on every side; triangles without area stay in the scene.
enum class BoundsRule { tight, havran };
inline constexpr std::array<const char*, 2> kBoundsRuleNames = {"tight", "havran"};

/// The ray-object test of an intersector: for a triangle, or for a polygon and its vertices.
template <Intersector kIntersector, class Real>
Real hit_distance(const Triangle<Real>& triangle, const Ray<Real>& ray) {
  if constexpr (kIntersector == Intersector::fast) return hit_distance(triangle, ray);
  if constexpr (kIntersector == Intersector::watertight) return watertight_hit_distance(triangle, ray);
  return exact_hit_distance(triangle, ray);
}
template <class Real, class... Object>
Real hit_distance_by(Intersector intersector, const Ray<Real>& ray, const Object&... object) {
  switch (intersector) {
    case Intersector::fast:
      return hit_distance(object..., ray);
    case Intersector::watertight:
      return watertight_hit_distance(object..., ray);
    case Intersector::exact:
      return exact_hit_distance(object..., ray);
  }
  return kMiss<Real>;
}

/// An object that cannot be traced in a given precision, and why.
struct SetAside {
  /// Its number in the scene.
  std::uint32_t scene_number;
  std::string reason;
};

/// A scene's objects compiled for tracing in one precision. Objects that are not finite, out of range or
/// without area are set aside; the others are numbered 0 to size()-1 in scene order. A placed part is one of them. Immutable.
template <class Real>
class Geometry {
 public:
  explicit Geometry(const Scene& scene, ConeSides cone_sides = ConeSides::both,
                    Intersector intersector = Intersector::fast, BoundsRule bounds_rule = BoundsRule::tight);

  std::uint32_t size() const { return static_cast<std::uint32_t>(references_.size()); }
  /// Whether some objects are placed parts. What hits say are then numbers, which count the objects of parts one by one; they
  /// are the same as objects elsewhere.
  bool has_placed() const { return !placed_.empty(); }
  /// Whether something moves, at any depth.
  bool moves() const { return moves_; }
  std::uint32_t numbers() const { return has_placed() ? first_numbers_.back() : size(); }
  /// The number of an object, or of the first in it.
  std::uint32_t first_number(std::uint32_t object) const {
    return has_placed() ? first_numbers_[object] : object;
  }
  bool triangles_only() const { return mostly_triangles_ && others_ == 0; }
  /// Whether nearly all objects are triangles: these can then be tested without looking up what kind an
  /// object is.
  bool mostly_triangles() const { return mostly_triangles_; }

  /// The ray-object test: the nearest distance in (t_min, t_max] at which the ray meets `object`, or `kMiss`. A placed part
  /// is searched exhaustively.
  Real hit_distance(std::uint32_t object, const Ray<Real>& ray) const;
  /// The same for an object by its number.
  Real hit_distance_of_number(std::uint32_t number, const Ray<Real>& ray) const;
  /// The same where `mostly_triangles()` and for that intersector: the code for other kinds is kept out of the way.
  template <Intersector kIntersector>
  Real triangle_hit_distance(std::uint32_t object, const Ray<Real>& ray) const {
    const Triangle<Real>& triangle = triangles_[object];
    if (std::isnan(triangle.a.x)) [[unlikely]]
      return other_hit_distance(object, ray);
    return rayshoot::hit_distance<kIntersector>(triangle, ray);
  }

  /// Conservative bounds of an object: every hit distance lies in the ray's interval inside them.
  Box<Real> bounds(std::uint32_t object) const;
  /// The same for rays of times between two.
  Box<Real> bounds(std::uint32_t object, Real first_time, Real last_time) const {
    return kind(object) == ObjectKind::placed ? placed(object).box_between(first_time, last_time)
                                              : bounds(object);
  }
  /// The union of all bounds; empty for an empty scene.
  const Box<Real>& bounds() const { return bounds_; }
  /// Whether the object's surface may reach the closed box; exact for triangles, convex polygons and spheres.
  bool overlaps(std::uint32_t object, const Box<Real>& box) const;

  ObjectKind kind(std::uint32_t object) const {
    return static_cast<ObjectKind>(references_[object] >> kIndexBits);
  }
  /// Position of the object among those of its kind.
  std::uint32_t index(std::uint32_t object) const { return references_[object] & kIndexMask; }
  /// The number that an object has in the scene it came from (`Scene::numbers`), by its number here.
  std::uint32_t scene_number(std::uint32_t number) const;

  const Triangle<Real>& triangle(std::uint32_t object) const { return triangles_[index(object)]; }
  const Sphere<Real>& sphere(std::uint32_t object) const { return spheres_[index(object)]; }
  const Cone<Real>& cone(std::uint32_t object) const { return cones_[index(object)]; }
  const Polygon<Real>& polygon(std::uint32_t object) const { return polygons_[index(object)]; }
  std::span<const Vec3<Real>> polygon_vertices(std::uint32_t object) const;
  const Placed<Real>& placed(std::uint32_t object) const { return placed_[index(object)]; }
  friend const std::vector<Placed<Real>>& placements_of(const Geometry& geometry) { return geometry.placed_; }
  /// What is placed at any depth, each part once and behind those that are placed in it.
  std::vector<const Geometry*> distinct_parts() const;
  /// The modeller's hierarchy of these objects, as `Scene::groups`; a group all of whose objects were set aside is
  /// empty. None where the scene states none, or the objects were arranged in another order.
  std::span<const Group> groups() const { return groups_; }
  ConeSides cone_sides() const { return cone_sides_; }
  Intersector intersector() const { return intersector_; }

  BoundsRule bounds_rule() const { return bounds_rule_; }

  const std::vector<SetAside>& set_aside() const { return set_aside_; }
  /// Throws InputError, in the name of `scene`, where there were objects and every one was set aside: a picture of nothing
  /// is not what was asked for.
  void require_objects(const std::string& scene) const;
  /// Of all objects, those of a part once however often it is placed.
  std::size_t bytes() const;

  /// The same objects in another order: object i of the result is object `order[i]` of this geometry. Objects
  /// of a kind lie in memory in that order. Groups, which are ranges of objects, are not kept.
  Geometry arranged(std::span<const std::uint32_t> order) const;
  /// Some of the objects, numbered as in `objects`, as a scene that is divided within `bounds`: they may reach beyond.
  /// Without groups and without a word on what was set aside.
  Geometry part(std::span<const std::uint32_t> objects, const Box<Real>& bounds) const;

 private:
  static constexpr int kIndexBits = 29;
  static constexpr std::uint32_t kIndexMask = (1u << kIndexBits) - 1;

  /// Parts that are compiled: each once, however often it is placed.
  using KnownParts = std::unordered_map<const Scene*, std::shared_ptr<const Geometry>>;

  Geometry() = default;
  Geometry(const Scene& scene, ConeSides cone_sides, Intersector intersector, BoundsRule bounds_rule,
           KnownParts& parts);
  Box<Real> tight_bounds(std::uint32_t object) const;
  [[gnu::noinline, gnu::cold]] Box<Real> havran_bounds(std::uint32_t object) const;
  [[gnu::noinline, gnu::cold]] Real other_hit_distance(std::uint32_t object, const Ray<Real>& ray) const {
    return hit_distance(object, ray);
  }
  template <class Object>
  void append(ObjectKind kind, std::vector<Object>& objects, const Object& object,
              std::uint32_t scene_number);
  std::string try_append(const Scene& scene, std::uint32_t scene_object, KnownParts& parts);
  std::string try_append_placed(const Placement& placement, std::uint32_t scene_number, KnownParts& parts);
  [[gnu::noinline, gnu::cold]] Real placed_hit_distance(const Placed<Real>& placed,
                                                        const Ray<Real>& ray) const;
  std::uint32_t object_of(std::uint32_t number) const;
  std::size_t own_bytes() const;
  void number_objects();

  std::vector<std::uint32_t> references_;
  /// The numbers of the objects in the scene, and here where some object is placed.
  std::vector<std::uint32_t> scene_numbers_, first_numbers_;
  /// By index, and where `mostly_triangles_` is set by object: other objects then have a slot of
  /// not-a-numbers.
  std::vector<Triangle<Real>> triangles_;
  bool mostly_triangles_ = false;
  std::uint32_t others_ = 0;
  std::vector<Sphere<Real>> spheres_;
  std::vector<Cone<Real>> cones_;
  std::vector<Polygon<Real>> polygons_;
  std::vector<Vec3<Real>> vertices_;
  std::vector<Placed<Real>> placed_;
  bool moves_ = false;
  std::vector<Group> groups_;
  Box<Real> bounds_;
  ConeSides cone_sides_ = ConeSides::both;
  Intersector intersector_ = Intersector::fast;
  BoundsRule bounds_rule_ = BoundsRule::tight;
  std::vector<SetAside> set_aside_;
};

template <class Real>
inline std::span<const Vec3<Real>> Geometry<Real>::polygon_vertices(std::uint32_t object) const {
  const Polygon<Real>& p = polygon(object);
  return {vertices_.data() + p.first_vertex, p.vertex_count};
}

template <class Real>
inline Real Geometry<Real>::hit_distance(std::uint32_t object, const Ray<Real>& ray) const {
  switch (kind(object)) {
    case ObjectKind::triangle:
      return hit_distance_by(intersector_, ray, triangle(object));
    case ObjectKind::polygon:
      return hit_distance_by(intersector_, ray, polygon(object), polygon_vertices(object));
    case ObjectKind::sphere:
      return rayshoot::hit_distance(sphere(object), ray);
    case ObjectKind::cone:
      return rayshoot::hit_distance(cone(object), ray, cone_sides_ == ConeSides::outside);
    case ObjectKind::placed:
      return placed_hit_distance(placed(object), ray);
  }
  return kMiss<Real>;
}

template <class Real>
inline Box<Real> Geometry<Real>::bounds(std::uint32_t object) const {
  if (bounds_rule_ == BoundsRule::havran) [[unlikely]]
    return havran_bounds(object);
  return tight_bounds(object);
}

template <class Real>
inline Box<Real> Geometry<Real>::tight_bounds(std::uint32_t object) const {
  switch (kind(object)) {
    case ObjectKind::triangle:
      return rayshoot::bounds(triangle(object));
    case ObjectKind::polygon:
      return rayshoot::bounds(polygon(object));
    case ObjectKind::sphere:
      return rayshoot::bounds(sphere(object));
    case ObjectKind::cone:
      return rayshoot::bounds(cone(object));
    case ObjectKind::placed:
      return placed(object).box_between(0, 1);
  }
  return {};
}

extern template class Geometry<float>;
extern template class Geometry<double>;

}  // namespace rayshoot
