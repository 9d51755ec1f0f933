#pragma once

#include <optional>

#include "accel/parts/grid_division.h"
#include "accel/parts/nested_grids.h"
#include "scenes/core/geometry.h"

namespace rayshoot {

/// When a cell of a grid is divided by a grid of its own, and how finely.
struct NestingRules {
  ResolutionRule rule = ResolutionRule::heterogeneous;
  /// Cells per object of the outermost grid, and of those within cells.
  double density = 3, nested_density = 1;
  /// A cell with more objects is divided,
  std::uint32_t max_objects = 16;
  /// unless so many grids are around it already, or every object would be in every cell of its grid.
  int max_depth = 4;
};

/// The parameters of a technique that nests grids, and their values.
std::vector<Parameter> nesting_parameters(const NestingRules& defaults);
NestingRules nesting_rules(const Arguments& arguments);

/// Divides space by grids within the cells of grids (Jevans & Wyvill 1989). A cell that is divided lists its grid and
/// nothing else.
template <class Real>
class GridNesting {
 public:
  GridNesting(const Geometry<Real>& geometry, const NestingRules& rules, NestedGrids<Real>& grids);

  /// The grid over a box in which those objects are listed, in increasing order, all of which share a point with it.
  std::uint32_t outermost(const Box<Real>& box, std::span<const std::uint32_t> objects);

 private:
  std::optional<std::uint32_t> within(const Box<Real>& cell, std::span<const std::uint32_t> objects,
                                      int depth);
  std::uint32_t divide(const GridDivision<Real>& division, std::span<const std::uint32_t> objects, int depth);

  /// The bounds of each of those objects, by place.
  auto bounds_of(std::span<const std::uint32_t> objects) const {
    return [this, objects](std::uint32_t i) { return geometry_.bounds(objects[i]); };
  }

  const Geometry<Real>& geometry_;
  const NestingRules& rules_;
  NestedGrids<Real>& grids_;
  GridAllowance allowance_;
};

}  // namespace rayshoot
