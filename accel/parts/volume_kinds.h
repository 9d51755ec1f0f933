#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scenes/core/geometry.h"

namespace rayshoot {

/// The kinds of bounding volumes among which Weghorst, Hooper and Greenberg (1984) choose.
enum class VolumeKind : std::uint8_t { sphere, axis_box, oriented_box, cylinder };
inline constexpr std::array kVolumeKindNames = {"sphere", "axis_box", "oriented_box", "cylinder"};

/// B of equation (1): what a ray-volume test of each kind costs, in tests of an axis-aligned box. By the arithmetic of
/// `Volume::inside`: a sphere's needs as much, an oriented box's turns two vectors first, a cylinder's does that and
/// solves a quadratic.
inline constexpr std::array kVolumeTestCost = {1.0, 1.0, 2.0, 2.5};

/// A ray prepared for volumes of every kind. Turning it and solving for it is done in double precision, with a
/// direction whose largest component is 1.
template <class Real>
struct VolumeRay {
  Crossings<Real> crossings;
  Vec3d origin, direction;
  /// Parameter of the ray by a unit of way along `direction`.
  double parameter_scale;
  /// Whether rounding can be bounded; of other rays, those not finite or of a direction so short or so long that its
  /// inverse is no measure any more, a turned volume knows nothing.
  bool ordinary;

  explicit VolumeRay(const Ray<Real>& ray) : crossings(ray), origin(ray.origin) {
    using Limits = std::numeric_limits<Real>;
    const Real length = max_abs(ray.direction);
    ordinary = is_finite(ray.direction) && length >= Limits::min() / Limits::epsilon() * 8 &&
               length <= Limits::max() * Limits::epsilon() / 8 && in_range<double>(origin);
    parameter_scale = 1 / static_cast<double>(length);
    direction = Vec3d(ray.direction) * parameter_scale;
  }
};

/// A closed convex volume about some objects. `inside` errs to the wide side: the distance of every hit of an object in
/// it lies in the interval that it returns.
template <class Real>
struct Volume {
  VolumeKind kind = VolumeKind::axis_box;
  /// An axis-aligned box: its two corners. The others: the centre, and half the extent along each of `axes`; a
  /// sphere's first one is its radius, a cylinder's are half its height and twice its radius.
  std::array<Vec3d, 2> place{};
  /// Unit vectors of an oriented box; of a cylinder the first is its axis.
  std::array<Vec3d, 3> axes{};

  const Vec3d& centre() const { return place[0]; }
  const Vec3d& half() const { return place[1]; }

  /// The parameters at which a ray may be inside, regardless of the ray's own ends; empty when enter > exit.
  Interval<Real> inside(const VolumeRay<Real>& ray) const {
    if (kind == VolumeKind::axis_box)
      return ray.crossings.inside(Box<Real>{Vec3<Real>(place[0]), Vec3<Real>(place[1])});
    if (!ray.ordinary) [[unlikely]]
      return {-Box<Real>::infinity(), Box<Real>::infinity()};
    const Vec3d origin = ray.origin - centre();
    const double way = std::abs(origin.x) + std::abs(origin.y) + std::abs(origin.z);
    const double margin = kSurfaceError * (way + half().x + half().y + half().z);
    const Interval<double> s = kind == VolumeKind::sphere ? inside_sphere(origin, ray.direction, margin)
                               : kind == VolumeKind::oriented_box
                                   ? inside_box(origin, ray.direction, margin)
                                   : inside_cylinder(origin, ray.direction, margin);
    return {static_cast<Real>(s.enter * ray.parameter_scale),
            static_cast<Real>(s.exit * ray.parameter_scale)};
  }

  /// Surface area S of equation (2); a quarter of it is the area projected on average (Cauchy).
  double surface_area() const;
  double projected_area() const { return surface_area() / 4; }
  /// B of equation (1).
  double relative_cost() const { return kVolumeTestCost[static_cast<std::size_t>(kind)]; }

 private:
  /// How far a hit may lie beside the surface, and the ray beside the turned ray, by the way from the ray's origin.
  /// Single precision rounds a distance that was computed in double; in double the object test itself counts, which
  /// is least exact where a ray grazes a surface or an object is a needle.
  static constexpr double kSurfaceError =
      std::max(8.0 * static_cast<double>(std::numeric_limits<Real>::epsilon()),
               1048576 * std::numeric_limits<double>::epsilon());
  static constexpr Interval<double> kNowhere{1, -1};
  static constexpr Interval<double> kEverywhere{-Box<double>::infinity(), Box<double>::infinity()};

  /// Between two parallel planes at `half` from the centre, for a ray at `along` that moves by `step`.
  static Interval<double> between(double along, double step, double half) {
    if (step == 0) return std::abs(along) <= half ? kEverywhere : kNowhere;
    const double first = (-half - along) / step, second = (half - along) / step;
    return step > 0 ? Interval<double>{first, second} : Interval<double>{second, first};
  }
  static Interval<double> common(const Interval<double>& a, const Interval<double>& b) {
    return {std::max(a.enter, b.enter), std::min(a.exit, b.exit)};
  }
  /// Within `radius` of the centre, in space or in a plane, about the point of nearest approach.
  static Interval<double> within(const Vec3d& origin, const Vec3d& direction, double radius) {
    const double speed = dot(direction, direction);
    if (!(speed > 0)) return dot(origin, origin) <= radius * radius ? kEverywhere : kNowhere;
    const double nearest = -dot(origin, direction) / speed;
    const Vec3d aside = origin + direction * nearest;
    const double rest = radius * radius - dot(aside, aside);
    if (rest < 0) return kNowhere;
    const double half_chord = std::sqrt(rest / speed);
    return {nearest - half_chord, nearest + half_chord};
  }

  Interval<double> inside_sphere(const Vec3d& origin, const Vec3d& direction, double margin) const {
    return within(origin, direction, half().x + margin);
  }
  Interval<double> inside_box(const Vec3d& origin, const Vec3d& direction, double margin) const {
    Interval<double> all = kEverywhere;
    for (int k = 0; k < 3; ++k)
      all = common(all, between(dot(origin, axes[k]), dot(direction, axes[k]), half()[k] + margin));
    return all;
  }
  Interval<double> inside_cylinder(const Vec3d& origin, const Vec3d& direction, double margin) const {
    const double along = dot(origin, axes[0]), step = dot(direction, axes[0]);
    return common(between(along, step, half().x + margin),
                  within(origin - axes[0] * along, direction - axes[0] * step, half().y + margin));
  }
};

/// A ball whose hull, together with other balls', holds a surface.
struct SurfaceBall {
  Vec3d centre;
  double radius = 0;
};

/// Append balls whose convex hull holds every hit of an object: the vertices of what is flat, a sphere itself, polygons
/// about the end circles of a cone, the corners of the bounds of a polygon that is not planar.
template <class Real>
void append_surface(const Geometry<Real>& geometry, std::uint32_t object, std::vector<SurfaceBall>& balls);

/// Three unit vectors at right angles: the principal axes of the balls' centres, or those of the coordinates where the
/// box along these has less surface.
std::array<Vec3d, 3> box_axes(std::span<const SurfaceBall> balls);

/// The volume of each kind about the hull of some balls, indexed by kind; `bounds` are the bounds of the same objects.
template <class Real>
std::array<Volume<Real>, 4> bounding_volumes(std::span<const SurfaceBall> balls, const Box<Real>& bounds);

/// The same about some objects.
template <class Real>
std::array<Volume<Real>, 4> bounding_volumes(const Geometry<Real>& geometry,
                                             std::span<const std::uint32_t> objects);

/// That of the volumes which makes projected area times cost least.
template <class Real>
const Volume<Real>& cheapest_volume(std::span<const Volume<Real>> volumes);

}  // namespace rayshoot
