#pragma once

#include <algorithm>

#include "accel/parts/grid_planes.h"
#include "scenes/geometry/ray.h"

namespace rayshoot {

/// Where a ray stands on one axis of a grid. Indices are those of planes; a ray that goes backwards enters
/// the grid through the last plane and leaves it through plane 0.
template <class Real>
struct AxisWalk {
  const Real* planes;
  int axis;
  std::int32_t step;    ///< +1 or -1
  std::int32_t first;   ///< the plane through which the ray enters the grid
  std::int32_t beyond;  ///< one step behind the plane through which it leaves the grid
  std::int32_t next;    ///< the plane through which it leaves its cell
  std::int64_t stride;  ///< what a step adds to the number of the cell
  Real exit;            ///< the parameter at which it crosses `next`

  /// Stand in the cell that the ray is in just after `start`.
  AxisWalk(const GridPlanes<Real>& grid, int walked, const Ray<Real>& ray, const Crossings<Real>& crossings,
           Real start)
      : planes(grid.planes(walked).data()), axis(walked) {
    const bool backwards = crossings.inverse[axis] < 0;
    const std::int32_t cells = grid.resolution()[axis];
    step = backwards ? -1 : 1;
    first = backwards ? cells : 0;
    beyond = backwards ? -1 : cells + 1;
    stride = step * grid.stride(axis);

    // Find the cell by its position, then go to the one whose crossings enclose the start.
    const std::int32_t near = grid.cell_near(axis, ray.origin[axis] + ray.direction[axis] * start);
    next = backwards ? near : near + 1;
    while (next - step != first && crossing(crossings, next - step) > start) next -= step;
    while (next + step != beyond && crossing(crossings, next) <= start) next += step;
    exit = crossing(crossings, next);
  }

  std::int32_t cell() const { return step > 0 ? next - 1 : next; }
  bool outside() const { return next == beyond; }
  Real crossing(const Crossings<Real>& crossings, std::int32_t plane) const {
    return crossings.crossing(axis, planes[plane]);
  }

  /// Take a step; false when it leads out of the grid.
  bool advance(const Crossings<Real>& crossings) {
    next += step;
    if (outside()) return false;
    exit = crossing(crossings, next);
    return true;
  }

  /// Take all steps that are due at `t`; returns how many of them stay in the grid.
  std::int32_t advance_past(const Crossings<Real>& crossings, Real t) {
    std::int32_t steps = 0;
    while (!outside() && exit == t) steps += advance(crossings);
    return steps;
  }

  /// How many cells behind this one the ray touches at `start`: those it would be in just before.
  std::int32_t touched_behind(const Crossings<Real>& crossings, Real start) const {
    std::int32_t plane = next - step;
    while (plane != first && crossing(crossings, plane) == start) plane -= step;
    return (next - step - plane) * step;
  }
};

/// A block of cells that a ray touches in one point: `steps` cells beside the first along each axis.
struct TouchedBlock {
  std::uint64_t first;
  std::array<std::int32_t, 3> steps;
  std::array<std::int64_t, 3> strides;

  std::uint64_t cell(std::int32_t x, std::int32_t y, std::int32_t z) const {
    return first + static_cast<std::uint64_t>(x * strides[0] + y * strides[1] + z * strides[2]);
  }
  std::uint64_t last() const { return cell(steps[0], steps[1], steps[2]); }
};

/// Visit the cells of a block, except those that the walk itself visits; true when a visit was the last. Each
/// is one step of the walk.
template <class Counter, class Visit>
[[gnu::noinline, gnu::cold]] bool visit_block(const TouchedBlock& block, bool except_first, bool except_last,
                                              Counter count, const Visit& visit) {
  for (std::int32_t z = 0; z <= block.steps[2]; ++z)
    for (std::int32_t y = 0; y <= block.steps[1]; ++y)
      for (std::int32_t x = 0; x <= block.steps[0]; ++x) {
        const std::uint64_t cell = block.cell(x, y, z);
        if ((except_first && cell == block.first) || (except_last && cell == block.last())) continue;
        count.step();
        if (visit(cell)) return true;
      }
  return false;
}

/// Where a ray stands in a grid.
template <class Real>
struct GridWalk {
  AxisWalk<Real> x, y, z;
  std::uint64_t cell;

  GridWalk(const GridPlanes<Real>& grid, const Ray<Real>& ray, const Crossings<Real>& crossings, Real start)
      : x(grid, 0, ray, crossings, start),
        y(grid, 1, ray, crossings, start),
        z(grid, 2, ray, crossings, start),
        cell(grid.number(x.cell(), y.cell(), z.cell())) {}

  std::array<std::int64_t, 3> strides() const { return {x.stride, y.stride, z.stride}; }
};

/// The cells that a ray touches where it comes into the grid, at `start`: more than the one it goes on in
/// where it comes through an edge between cells.
template <class Real>
TouchedBlock touched_at_start(const GridWalk<Real>& walk, const Crossings<Real>& crossings, Real start) {
  TouchedBlock block{walk.cell,
                     {walk.x.touched_behind(crossings, start), walk.y.touched_behind(crossings, start),
                      walk.z.touched_behind(crossings, start)},
                     walk.strides()};
  block.first -= block.last() - block.first;
  return block;
}

/// A ray that crosses planes of several axes at once, through an edge or a corner of its cell, touches all the
/// cells around it: visit them and go on in the last. Returns true when the walk is over.
template <class Real, class Counter, class Visit>
[[gnu::noinline, gnu::cold]] bool cross_together(GridWalk<Real>& walk, const Crossings<Real>& crossings,
                                                 Counter count, const Visit& visit) {
  const Real t = std::min(std::min(walk.x.exit, walk.y.exit), walk.z.exit);
  if (!(t < Box<Real>::infinity())) return true;
  TouchedBlock block{walk.cell, {}, walk.strides()};
  block.steps = {walk.x.advance_past(crossings, t), walk.y.advance_past(crossings, t),
                 walk.z.advance_past(crossings, t)};
  const bool over = walk.x.outside() || walk.y.outside() || walk.z.outside();
  if (visit_block(block, true, !over, count, visit) || over) return true;
  walk.cell = block.last();
  count.step();
  return false;
}

/// The three-dimensional digital differential analyser (Fujimoto, Tanaka & Iwata 1986) in the form of
/// Amanatides & Woo (1987): visit the cells of a grid that a ray meets, near to far, from cell to cell through
/// the plane that comes first.
///   visit(cell)  is called with the number of each cell; true ends the walk
///   reach()      is the distance at which the walk may end; cells that begin there are still visited
/// Crossings are computed from the planes, never accumulated. Exactly those cells are visited in which a hit
/// can lie: whose three intervals of parameters, all closed, share one with (t_min, reach].
template <class Real, class Counter, class Reach, class Visit>
void walk_grid(const GridPlanes<Real>& grid, const Ray<Real>& ray, Counter count, const Reach& reach,
               const Visit& visit) {
  // Leave out rays that miss the grid.
  const Crossings<Real> crossings(ray);
  const Interval<Real> inside = crossings.inside(grid.bounds());
  const bool meets = inside.enter <= inside.exit && inside.exit > ray.t_min && inside.enter <= reach() &&
                     ray.t_min < reach() && inside.enter < Box<Real>::infinity();
  if (!meets) return;

  // Find the first cell.
  const Real start = std::max(inside.enter, ray.t_min);
  GridWalk<Real> walk(grid, ray, crossings, start);
  if (inside.enter > ray.t_min) {
    const TouchedBlock touched = touched_at_start(walk, crossings, start);
    if (touched.first != walk.cell && visit_block(touched, false, true, count, visit)) return;
  }

  const auto step = [&](AxisWalk<Real>& axis) {
    if (reach() < axis.exit || !axis.advance(crossings)) return false;
    walk.cell += static_cast<std::uint64_t>(axis.stride);
    count.step();
    return true;
  };
  while (!visit(walk.cell)) {
    // Step through the nearest plane, unless the nearest hit lies before it.
    AxisWalk<Real>&x = walk.x, &y = walk.y, &z = walk.z;
    if (x.exit < y.exit && x.exit < z.exit) {
      if (!step(x)) return;
    } else if (y.exit < x.exit && y.exit < z.exit) {
      if (!step(y)) return;
    } else if (z.exit < x.exit && z.exit < y.exit) {
      if (!step(z)) return;
    } else {
      // Planes of several axes are crossed at once.
      if (reach() < std::min(x.exit, z.exit)) return;
      GridWalk<Real> crossed = walk;
      if (cross_together(crossed, crossings, count, visit)) return;
      walk = crossed;
    }
  }
}

}  // namespace rayshoot
