#pragma once

#include <algorithm>

#include "accel/parts/cell_lists.h"
#include "accel/parts/grid_resolution.h"

namespace rayshoot {

/// A division of a box by a grid among items, and what it would take.
template <class Real>
struct GridDivision {
  GridPlanes<Real> planes;
  std::uint32_t items = 0;
  double references = 0;

  /// `bounds_of(i)` is the box of item i; it shares a point with the one that is divided, into about `cells` cells.
  template <class BoundsOf>
  GridDivision(const Box<Real>& box, ResolutionRule rule, double cells, std::uint32_t count,
               const BoundsOf& bounds_of)
      : planes(box, resolution_by_rule(rule, Vec3d(box.hi) - Vec3d(box.lo), cells)), items(count) {
    for (std::uint32_t i = 0; i < items; ++i)
      references += static_cast<double>(planes.overlapped_by(bounds_of(i)).cells());
  }

  /// Cells and references.
  double size() const { return static_cast<double>(planes.cells()) + references; }
  /// Whether some item is kept out of some cell. Copies of one are not.
  bool separates() const { return references < static_cast<double>(planes.cells()) * items; }

  /// The lists of the items, by number, in the cells that their bounds touch.
  template <class BoundsOf>
  CellLists lists(const BoundsOf& bounds_of) const {
    return {planes.cells(), items,
            [&](std::uint32_t i, const auto& visit) { planes.for_each_cell(bounds_of(i), visit); }};
  }
};

/// Cells and references that the grids of a technique may still be made of, so that garbage cannot fill the memory.
class GridAllowance {
 public:
  explicit GridAllowance(std::uint32_t objects) : left_(std::max(kMostPerObject * objects, kAlways)) {}

  template <class Real>
  bool covers(const GridDivision<Real>& division) const {
    return division.size() <= left_;
  }
  template <class Real>
  void take(const GridDivision<Real>& division) {
    left_ -= division.size();
  }

  /// The division into about `cells` cells, or into fewer where that would take more than half of what is left; one
  /// cell where no item would be kept out of any.
  template <class Real, class BoundsOf>
  GridDivision<Real> division(const Box<Real>& box, ResolutionRule rule, double cells, std::uint32_t items,
                              const BoundsOf& bounds_of) const {
    const auto into = [&](double fewer) { return GridDivision<Real>(box, rule, fewer, items, bounds_of); };
    GridDivision<Real> division = into(cells);
    while (division.planes.cells() > 1 && division.size() > left_ / 2) division = into(cells /= 2);
    return division.separates() ? division : into(1);
  }

 private:
  static constexpr double kMostPerObject = 256;
  static constexpr double kAlways = 1 << 16;

  double left_;
};

}  // namespace rayshoot
