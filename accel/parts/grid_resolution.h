#pragma once

#include <optional>
#include <string>

#include "accel/parts/grid_planes.h"
#include "scenes/core/spec.h"

namespace rayshoot {

/// Grids have at most so many cells along an axis.
inline constexpr std::int32_t kMostCellsAlongAxis = 1'000'000;

/// How many cells a grid has along each axis, for about `cells` of them over a box:
///   cube_root      the cube root of that number along every axis; the cells have the box's proportions
///   woo            the cube root along the longest axis, and cells that are cubes: fewer where the box is
///                  flat (A. Woo, in Havran's statistics)
///   heterogeneous  cells that are cubes, of that number; along an axis too short for one there is one layer
///                  (Klimaszewski & Sederberg 1997)
enum class ResolutionRule { cube_root, woo, heterogeneous };

/// The resolution that a rule gives for a box of that extent. Numbers are rounded to the nearest, at least 1.
Resolution resolution_by_rule(ResolutionRule rule, const Vec3d& extent, double cells);

/// The parameter `resolution` of techniques that build many grids, and its value.
Parameter resolution_rule_parameter();
ResolutionRule resolution_rule(const Arguments& arguments);

/// A resolution as parameters give it: a rule with the density of cells per object, or explicit.
struct ResolutionChoice {
  ResolutionRule rule = ResolutionRule::heterogeneous;
  double density = 1;
  std::optional<Resolution> given;

  Resolution for_objects(std::uint64_t objects, const Vec3d& extent) const;
};

/// The parameters `resolution` and `density` of every technique that builds grids.
std::vector<Parameter> resolution_parameters(double default_density);

/// Their values. Throws InputError, in the name of `owner`, on what is no resolution, and on a density beside
/// an explicit one.
ResolutionChoice resolution_choice(const Arguments& arguments, double default_density,
                                   const std::string& owner);

}  // namespace rayshoot
