#include "accel/parts/grid_nesting.h"

#include <algorithm>

namespace rayshoot {

namespace {

/// Cells and references are at most so many for an object, so that garbage cannot fill the memory: 4 bytes each. Where
/// grids would take more they are made coarser, or not at all.
constexpr double kMostPerObject = 256;
/// A few objects may take this many in any case.
constexpr double kAlwaysAllowed = 1 << 16;

}  // namespace

std::vector<Parameter> nesting_parameters(const NestingRules& defaults) {
  return {choice_parameter("resolution", "heterogeneous", {"heterogeneous", "cube_root", "woo"},
                           "rule for the number of cells along each axis"),
          real_parameter("density", defaults.density, 1e-3, 1e3, "cells per object of the outermost grid"),
          real_parameter("nested_density", defaults.nested_density, 1e-3, 1e3,
                         "cells per object of a grid within a cell"),
          integer_parameter("max_objects", defaults.max_objects, 1, 1'000'000,
                            "a cell with more objects is divided"),
          integer_parameter("max_depth", defaults.max_depth, 1, 16, "levels of grids at the most")};
}

NestingRules nesting_rules(const Arguments& arguments) {
  const std::string& rule = arguments.text("resolution");
  return {.rule = rule == "cube_root" ? ResolutionRule::cube_root
                  : rule == "woo"     ? ResolutionRule::woo
                                      : ResolutionRule::heterogeneous,
          .density = arguments.real("density"),
          .nested_density = arguments.real("nested_density"),
          .max_objects = static_cast<std::uint32_t>(arguments.integer("max_objects")),
          .max_depth = static_cast<int>(arguments.integer("max_depth"))};
}

template <class Real>
GridNesting<Real>::GridNesting(const Geometry<Real>& geometry, const NestingRules& rules,
                               NestedGrids<Real>& grids)
    : geometry_(geometry),
      rules_(rules),
      grids_(grids),
      allowance_(std::max(kMostPerObject * geometry.size(), kAlwaysAllowed)) {}

template <class Real>
std::uint32_t GridNesting<Real>::outermost(const Box<Real>& box, std::span<const std::uint32_t> objects) {
  // Make it as fine as the density says and the allowance lets it be.
  double cells = rules_.density * static_cast<double>(objects.size());
  Division division = over(box, objects, cells);
  while (division.cells() > 1 && division.cells() + division.references > allowance_ / 2)
    division = over(box, objects, cells /= 2);
  if (!division.separates(objects.size())) division = over(box, objects, 1);
  return divide(division.planes, objects, 1);
}

template <class Real>
std::optional<std::uint32_t> GridNesting<Real>::within(const Box<Real>& cell,
                                                       std::span<const std::uint32_t> objects, int depth) {
  if (objects.size() <= rules_.max_objects || depth > rules_.max_depth) return std::nullopt;
  const Division division = over(cell, objects, rules_.nested_density * static_cast<double>(objects.size()));
  if (!division.separates(objects.size()) || division.cells() + division.references > allowance_)
    return std::nullopt;
  return divide(division.planes, objects, depth);
}

template <class Real>
std::uint32_t GridNesting<Real>::divide(const GridPlanes<Real>& planes,
                                        std::span<const std::uint32_t> objects, int depth) {
  // List the objects in the cells that their bounds touch.
  CellLists cells(
      planes.cells(), static_cast<std::uint32_t>(objects.size()),
      [&](std::uint32_t i, const auto& visit) { planes.for_each_cell(geometry_.bounds(objects[i]), visit); });
  allowance_ -= static_cast<double>(planes.cells() + cells.references());

  // Divide the cells with too many in turn.
  cells.shorten_lists([&](std::uint64_t cell, std::span<std::uint32_t> list) -> std::size_t {
    for (std::uint32_t& item : list) item = objects[item];
    const auto grid = within(planes.box(planes.block(cell)), list, depth + 1);
    if (!grid) return list.size();
    list[0] = *grid;
    return 1;
  });
  return grids_.add({planes, std::move(cells)});
}

template <class Real>
auto GridNesting<Real>::over(const Box<Real>& box, std::span<const std::uint32_t> objects, double cells) const
    -> Division {
  Division division{{box, resolution_by_rule(rules_.rule, Vec3d(box.hi) - Vec3d(box.lo), cells)}};
  for (const std::uint32_t object : objects)
    division.references +=
        static_cast<double>(division.planes.overlapped_by(geometry_.bounds(object)).cells());
  return division;
}

template class GridNesting<float>;
template class GridNesting<double>;

}  // namespace rayshoot
