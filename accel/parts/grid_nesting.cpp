#include "accel/parts/grid_nesting.h"

namespace rayshoot {

std::vector<Parameter> nesting_parameters(const NestingRules& defaults) {
  return {resolution_rule_parameter(),
          real_parameter("density", defaults.density, 1e-3, 1e3, "cells per object of the outermost grid"),
          real_parameter("nested_density", defaults.nested_density, 1e-3, 1e3,
                         "cells per object of a grid within a cell"),
          integer_parameter("max_objects", defaults.max_objects, 1, 1'000'000,
                            "a cell with more objects is divided"),
          integer_parameter("max_depth", defaults.max_depth, 1, 16, "levels of grids at the most")};
}

NestingRules nesting_rules(const Arguments& arguments) {
  return {.rule = resolution_rule(arguments),
          .density = arguments.real("density"),
          .nested_density = arguments.real("nested_density"),
          .max_objects = static_cast<std::uint32_t>(arguments.integer("max_objects")),
          .max_depth = static_cast<int>(arguments.integer("max_depth"))};
}

template <class Real>
GridNesting<Real>::GridNesting(const Geometry<Real>& geometry, const NestingRules& rules,
                               NestedGrids<Real>& grids)
    : geometry_(geometry), rules_(rules), grids_(grids), allowance_(geometry.size()) {}

template <class Real>
std::uint32_t GridNesting<Real>::outermost(const Box<Real>& box, std::span<const std::uint32_t> objects) {
  const double cells = rules_.density * static_cast<double>(objects.size());
  const auto count = static_cast<std::uint32_t>(objects.size());
  return divide(allowance_.division(box, rules_.rule, cells, count, bounds_of(objects)), objects, 1);
}

template <class Real>
std::optional<std::uint32_t> GridNesting<Real>::within(const Box<Real>& cell,
                                                       std::span<const std::uint32_t> objects, int depth) {
  if (objects.size() <= rules_.max_objects || depth > rules_.max_depth) return std::nullopt;
  const double cells = rules_.nested_density * static_cast<double>(objects.size());
  const GridDivision<Real> division(cell, rules_.rule, cells, static_cast<std::uint32_t>(objects.size()),
                                    bounds_of(objects));
  if (!division.separates() || !allowance_.covers(division)) return std::nullopt;
  return divide(division, objects, depth);
}

template <class Real>
std::uint32_t GridNesting<Real>::divide(const GridDivision<Real>& division,
                                        std::span<const std::uint32_t> objects, int depth) {
  // List the objects in the cells that their bounds touch.
  allowance_.take(division);
  CellLists cells = division.lists(bounds_of(objects));

  // Divide the cells with too many in turn.
  cells.shorten_lists([&](std::uint64_t cell, std::span<std::uint32_t> list) -> std::size_t {
    for (std::uint32_t& item : list) item = objects[item];
    const auto grid = within(division.planes.box(division.planes.block(cell)), list, depth + 1);
    if (!grid) return list.size();
    list[0] = *grid;
    return 1;
  });
  return grids_.add({division.planes, std::move(cells)});
}

template class GridNesting<float>;
template class GridNesting<double>;

}  // namespace rayshoot
