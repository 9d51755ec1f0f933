#include "scenes/core/geometry.h"

#include <fmt/format.h>

#include "scenes/core/spec.h"
#include "scenes/geometry/overlap.h"

namespace rayshoot {

namespace {

/// What Havran's boxes add (V. Havran, statistics of the SPD, 1999; found by reproducing his counts).
constexpr double kThinPolygon = 0.02, kWidening = 0.02, kScenePadding = 0.001;

/// Why a set of coordinates cannot be traced in `Real`; empty when it can.
template <class Real>
std::string unusable(std::initializer_list<Vec3d> points) {
  for (const Vec3d& point : points) {
    if (!is_finite(point)) return "not finite";
    if (!in_range<Real>(point)) return "out of range";
  }
  return {};
}

template <class Real>
std::string unusable(const Triangle<Real>& triangle) {
  return double_area_vector(triangle) == Vec3d{} ? "zero area" : "";
}

template <class Real>
std::string unusable(const Sphere<Real>& sphere) {
  return sphere.radius > 0 ? "" : "radius is not positive";
}

template <class Real>
std::string unusable(const Cone<Real>& cone) {
  if (!(cone.base_radius >= 0 && cone.apex_radius >= 0)) return "radius is negative";
  if (cone.base_radius == 0 && cone.apex_radius == 0) return "zero area";
  const double height = length(Vec3d(cone.apex) - Vec3d(cone.base));
  return height > 0 && std::isfinite(1 / height) ? "" : "zero height";
}

template <class Real>
Sphere<Real> rounded(const Sphere<double>& sphere) {
  return {Vec3<Real>(sphere.centre), static_cast<Real>(sphere.radius)};
}

template <class Real>
Cone<Real> rounded(const Cone<double>& cone) {
  return {Vec3<Real>(cone.base), static_cast<Real>(cone.base_radius), Vec3<Real>(cone.apex),
          static_cast<Real>(cone.apex_radius)};
}

}  // namespace

template <class Real>
Geometry<Real>::Geometry(const Scene& scene, ConeSides cone_sides, Intersector intersector,
                         BoundsRule bounds_rule) {
  KnownParts parts;
  *this = Geometry(scene, cone_sides, intersector, bounds_rule, parts);
}

template <class Real>
Geometry<Real>::Geometry(const Scene& scene, ConeSides cone_sides, Intersector intersector,
                         BoundsRule bounds_rule, KnownParts& parts)
    : mostly_triangles_(8 * scene.triangles.size() >= 7 * scene.objects.size() && scene.placements.empty()),
      cone_sides_(cone_sides),
      intersector_(intersector),
      bounds_rule_(bounds_rule) {
  references_.reserve(scene.objects.size());
  scene_numbers_.reserve(scene.objects.size());
  triangles_.reserve(scene.triangles.size());
  for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
    const std::string reason = try_append(scene, object, parts);
    if (!reason.empty()) set_aside_.push_back({scene.first_number(object), reason});
  }
  number_objects();
  for (std::uint32_t object = 0; object < size(); ++object) bounds_.include(bounds(object));
  if (bounds_rule == BoundsRule::havran && size() > 0) {
    const auto pad = static_cast<Real>(kScenePadding);
    bounds_ = {bounds_.lo - Vec3<Real>{pad, pad, pad}, bounds_.hi + Vec3<Real>{pad, pad, pad}};
  }

  // Renumber the groups by how many objects stand before each scene object.
  const auto renumbered = [&](std::uint32_t scene_object) {
    const std::uint32_t number = scene_object < scene.size() ? scene.first_number(scene_object)
                                                             : static_cast<std::uint32_t>(scene.numbers());
    const auto found = std::lower_bound(scene_numbers_.begin(), scene_numbers_.end(), number);
    return static_cast<std::uint32_t>(found - scene_numbers_.begin());
  };
  for (const Group& group : scene.groups)
    groups_.push_back({renumbered(group.first), renumbered(group.last), group.end});
}

template <class Real>
template <class Object>
void Geometry<Real>::append(ObjectKind kind, std::vector<Object>& objects, const Object& object,
                            std::uint32_t scene_number) {
  references_.push_back(static_cast<std::uint32_t>(kind) << kIndexBits |
                        static_cast<std::uint32_t>(objects.size()));
  scene_numbers_.push_back(scene_number);
  objects.push_back(object);
  if (kind == ObjectKind::triangle) return;
  ++others_;
  constexpr Real nan = std::numeric_limits<Real>::quiet_NaN();
  if (mostly_triangles_) triangles_.push_back({{nan, nan, nan}, {nan, nan, nan}, {nan, nan, nan}});
}

/// Append one object of the scene unless it is unusable; returns the reason in that case.
template <class Real>
std::string Geometry<Real>::try_append(const Scene& scene, std::uint32_t scene_object, KnownParts& parts) {
  const std::uint32_t scene_number = scene.first_number(scene_object);
  // GOLEM kept triangles without area, which no ray hits.
  const bool area_matters = bounds_rule_ == BoundsRule::tight;
  const auto append_if_usable = [&](auto& objects, ObjectKind kind, const auto& object, std::string reason) {
    if (reason.empty() && (area_matters || kind != ObjectKind::triangle)) reason = unusable(object);
    if (reason.empty()) append(kind, objects, object, scene_number);
    return reason;
  };
  const SceneObject& entry = scene.objects[scene_object];
  switch (entry.kind) {
    case ObjectKind::triangle: {
      const auto& [a, b, c] = scene.triangles[entry.index];
      return append_if_usable(triangles_, entry.kind,
                              Triangle<Real>{Vec3<Real>(a), Vec3<Real>(b), Vec3<Real>(c)},
                              unusable<Real>({a, b, c}));
    }
    case ObjectKind::sphere: {
      const Sphere<double>& sphere = scene.spheres[entry.index];
      return append_if_usable(spheres_, entry.kind, rounded<Real>(sphere),
                              unusable<Real>({sphere.centre, {sphere.radius, 0, 0}}));
    }
    case ObjectKind::cone: {
      const Cone<double>& cone = scene.cones[entry.index];
      return append_if_usable(
          cones_, entry.kind, rounded<Real>(cone),
          unusable<Real>({cone.base, cone.apex, {cone.base_radius, cone.apex_radius, 0}}));
    }
    case ObjectKind::placed:
      return try_append_placed(scene.placements[entry.index], scene_number, parts);
    case ObjectKind::polygon:
      break;
  }

  const VertexRange& range = scene.polygons[entry.index];
  const auto first = static_cast<std::uint32_t>(vertices_.size());
  for (std::uint32_t corner = 0; corner < range.vertex_count; ++corner) {
    const Vec3d& vertex = scene.polygon_vertices[range.first_vertex + corner];
    const std::string reason = unusable<Real>({vertex});
    if (!reason.empty()) {
      vertices_.resize(first);
      return reason;
    }
    vertices_.push_back(Vec3<Real>(vertex));
  }
  if (range.vertex_count < 3) {
    vertices_.resize(first);
    return "fewer than 3 vertices";
  }
  const Polygon<Real> polygon = make_polygon<Real>({vertices_.data() + first, range.vertex_count}, first);
  if (polygon.normal == Vec3d{}) {
    vertices_.resize(first);
    return "zero area";
  }
  append(ObjectKind::polygon, polygons_, polygon, scene_number);
  return {};
}

template <class Real>
std::string Geometry<Real>::try_append_placed(const Placement& placement, std::uint32_t scene_number,
                                              KnownParts& parts) {
  std::shared_ptr<const Geometry>& part = parts[placement.part.get()];
  if (!part) {
    part.reset(new Geometry(*placement.part, cone_sides_, intersector_, bounds_rule_, parts));
    // What is wrong with a part is said once, of its first placement.
    for (const SetAside& aside : part->set_aside_)
      set_aside_.push_back({scene_number + aside.scene_number, aside.reason});
  }
  if (part->size() == 0) return "its part has nothing that can be traced";
  const Box<double> box =
      image(placement.scene_from_part, {Vec3d(part->bounds().lo), Vec3d(part->bounds().hi)});
  const Affine inward = inverse(placement.scene_from_part);
  for (const Vec3d& row : {inward.x, inward.y, inward.z, inward.offset})
    if (!is_finite(row)) return "its place cannot be undone";
  const std::string reason =
      unusable<Real>({box.lo, box.hi, box.lo + placement.velocity, box.hi + placement.velocity});
  if (!reason.empty()) return reason;
  append(ObjectKind::placed, placed_,
         Placed<Real>{part, inward, padded(Box<Real>{Vec3<Real>(box.lo), Vec3<Real>(box.hi)}, kPlacingUlps),
                      Vec3<Real>(placement.velocity)},
         scene_number);
  moves_ |= placement.moves() || part->moves_;
  return {};
}

/// Number the objects of placed parts one by one.
template <class Real>
void Geometry<Real>::number_objects() {
  if (!has_placed()) return;
  first_numbers_ = {0};
  for (std::uint32_t object = 0; object < size(); ++object)
    first_numbers_.push_back(first_numbers_.back() +
                             (kind(object) == ObjectKind::placed ? placed(object).part->numbers() : 1));
}

template <class Real>
std::uint32_t Geometry<Real>::object_of(std::uint32_t number) const {
  if (!has_placed()) return number;
  const auto behind = std::upper_bound(first_numbers_.begin(), first_numbers_.end(), number);
  return static_cast<std::uint32_t>(behind - first_numbers_.begin() - 1);
}

template <class Real>
std::uint32_t Geometry<Real>::scene_number(std::uint32_t number) const {
  const std::uint32_t object = object_of(number);
  if (kind(object) != ObjectKind::placed) return scene_numbers_[object];
  return scene_numbers_[object] + placed(object).part->scene_number(number - first_numbers_[object]);
}

template <class Real>
Real Geometry<Real>::hit_distance_of_number(std::uint32_t number, const Ray<Real>& ray) const {
  const std::uint32_t object = object_of(number);
  if (kind(object) != ObjectKind::placed) return hit_distance(object, ray);
  const Placed<Real>& placed = this->placed(object);
  const Real t = placed.part->hit_distance_of_number(number - first_numbers_[object], placed.inside(ray));
  return counts_within(t, placed.interval(ray)) ? t : kMiss<Real>;
}

template <class Real>
Real Geometry<Real>::placed_hit_distance(const Placed<Real>& placed, const Ray<Real>& ray) const {
  const Interval<Real> interval = placed.interval(ray);
  const Ray<Real> inside = placed.inside(ray);
  Real nearest = kMiss<Real>;
  for (std::uint32_t object = 0; object < placed.part->size(); ++object)
    if (const Real t = placed.part->hit_distance(object, inside); counts_within(t, interval))
      nearest = std::min(nearest, t);
  return nearest;
}

template <class Real>
Box<Real> Geometry<Real>::havran_bounds(std::uint32_t object) const {
  Box<Real> box;
  switch (kind(object)) {
    case ObjectKind::sphere:
      return exact_bounds(sphere(object));
    case ObjectKind::cone: {
      const Box<double> exact = exact_bounds(cone(object));
      return {Vec3<Real>(exact.lo), Vec3<Real>(exact.hi)};
    }
    case ObjectKind::triangle:
      for (const Vec3<Real>& vertex : {triangle(object).a, triangle(object).b, triangle(object).c})
        box.include(vertex);
      break;
    case ObjectKind::polygon:
      for (const Vec3<Real>& vertex : polygon_vertices(object)) box.include(vertex);
      break;
    case ObjectKind::placed:
      return tight_bounds(object);
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (!(box.hi[axis] - box.lo[axis] < static_cast<Real>(kThinPolygon))) continue;
    box.lo[axis] -= static_cast<Real>(kWidening);
    box.hi[axis] += static_cast<Real>(kWidening);
  }
  return box;
}

template <class Real>
void Geometry<Real>::require_objects(const std::string& scene) const {
  if (size() > 0 || set_aside_.empty()) return;
  throw InputError(fmt::format("{}: every object is out of range or without area in {}: refused", scene,
                               std::is_same_v<Real, float> ? "float" : "double"));
}

template <class Real>
bool Geometry<Real>::overlaps(std::uint32_t object, const Box<Real>& box) const {
  if (!bounds(object).overlaps(box)) return false;
  switch (kind(object)) {
    case ObjectKind::triangle:
      return surface_overlaps(triangle(object), box);
    case ObjectKind::polygon:
      return surface_overlaps(polygon(object), polygon_vertices(object), box);
    case ObjectKind::sphere:
      return surface_overlaps(sphere(object), box);
    case ObjectKind::cone:
      return surface_overlaps(cone(object), box);
    case ObjectKind::placed:
      return true;
  }
  return false;
}

template <class Real>
std::vector<const Geometry<Real>*> Geometry<Real>::distinct_parts() const {
  std::unordered_set<const Geometry*> known;
  std::vector<const Geometry*> parts;
  append_parts(*this, known, parts);
  return parts;
}

template <class Real>
std::size_t Geometry<Real>::bytes() const {
  std::size_t bytes = own_bytes();
  for (const Geometry* part : distinct_parts()) bytes += part->own_bytes();
  return bytes;
}

template <class Real>
std::size_t Geometry<Real>::own_bytes() const {
  const auto size_of = [](const auto& objects) { return objects.size() * sizeof(objects[0]); };
  return size_of(references_) + size_of(scene_numbers_) + size_of(first_numbers_) + size_of(triangles_) +
         size_of(spheres_) + size_of(cones_) + size_of(polygons_) + size_of(vertices_) + size_of(placed_) +
         size_of(groups_);
}

template <class Real>
Geometry<Real> Geometry<Real>::arranged(std::span<const std::uint32_t> order) const {
  Geometry result = part(order, bounds_);
  result.set_aside_ = set_aside_;
  return result;
}

template <class Real>
Geometry<Real> Geometry<Real>::part(std::span<const std::uint32_t> objects, const Box<Real>& bounds) const {
  Geometry result;
  result.bounds_ = bounds;
  result.cone_sides_ = cone_sides_;
  result.intersector_ = intersector_;
  result.bounds_rule_ = bounds_rule_;
  result.mostly_triangles_ = mostly_triangles_;
  result.references_.reserve(objects.size());
  result.scene_numbers_.reserve(objects.size());
  result.triangles_.reserve(std::min(objects.size(), triangles_.size()));
  for (const std::uint32_t object : objects) {
    const std::uint32_t origin = scene_numbers_[object];
    switch (kind(object)) {
      case ObjectKind::triangle:
        result.append(kind(object), result.triangles_, triangle(object), origin);
        break;
      case ObjectKind::polygon: {
        Polygon<Real> polygon = this->polygon(object);
        const std::span<const Vec3<Real>> vertices = polygon_vertices(object);
        polygon.first_vertex = static_cast<std::uint32_t>(result.vertices_.size());
        result.vertices_.insert(result.vertices_.end(), vertices.begin(), vertices.end());
        result.append(kind(object), result.polygons_, polygon, origin);
        break;
      }
      case ObjectKind::sphere:
        result.append(kind(object), result.spheres_, sphere(object), origin);
        break;
      case ObjectKind::cone:
        result.append(kind(object), result.cones_, cone(object), origin);
        break;
      case ObjectKind::placed:
        result.append(kind(object), result.placed_, placed(object), origin);
        result.moves_ |= placed(object).moves() || placed(object).part->moves_;
        break;
    }
  }
  result.number_objects();
  return result;
}

template class Geometry<float>;
template class Geometry<double>;

}  // namespace rayshoot
