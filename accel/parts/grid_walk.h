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
  Real exit;            ///< the earliest parameter at which it may cross `next`

  /// Stand in the rearmost cell that the ray may be in at `start` and behind `t_min`.
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
    const auto passed = [&](std::int32_t plane) {
      const Real latest = crossings.exit(axis, planes[plane]);
      return latest < start || latest <= ray.t_min;
    };
    const std::int32_t near = grid.cell_near(axis, ray.origin[axis] + ray.direction[axis] * start);
    next = backwards ? near : near + 1;
    while (next - step != first && !passed(next - step)) next -= step;
    while (next + step != beyond && passed(next)) next += step;
    exit = crossings.enter(axis, planes[next]);
  }

  std::int32_t cell() const { return step > 0 ? next - 1 : next; }
  bool outside() const { return next == beyond; }

  /// The parameters at which the ray may be in the cell so many steps ahead.
  Interval<Real> inside(const Crossings<Real>& crossings, std::int32_t ahead) const {
    const std::int32_t plane = next + ahead * step;
    return {crossings.enter(axis, planes[plane - step]), crossings.exit(axis, planes[plane])};
  }

  /// Take a step; false when it leads out of the grid.
  bool advance(const Crossings<Real>& crossings) {
    next += step;
    if (outside()) return false;
    exit = crossings.enter(axis, planes[next]);
    return true;
  }

  /// Take all steps that may be due at `t`, which moves on with them; returns how many of them stay in the grid.
  std::int32_t advance_past(const Crossings<Real>& crossings, Real& t) {
    std::int32_t steps = 0;
    while (!outside() && exit <= t * kApart<Real>) {
      t = std::max(t, exit);
      steps += advance(crossings);
    }
    return steps;
  }
};

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

  std::uint64_t cell_ahead(std::int32_t i, std::int32_t j, std::int32_t k) const {
    return cell + static_cast<std::uint64_t>(i * x.stride + j * y.stride + k * z.stride);
  }

  /// The parameters at which the ray may be in that cell.
  Interval<Real> inside(const Crossings<Real>& crossings, std::int32_t i, std::int32_t j,
                        std::int32_t k) const {
    const Interval<Real> of_x = x.inside(crossings, i), of_y = y.inside(crossings, j),
                         of_z = z.inside(crossings, k);
    return {std::max(std::max(of_x.enter, of_y.enter), of_z.enter),
            std::min(std::min(of_x.exit, of_y.exit), of_z.exit)};
  }
};

/// A ray that may cross planes of several axes at once, through an edge or a corner of its cell, touches the cells
/// around it: visit those in which it may be and go on in the last. Returns true when the walk is over.
template <class Real, class Counter, class Visit, class Reach>
[[gnu::noinline, gnu::cold]] bool cross_together(GridWalk<Real>& walk, const Crossings<Real>& crossings,
                                                 Real t_min, const Reach& reach, Counter count,
                                                 const Visit& visit) {
  // Take all steps that may be due, on each axis until no other takes any.
  Real t = std::min(std::min(walk.x.exit, walk.y.exit), walk.z.exit);
  if (!(t < Box<Real>::infinity())) return true;
  const GridWalk<Real> from = walk;
  std::array<std::int32_t, 3> steps{};
  for (Real before = -1; before < t;) {
    before = t;
    steps[0] += walk.x.advance_past(crossings, t);
    steps[1] += walk.y.advance_past(crossings, t);
    steps[2] += walk.z.advance_past(crossings, t);
  }
  const bool over = walk.x.outside() || walk.y.outside() || walk.z.outside();
  walk.cell = from.cell_ahead(steps[0], steps[1], steps[2]);

  // Visit the cells between, but neither that in which it was nor that in which it goes on.
  for (std::int32_t k = 0; k <= steps[2]; ++k)
    for (std::int32_t j = 0; j <= steps[1]; ++j)
      for (std::int32_t i = 0; i <= steps[0]; ++i) {
        const std::uint64_t cell = from.cell_ahead(i, j, k);
        if (cell == from.cell || (cell == walk.cell && !over)) continue;
        const Interval<Real> inside = from.inside(crossings, i, j, k);
        if (!(inside.enter <= inside.exit && inside.exit > t_min && inside.enter <= reach())) continue;
        count.step();
        if (visit(cell)) return true;
      }
  if (over || reach() < t) return true;
  count.step();
  return false;
}

/// The three-dimensional digital differential analyser (Fujimoto, Tanaka & Iwata 1986) in the form of
/// Amanatides & Woo (1987): visit the cells of a grid that a ray meets, near to far, from cell to cell through
/// the plane that comes first.
///   visit(cell)  is called with the number of each cell; true ends the walk
///   reach()      is the distance at which the walk may end; cells that begin there are still visited
/// Crossings are computed from the planes, never accumulated. Every cell is visited in which a hit can lie: whose
/// three intervals of parameters, all closed and wider than exact, share one with (t_min, reach].
template <class Real, class Counter, class Reach, class Visit>
void walk_grid(const GridPlanes<Real>& grid, const Ray<Real>& ray, const Crossings<Real>& crossings,
               Counter count, const Reach& reach, const Visit& visit) {
  // Leave out rays that miss the grid.
  const Interval<Real> inside = crossings.inside(grid.bounds());
  const bool meets = inside.enter <= inside.exit && inside.exit > ray.t_min && inside.enter <= reach() &&
                     ray.t_min < reach() && inside.enter < Box<Real>::infinity();
  if (!meets) return;

  // Begin in the first cell.
  GridWalk<Real> walk(grid, ray, crossings, std::max(inside.enter, ray.t_min));
  const auto step = [&](AxisWalk<Real>& axis) {
    if (reach() < axis.exit || !axis.advance(crossings)) return false;
    walk.cell += static_cast<std::uint64_t>(axis.stride);
    count.step();
    return true;
  };
  while (!visit(walk.cell)) {
    // Step through the nearest plane, unless the nearest hit lies before it.
    AxisWalk<Real>&x = walk.x, &y = walk.y, &z = walk.z;
    const Real past_x = x.exit * kApart<Real>, past_y = y.exit * kApart<Real>, past_z = z.exit * kApart<Real>;
    if (past_x < y.exit && past_x < z.exit) {
      if (!step(x)) return;
    } else if (past_y < x.exit && past_y < z.exit) {
      if (!step(y)) return;
    } else if (past_z < x.exit && past_z < y.exit) {
      if (!step(z)) return;
    } else {
      // Planes of several axes may be crossed at once.
      if (reach() < std::min(std::min(x.exit, y.exit), z.exit)) return;
      GridWalk<Real> crossed = walk;
      if (cross_together(crossed, crossings, ray.t_min, reach, count, visit)) return;
      walk = crossed;
    }
  }
}

}  // namespace rayshoot
