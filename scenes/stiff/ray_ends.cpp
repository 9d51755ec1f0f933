// ray_ends, STIFF 18: rays that begin or end at a hit
//
// Construction  Level plates over one another; rays fall onto them with directions that are powers of two, so
//               that the distance of every plate is a float. The end or the beginning of the ray is that of
//               the first plate, or the float beside it.
// Property      A hit at t_max counts, one at t_min does not; an empty or a reversed interval meets nothing.
// Metric        Violations.
// Size          The same settings at every size.
// Anchor        None: suites known test neither end.

#include <array>

#include "scenes/stiff/parts/scenes.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

constexpr double kLattice = 0x1p-10;

enum class Ends { end_at, end_before, end_behind, start_at, start_before, start_behind, empty, reversed };

std::shared_ptr<const Scene> plates() {
  SceneBuilder builder;
  for (int i = 1; i <= 4; ++i) {
    const auto corner = [&](double x, double y) { return Vec3d{x, y, -1.0 * i}; };
    if (i % 2 == 0) {
      builder.polygon(std::array{corner(-2, -2), corner(2, -2), corner(2, 2), corner(-2, 2)});
    } else {
      builder.triangle(corner(-2, -2), corner(2, -2), corner(2, 2));
      builder.triangle(corner(-2, -2), corner(2, 2), corner(-2, 2));
    }
  }
  return share(std::move(builder), "ray_ends(scene=plates)");
}

Ray<double> falling_ray(Ends ends, const RandomNumbers& random, std::uint64_t number) {
  Vec3d origin = snapped(point_in_cube(random, number, 0), kLattice);
  origin.z = std::abs(origin.z);
  const double speed = std::ldexp(1, pick(random, number, 3, -8, 8));
  const double first = (origin.z + 1) / speed, before = floats_above(first, -1),
               behind = floats_above(first, 1);
  Ray<double> ray{.origin = origin, .direction = {0, 0, -speed}};
  switch (ends) {
    case Ends::end_at:
      ray.t_max = first;
      break;
    case Ends::end_before:
      ray.t_max = before;
      break;
    case Ends::end_behind:
      ray.t_max = behind;
      break;
    case Ends::start_at:
      ray.t_min = first;
      break;
    case Ends::start_before:
      ray.t_min = before;
      break;
    case Ends::start_behind:
      ray.t_min = behind;
      break;
    case Ends::empty:
      ray.t_min = ray.t_max = first;
      break;
    case Ends::reversed:
      ray.t_min = 2 * first, ray.t_max = first / 2;
      break;
  }
  return ray;
}

std::vector<StiffSetting> settings(int, std::uint64_t) {
  struct Entry {
    const char* label;
    Property property;
  };
  constexpr std::array kEntries = {
      Entry{"t_max=hit", Property::always_hit},     Entry{"t_max=hit-ulp", Property::never_hit},
      Entry{"t_max=hit+ulp", Property::always_hit}, Entry{"t_min=hit", Property::as_oracle},
      Entry{"t_min=hit-ulp", Property::as_oracle},  Entry{"t_min=hit+ulp", Property::as_oracle},
      Entry{"interval=empty", Property::never_hit}, Entry{"interval=reversed", Property::never_hit}};
  const auto scene = plates();
  std::vector<StiffSetting> result;
  for (std::size_t i = 0; i < kEntries.size(); ++i)
    result.push_back({.label = kEntries[i].label,
                      .scene = scene,
                      .rays = ray_by_ray([i](const RandomNumbers& random, std::uint64_t number) {
                        return falling_ray(static_cast<Ends>(i), random, number);
                      }),
                      .property = kEntries[i].property,
                      .stiffness_parameter = static_cast<double>(i),
                      .default_rays = 1000});
  return result;
}

}  // namespace

const StiffCase& stiff_ray_ends() {
  static const StiffCase entry{.id = "ray_ends",
                               .number = 18,
                               .title = "Rays that begin or end at a hit",
                               .construction =
                                   "rays whose t_min or t_max is the exact distance of a hit, one ulp more "
                                   "or less; empty and reversed intervals",
                               .property = "a ray is the half-open interval (t_min, t_max]",
                               .metric = "violations",
                               .settings = settings};
  return entry;
}

}  // namespace rayshoot
