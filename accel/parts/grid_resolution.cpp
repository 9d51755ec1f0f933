#include "accel/parts/grid_resolution.h"

#include <fmt/format.h>

#include <charconv>

namespace rayshoot {

namespace {

std::int32_t whole_cells(double cells) {
  return static_cast<std::int32_t>(std::clamp(std::round(cells), 1.0, double{kMostCellsAlongAxis}));
}

/// Sides of the box in units of the longest.
Vec3d proportions(const Vec3d& extent) {
  const double longest = max_abs(extent);
  return longest > 0 ? Vec3d{extent.x / longest, extent.y / longest, extent.z / longest} : Vec3d{1, 1, 1};
}

/// The side of cubes of which `cells` fill a box, in its own units. An axis shorter than that gets one layer
/// of cells, and the others are divided as a plane or a line.
double side_of_cubes(const Vec3d& box, double cells) {
  constexpr double flat = 1e-9;
  double side = flat;
  while (true) {
    double volume = 1;
    int axes = 0;
    for (int axis = 0; axis < 3; ++axis)
      if (box[axis] > side) volume *= box[axis], ++axes;
    if (axes == 0) return side;
    const double longer = std::pow(volume / cells, 1.0 / axes);
    if (longer <= side) return side;
    side = longer;
  }
}

/// "46x46x3", or nothing if the text is not of that form.
std::optional<Resolution> parse_resolution(const std::string& text) {
  Resolution resolution;
  const char *at = text.data(), *end = at + text.size();
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0 && (at == end || *at++ != 'x')) return std::nullopt;
    const auto [stop, error] = std::from_chars(at, end, resolution[axis]);
    const bool in_range =
        error == std::errc{} && resolution[axis] >= 1 && resolution[axis] <= kMostCellsAlongAxis;
    if (!in_range) return std::nullopt;
    at = stop;
  }
  return at == end ? std::optional(resolution) : std::nullopt;
}

}  // namespace

Resolution resolution_by_rule(ResolutionRule rule, const Vec3d& extent, double cells) {
  const Vec3d box = proportions(extent);
  const double along_longest = std::cbrt(cells);
  switch (rule) {
    case ResolutionRule::cube_root:
      break;
    case ResolutionRule::woo:
      return {whole_cells(along_longest * box.x), whole_cells(along_longest * box.y),
              whole_cells(along_longest * box.z)};
    case ResolutionRule::heterogeneous: {
      const double side = side_of_cubes(box, cells);
      return {whole_cells(box.x / side), whole_cells(box.y / side), whole_cells(box.z / side)};
    }
  }
  return {whole_cells(along_longest), whole_cells(along_longest), whole_cells(along_longest)};
}

Parameter resolution_rule_parameter() {
  return choice_parameter("resolution", "heterogeneous", {"heterogeneous", "cube_root", "woo"},
                          "rule for the number of cells along each axis");
}

ResolutionRule resolution_rule(const Arguments& arguments) {
  const std::string& rule = arguments.text("resolution");
  return rule == "cube_root" ? ResolutionRule::cube_root
         : rule == "woo"     ? ResolutionRule::woo
                             : ResolutionRule::heterogeneous;
}

Resolution ResolutionChoice::for_objects(std::uint64_t objects, const Vec3d& extent) const {
  return given ? *given : resolution_by_rule(rule, extent, density * static_cast<double>(objects));
}

std::vector<Parameter> resolution_parameters(double default_density) {
  return {
      text_parameter("resolution", "heterogeneous",
                     "cells along each axis: cube_root|woo|heterogeneous, or explicitly as in 46x46x3"),
      real_parameter("density", default_density, 1e-3, 1e6, "cells per object, for a resolution by rule")};
}

ResolutionChoice resolution_choice(const Arguments& arguments, double default_density,
                                   const std::string& owner) {
  const std::string& text = arguments.text("resolution");
  ResolutionChoice choice{.density = arguments.real("density")};
  if (text == "cube_root") {
    choice.rule = ResolutionRule::cube_root;
  } else if (text == "woo") {
    choice.rule = ResolutionRule::woo;
  } else if (text != "heterogeneous") {
    choice.given = parse_resolution(text);
    if (!choice.given)
      throw InputError(
          fmt::format("{}: resolution={} is not accepted; resolution takes cube_root, woo, "
                      "heterogeneous or three numbers from 1 to {} as in 46x46x3",
                      owner, text, kMostCellsAlongAxis));
    if (choice.density != default_density)
      throw InputError(fmt::format("{}: density={} contradicts the explicit resolution={}; give one of them",
                                   owner, choice.density, text));
  }
  return choice;
}

}  // namespace rayshoot
