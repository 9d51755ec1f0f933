#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "accel/parts/surface_balls.h"
#include "scenes/core/spec.h"

namespace rayshoot {

/// The kinds of bounding volumes among which Weghorst, Hooper and Greenberg (1984) choose.
enum class VolumeKind : std::uint8_t { sphere, axis_box, oriented_box, cylinder };
inline constexpr std::array kVolumeKindNames = {"sphere", "axis_box", "oriented_box", "cylinder"};

/// B of equation (1): what a ray-volume test of each kind costs, in tests of an axis-aligned box, which took 6.6 ns where
/// these were measured: `bounding_volumes` on teapot:6, balls:3, gears:2 and tree:8 with each kind throughout.
inline constexpr std::array kVolumeTestCost = {1.0, 1.0, 2.4, 2.2};

/// The parameter `volumes`, best or the name of a kind; its value, none for best.
Parameter volume_kind_parameter();
std::optional<VolumeKind> volume_kind(const Arguments& arguments);

/// The names of events, one for the tests of each kind, in the order of the kinds.
std::vector<std::string> volume_kind_events();

/// Whether the rounding of turned coordinates along a ray can be bounded: not where the ray is not finite, or its direction
/// so short or so long that its inverse is no measure any more.
template <class Real>
bool is_measurable(const Ray<Real>& ray) {
  using Limits = std::numeric_limits<Real>;
  const Real length = max_abs(ray.direction);
  return is_finite(ray.direction) && length >= Limits::min() / Limits::epsilon() * 8 &&
         length <= Limits::max() * Limits::epsilon() / 8 && in_range<double>(Vec3d(ray.origin));
}

/// How far a hit may lie beside the surface, and the ray beside the turned ray, by the way from the ray's origin. Single
/// precision rounds a distance that was computed in double; in double the object test itself counts, which is least exact
/// where a ray grazes a surface or an object is a needle.
template <class Real>
inline constexpr double kSurfaceError =
    std::max(8.0 * static_cast<double>(std::numeric_limits<Real>::epsilon()),
             1048576 * std::numeric_limits<double>::epsilon());

/// A ray prepared for volumes of every kind. Turning it and solving for it is done in double precision, with a
/// direction whose largest component is 1.
template <class Real>
struct VolumeRay {
  Crossings<Real> crossings;
  Vec3d origin, direction;
  /// Parameter of the ray by a unit of way along `direction`.
  double parameter_scale;
  /// Of other rays a turned volume knows nothing.
  bool measurable;

  explicit VolumeRay(const Ray<Real>& ray)
      : crossings(ray), origin(ray.origin), measurable(is_measurable(ray)) {
    parameter_scale = 1 / static_cast<double>(max_abs(ray.direction));
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
    if (!ray.measurable) [[unlikely]]
      return {-Box<Real>::infinity(), Box<Real>::infinity()};
    const Vec3d origin = ray.origin - centre();
    const double way = std::abs(origin.x) + std::abs(origin.y) + std::abs(origin.z);
    const double margin = kSurfaceError<Real> * (way + half().x + half().y + half().z);
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
  /// The space enclosed, by which Weghorst, Hooper and Greenberg measure the fit. What is flat is as thick as a ray's test
  /// has to take it: a volume of nothing would be the best at any cost.
  double enclosed_volume() const;
  /// An axis-aligned box about it.
  Box<Real> bounds() const;
  /// The point of the volume's own frame whose coordinates are the parts `at`, from -1 to 1, of half its extent along
  /// each axis; points of its boundary and beyond are among them where it is round.
  Vec3d point(const Vec3d& at) const;
  bool holds(const Vec3d& point) const;
  /// B of equation (1).
  double relative_cost() const { return kVolumeTestCost[static_cast<std::size_t>(kind)]; }

 private:
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
  /// Half its extent along the axes of its frame.
  Vec3d half_extent() const;
  std::array<Vec3d, 3> frame() const;

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

/// How badly a volume fits: by the space that it encloses, or by the area that it shows a ray on average.
enum class VolumeFit { enclosed_volume, projected_area };

/// That of the volumes which makes fit times cost least (Arvo & Kirk §4.1).
template <class Real>
const Volume<Real>& cheapest_volume(std::span<const Volume<Real>> volumes, VolumeFit fit);

}  // namespace rayshoot
