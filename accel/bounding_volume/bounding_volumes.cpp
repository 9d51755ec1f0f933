// Bounding volumes, each about one object (Arvo & Kirk §4.1)
// H. Weghorst, G. Hooper, D. Greenberg, "Improved computational methods for ray tracing", 1984.
//
// Idea       Put every object behind a volume that is simpler to test, and test the object only for rays that meet its
//            volume. Which kind of volume serves best depends on the object's shape: a tight one is met in vain by few
//            rays but may be dear to test. The volume is chosen whose fit times cost is least; where no single one fits,
//            several do together (Figure 6).
// Parameters combination  single takes one volume an object, as the paper did; intersection puts one of another kind behind
//                         it, that which cuts off most for its cost; union bounds the halves of an object each by its
//                         own, where both together fit better
//            fit          enclosed_volume, the paper's measure, from which the void area follows only for objects that
//                         have a volume themselves; projected_area measures that area itself
//            volumes      best chooses; sphere, axis_box, oriented_box or cylinder takes one kind throughout, for
//                         comparison; about halves an axis_box is an oriented_box, which may lie along the axes
// Cost       equation (1): n B + m I, with B and I measured. Every ray tests every volume, so n is the number of rays for each, and m follows
//            from equation (2) for uniform rays. The void area, which a volume projects beyond its object's own, is what
//            makes m greater than it need be; it is reported an object. The event counts are n by kinds, the object
//            tests m. No closed form tells m of composites, and nothing is predicted for these.
// Weak       beyond some dozens of objects, for it is still exhaustive search, with cheaper tests; and for objects that
//            cost little more to test than a volume, as triangles do: these are faster without any.
// Exactness  as bvh_weghorst: volumes are widened ray by ray by what a hit may lie beside its surface.

#include <numbers>

#include "accel/core/define_technique.h"
#include "accel/parts/clipped_bounds.h"
#include "accel/parts/volume_kinds.h"

namespace rayshoot {

namespace {

/// I of equation (1): what a ray-object test costs on average by kind of object, in the unit of B and measured along with
/// it, by exhaustive search. A placed part has no cost of its own.
constexpr double object_test_cost(ObjectKind kind) {
  switch (kind) {
    case ObjectKind::triangle:
      return 1.5;
    case ObjectKind::polygon:
      return 3.0;
    case ObjectKind::sphere:
      return 2.0;
    case ObjectKind::cone:
      return 3.2;
    case ObjectKind::placed:
      break;
  }
  return 0;
}

enum class Combination { single, intersection, union_of_halves };

struct BoundingVolumesConfig {
  Combination combination = Combination::single;
  VolumeFit fit = VolumeFit::enclosed_volume;
  /// The kind of every volume; none to choose.
  std::optional<VolumeKind> kind;
};

/// The surfaces of the two halves of an object, cut across its longest side; none where it has no halves that are simpler
/// to bound.
template <class Real>
std::array<std::vector<SurfaceBall>, 2> halves(const Geometry<Real>& geometry, std::uint32_t object) {
  std::array<std::vector<SurfaceBall>, 2> halves;
  if (geometry.kind(object) == ObjectKind::cone) {
    const Cone<Real>& cone = geometry.cone(object);
    const Vec3d base(cone.base), apex(cone.apex), middle = (base + apex) * 0.5;
    const double radius = 0.5 * (static_cast<double>(cone.base_radius) + cone.apex_radius);
    append_frustum(base, cone.base_radius, middle, radius, halves[0]);
    append_frustum(middle, radius, apex, cone.apex_radius, halves[1]);
    return halves;
  }
  const std::vector<Vec3d> corners = hull_corners(geometry, object);
  Box<double> extent;
  for (const Vec3d& corner : corners) extent.include(corner);
  const int axis = largest_axis(extent.extent());
  for (const int side : {0, 1})
    for (const Vec3d& corner : clipped(corners, axis, side ? -1 : 1, (side ? -1 : 1) * extent.centre()[axis]))
      halves[side].push_back({corner});
  return halves;
}

/// The area that an object shows to a ray on average: by Cauchy's theorem half the area of what is flat, a quarter of the
/// surface of what is convex. A cone counts as closed at both ends.
template <class Real>
double projected_area(const Geometry<Real>& geometry, std::uint32_t object) {
  constexpr double kPi = std::numbers::pi;
  if (geometry.kind(object) == ObjectKind::sphere) {
    const double radius = geometry.sphere(object).radius;
    return kPi * radius * radius;
  }
  if (geometry.kind(object) == ObjectKind::cone) {
    const Cone<Real>& cone = geometry.cone(object);
    const double r = cone.base_radius, s = cone.apex_radius;
    const double slant = std::hypot(length(Vec3d(cone.apex) - Vec3d(cone.base)), r - s);
    return kPi * (r * r + s * s + (r + s) * slant) / 4;
  }
  const std::vector<Vec3d> corners = hull_corners(geometry, object);
  Vec3d twice_area{};
  for (std::size_t i = 2; i < corners.size(); ++i)
    twice_area += cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  return length(twice_area) / 4;
}

template <class Real>
class BoundingVolumes {
 public:
  using Scalar = Real;
  using Config = BoundingVolumesConfig;
  struct Scratch {};

  static TechniqueInfo info() {
    return {.id = "bounding_volumes",
            .title = "Bounding volumes about every object",
            .family = "bounding_volume",
            .survey_section = "4",
            .paper = "Weghorst, Hooper & Greenberg 1984",
            .parameters = {choice_parameter("combination", "single", {"single", "intersection", "union"},
                                            "whether one volume bounds an object, or two together"),
                           choice_parameter("fit", "enclosed_volume", {"enclosed_volume", "projected_area"},
                                            "what is multiplied by the cost of a volume's test to choose it"),
                           volume_kind_parameter()},
            .events = volume_kind_events(),
            .max_practical_objects = 20'000};
  }
  static Config configure(const Arguments& arguments) {
    const std::string& combination = arguments.text("combination");
    Config config{.combination = combination == "single"         ? Combination::single
                                 : combination == "intersection" ? Combination::intersection
                                                                 : Combination::union_of_halves,
                  .fit = arguments.text("fit") == "enclosed_volume" ? VolumeFit::enclosed_volume
                                                                    : VolumeFit::projected_area,
                  .kind = volume_kind(arguments)};
    if (config.combination == Combination::intersection && config.kind)
      throw InputError(
          "bounding_volumes: combination=intersection takes volumes of two kinds; with it leave "
          "volumes at best");
    return config;
  }

  static BoundingVolumes build(const BuildInput<Real>& in, const Config& config) {
    BoundingVolumes technique;
    technique.config_ = config;
    for (std::uint32_t object = 0; object < in.geometry.size(); ++object) {
      // Bound the object by the volume of the best fit for its cost.
      const std::array alone{object};
      const std::array<Volume<Real>, 4> volumes = bounding_volumes<Real>(in.geometry, alone);
      technique.bounds_.push_back({technique.chosen(volumes), {}, Together::alone});

      // Bound it by two together where these do better.
      if (config.combination == Combination::intersection) technique.intersect(volumes);
      if (config.combination == Combination::union_of_halves) technique.unite(halves(in.geometry, object));
      technique.object_cost_ += object_test_cost(in.geometry.kind(object));
      technique.void_area_ +=
          technique.bounds_.back().first.projected_area() - projected_area(in.geometry, object);
    }
    return technique;
  }

  Scratch scratch() const { return {}; }

  /// Test every volume, and the object behind it where the ray meets it.
  template <class Counter, class L>
  void visit(const Ray<Real>& ray, Scratch&, Counter count, L& leaf) const {
    const VolumeRay<Real> prepared(ray);
    const auto meets = [&](const Volume<Real>& volume) {
      count.volume_tests(), count.event(static_cast<std::size_t>(volume.kind));
      const Interval<Real> inside = volume.inside(prepared);
      return std::max(inside.enter, ray.t_min) <= std::min(inside.exit, leaf.reach());
    };
    for (std::uint32_t object = 0; object < bounds_.size(); ++object) {
      const Bound& bound = bounds_[object];
      const bool met = meets(bound.first);
      if (bound.together == Together::alone  ? !met
          : bound.together == Together::both ? !met || !meets(bound.second)
                                             : !met && !meets(bound.second))
        continue;
      count.cell(false);
      if (leaf(object)) return;
    }
  }

  /// Figures: volumes by kind, B and I of equation (1) on average, and the void area an object where one volume bounds it.
  StructureStats structure() const {
    StructureStats stats{.nodes = 0,
                         .leaves = bounds_.size(),
                         .references = bounds_.size(),
                         .bytes = bounds_.size() * sizeof(Bound)};
    for (const char* kind : kVolumeKindNames) stats.figures[kind + std::string("_volumes")] = 0;
    double cost = 0;
    const auto add = [&](const Volume<Real>& volume) {
      ++stats.nodes, cost += volume.relative_cost();
      ++stats.figures[kVolumeKindNames[static_cast<std::size_t>(volume.kind)] + std::string("_volumes")];
    };
    for (const Bound& bound : bounds_) {
      add(bound.first);
      if (bound.together != Together::alone) add(bound.second);
    }
    if (bounds_.empty()) return stats;
    const auto objects = static_cast<double>(bounds_.size());
    stats.figures["mean_volume_cost"] = cost / static_cast<double>(stats.nodes);
    stats.figures["mean_object_cost"] = object_cost_ / objects;
    if (config_.combination == Combination::single)
      stats.figures["void_area_per_object"] = void_area_ / objects;
    return stats;
  }

  /// Equations (1) and (2): n and m of every object for a uniform ray through a box about all volumes.
  std::optional<Prediction<Real>> predicted() const {
    if (config_.combination != Combination::single) return std::nullopt;
    Prediction<Real> sum{0, static_cast<double>(bounds_.size()), {}};
    for (const Bound& bound : bounds_) {
      sum.root.include(bound.first.bounds());
      sum.object_tests += bound.first.surface_area();
    }
    sum.object_tests /= sum.root.surface_area();
    return sum;
  }

  /// A list is a hierarchy of one level.
  template <class Visit>
  void for_each_volume(const Visit& visit) const {
    if (config_.combination != Combination::single || bounds_.empty()) return;
    const auto objects = static_cast<std::uint32_t>(bounds_.size());
    visit(HierarchyVolume{.volume_tests = objects});
    for (std::uint32_t object = 0; object < objects; ++object)
      visit(HierarchyVolume{1, 0, 1, object, object + 1});
  }

 private:
  enum class Together : std::uint8_t { alone, both, either };
  struct Bound {
    Volume<Real> first, second;
    Together together;
  };

  Volume<Real> chosen(std::span<const Volume<Real>> volumes) const {
    if (config_.kind) return volumes[static_cast<std::size_t>(*config_.kind)];
    return cheapest_volume(volumes, config_.fit);
  }
  /// The share of a volume that lies in another, by a lattice of points.
  static double share_in(const Volume<Real>& volume, const Volume<Real>& other) {
    constexpr int kPoints = 8;
    int inside = 0, common = 0;
    for (int i = 0; i < kPoints * kPoints * kPoints; ++i) {
      const auto at = [](int k) { return (2 * k + 1.0) / kPoints - 1; };
      const Vec3d point =
          volume.point({at(i % kPoints), at(i / kPoints % kPoints), at(i / kPoints / kPoints)});
      if (!volume.holds(point)) continue;
      ++inside, common += other.holds(point);
    }
    return inside > 0 ? static_cast<double>(common) / inside : 1;
  }
  double fit_of(const Volume<Real>& volume) const {
    return config_.fit == VolumeFit::enclosed_volume ? volume.enclosed_volume() : volume.projected_area();
  }

  /// Put the volume behind the first of which the first holds the least for its cost, if anything is cut off.
  void intersect(const std::array<Volume<Real>, 4>& volumes) {
    Bound& bound = bounds_.back();
    double least = Box<double>::infinity();
    for (const Volume<Real>& second : volumes) {
      const double share = share_in(bound.first, second);
      if (second.kind == bound.first.kind || share == 1 || share * second.relative_cost() >= least) continue;
      least = share * second.relative_cost();
      bound.second = second, bound.together = Together::both;
    }
  }

  /// Bound each half by a volume of its own where both together fit better, the one first that is met more often.
  void unite(const std::array<std::vector<SurfaceBall>, 2>& halves) {
    std::array<Volume<Real>, 2> volumes;
    for (const int side : {0, 1}) {
      if (halves[side].empty()) return;
      std::array<Volume<Real>, 4> kinds = bounding_volumes<Real>(halves[side], Box<Real>{});
      // A box along the axes would have to be widened ray by ray, as the turned ones are.
      kinds[static_cast<int>(VolumeKind::axis_box)] = kinds[static_cast<int>(VolumeKind::oriented_box)];
      volumes[side] = chosen(kinds);
    }
    if (fit_of(volumes[0]) < fit_of(volumes[1])) std::swap(volumes[0], volumes[1]);
    if (fit_of(volumes[0]) + fit_of(volumes[1]) < fit_of(bounds_.back().first))
      bounds_.back() = {volumes[0], volumes[1], Together::either};
  }

  std::vector<Bound> bounds_;
  Config config_;
  /// Summed over the objects.
  double object_cost_ = 0, void_area_ = 0;
};

}  // namespace

RAYSHOOT_TECHNIQUE(bounding_volumes, BoundingVolumes)

}  // namespace rayshoot
