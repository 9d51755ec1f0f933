#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "scenes/geometry/box.h"

namespace rayshoot {

/// Numbers of cells along the three axes of a grid.
using Resolution = std::array<std::int32_t, 3>;

/// A block of cells of a grid: those from `first` to `last` along each axis, both included.
struct CellRange {
  std::array<std::int32_t, 3> first, last;

  std::int32_t cells(int axis) const { return last[axis] - first[axis] + 1; }
  std::uint64_t cells() const {
    return static_cast<std::uint64_t>(cells(0)) * static_cast<std::uint64_t>(cells(1)) *
           static_cast<std::uint64_t>(cells(2));
  }
};

/// The planes between the cells of a regular grid over a box: n + 1 positions along an axis of n cells, the
/// first and last of them those of the box. They are computed here, once; objects are assigned to cells by
/// them and rays cross them, so both agree to the last bit. Where n is beyond the precision of the
/// coordinates, neighbouring planes coincide.
template <class Real>
class GridPlanes {
 public:
  /// A grid without cells.
  GridPlanes() = default;

  GridPlanes(const Box<Real>& bounds, const Resolution& resolution)
      : bounds_(bounds), resolution_(resolution) {
    for (int axis = 0; axis < 3; ++axis) place_planes(axis);
  }

  const Box<Real>& bounds() const { return bounds_; }
  const Resolution& resolution() const { return resolution_; }
  std::uint64_t cells() const { return number(0, 0, resolution_[2]); }
  /// The n + 1 positions along an axis, in increasing order.
  const std::vector<Real>& planes(int axis) const { return planes_[axis]; }

  /// The number of a cell: along x neighbours follow one another, along y rows, along z layers.
  std::uint64_t number(std::int32_t x, std::int32_t y, std::int32_t z) const {
    return static_cast<std::uint64_t>(x + stride(1) * y + stride(2) * z);
  }
  /// How much the number grows from a cell to the next along an axis.
  std::int64_t stride(int axis) const {
    const std::int64_t row = resolution_[0];
    return axis == 0 ? 1 : axis == 1 ? row : row * resolution_[1];
  }

  /// The cell in which a position lies, give or take one for rounding; some cell where it lies in none.
  std::int32_t cell_near(int axis, Real position) const {
    const Real cell = (position - bounds_.lo[axis]) * cells_per_length_[axis];
    return !(cell > 0)                                   ? 0
           : cell < static_cast<Real>(resolution_[axis]) ? static_cast<std::int32_t>(cell)
                                                         : resolution_[axis] - 1;
  }

  /// The cells that share a point with a box, all taken as closed. The box shares a point with the grid's.
  CellRange overlapped_by(const Box<Real>& box) const {
    CellRange range;
    for (int axis = 0; axis < 3; ++axis) {
      const std::vector<Real>& planes = planes_[axis];
      std::int32_t first = cell_near(axis, box.lo[axis]), last = cell_near(axis, box.hi[axis]);
      while (first > 0 && planes[first] >= box.lo[axis]) --first;
      while (first + 1 < resolution_[axis] && planes[first + 1] < box.lo[axis]) ++first;
      while (last + 1 < resolution_[axis] && planes[last + 1] <= box.hi[axis]) ++last;
      while (last > first && planes[last] > box.hi[axis]) --last;
      range.first[axis] = first, range.last[axis] = last;
    }
    return range;
  }

  /// Call visit(cell) with the number of each cell that shares a point with a box.
  template <class Visit>
  void for_each_cell(const Box<Real>& box, const Visit& visit) const {
    for_each_cell(overlapped_by(box), visit);
  }
  /// The same for each cell of a block.
  template <class Visit>
  void for_each_cell(const CellRange& range, const Visit& visit) const {
    for (std::int32_t z = range.first[2]; z <= range.last[2]; ++z)
      for (std::int32_t y = range.first[1]; y <= range.last[1]; ++y)
        for (std::int32_t x = range.first[0]; x <= range.last[0]; ++x) visit(number(x, y, z));
  }

  /// The box of a block of cells.
  Box<Real> box(const CellRange& range) const {
    Box<Real> box;
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = planes_[axis][range.first[axis]];
      box.hi[axis] = planes_[axis][range.last[axis] + 1];
    }
    return box;
  }

  /// The cell of that number, as a block of one.
  CellRange block(std::uint64_t cell) const {
    CellRange block;
    for (int axis = 0; axis < 3; ++axis) {
      const auto cells = static_cast<std::uint64_t>(resolution_[axis]);
      block.first[axis] = block.last[axis] = static_cast<std::int32_t>(cell % cells);
      cell /= cells;
    }
    return block;
  }

  std::size_t bytes() const {
    return (planes_[0].size() + planes_[1].size() + planes_[2].size()) * sizeof(Real);
  }

 private:
  void place_planes(int axis) {
    const double lo = bounds_.lo[axis], hi = bounds_.hi[axis], cells = resolution_[axis];
    planes_[axis].resize(static_cast<std::size_t>(resolution_[axis]) + 1);
    for (std::int32_t k = 0; k < resolution_[axis]; ++k)
      planes_[axis][k] = static_cast<Real>(std::min(lo + (hi - lo) * (k / cells), hi));
    planes_[axis].back() = bounds_.hi[axis];
    cells_per_length_[axis] = static_cast<Real>(cells / (hi - lo));
  }

  Box<Real> bounds_;
  Resolution resolution_{};
  std::vector<Real> planes_[3];
  Vec3<Real> cells_per_length_;
};

}  // namespace rayshoot
