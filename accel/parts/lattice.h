#pragma once

#include <array>

#include "scenes/geometry/ray.h"

namespace rayshoot {

/// A number of a layer, or of the plane at which it begins, on each axis.
using Layers = std::array<int, 3>;

/// A cell of whole layers.
struct LatticeCell {
  Layers corner{}, size{};

  int end(int axis) const { return corner[axis] + size[axis]; }
  Layers centre() const {
    return {corner[0] + size[0] / 2, corner[1] + size[1] / 2, corner[2] + size[2] / 2};
  }
  /// The part on one side of a plane on each axis: octant bit k tells the upper side on axis k.
  LatticeCell child(unsigned octant, const Layers& planes) const {
    LatticeCell child;
    for (int axis = 0; axis < 3; ++axis) {
      const int lower = planes[axis] - corner[axis];
      const bool upper = octant >> axis & 1;
      child.corner[axis] = upper ? planes[axis] : corner[axis];
      child.size[axis] = upper ? size[axis] - lower : lower;
    }
    return child;
  }
};

/// The octant of a layer among the eight parts beside three planes.
inline unsigned octant_of(const Layers& layers, const Layers& planes) {
  return (layers[0] >= planes[0] ? 1u : 0u) | (layers[1] >= planes[1] ? 2u : 0u) |
         (layers[2] >= planes[2] ? 4u : 0u);
}

/// The planes on which the cells of a subdivision into eight may begin and end: a box cut on each
/// axis into 2^depth layers of equal thickness. Plane k of an axis is computed by one formula, by whoever
/// asks, so that the cell to which an object is assigned and the cell that a ray passes are the same to the
/// last bit.
template <class Real>
struct Lattice {
  Vec3<Real> lo;
  /// Thickness of a layer.
  Vec3<Real> step;
  int depth = 0;

  /// A lattice over at least `box`, as deep as asked for or until its layers are `thinnest`, or so thin that planes
  /// might coincide. A box that is itself so thin on an axis is thickened there, and lies inside one layer. An empty
  /// box gives one layer at the origin.
  static Lattice over(const Box<Real>& box, int max_depth, Real thinnest = 0);

  int layers() const { return 1 << depth; }
  Real plane(int axis, int k) const { return lo[axis] + static_cast<Real>(k) * step[axis]; }

  /// The cell of `size` layers from layer `corner` on.
  Box<Real> cell(const LatticeCell& cell) const;
  Box<Real> box() const { return cell(whole()); }
  LatticeCell whole() const { return {{0, 0, 0}, {layers(), layers(), layers()}}; }

  /// Every 2^(depth - coarser)th plane: the same planes, because a power of two scales without rounding.
  Lattice coarsened(int coarser) const {
    return {lo, step * static_cast<Real>(1 << (depth - coarser)), coarser};
  }
};

template <class Real>
Lattice<Real> Lattice<Real>::over(const Box<Real>& box, int max_depth, Real thinnest) {
  using Limits = std::numeric_limits<Real>;
  if (box.empty()) return {{0, 0, 0}, {1, 1, 1}, 0};
  // Eight units in the last place of the largest coordinate keep planes apart.
  const Real apart = 8 * Limits::epsilon() * std::max(max_abs(box.lo), max_abs(box.hi));
  thinnest = std::max({thinnest, apart, Limits::min()});
  Lattice lattice{box.lo, {}, 0};
  while (lattice.depth < max_depth &&
         max_abs(box.extent()) / static_cast<Real>(2 * lattice.layers()) >= thinnest)
    ++lattice.depth;

  const Real layers = static_cast<Real>(lattice.layers());
  for (int axis = 0; axis < 3; ++axis) {
    const Real width = box.hi[axis] - box.lo[axis];
    if (width >= thinnest * layers) {
      // Widen it on both sides alike, so that a box about the origin is divided at the origin; where it lies too far from
      // there for that, on one.
      lattice.step[axis] = width * (1 + 2 * Limits::epsilon()) / layers;
      lattice.lo[axis] = box.lo[axis] - width * Limits::epsilon();
      if (lattice.plane(axis, lattice.layers()) < box.hi[axis]) lattice.lo[axis] = box.lo[axis];
    } else {
      // A third of the thickened width is never near a plane of any depth.
      lattice.step[axis] = 3 * thinnest;
      lattice.lo[axis] -= thinnest * layers;
    }
  }
  return lattice;
}

template <class Real>
Box<Real> Lattice<Real>::cell(const LatticeCell& cell) const {
  Box<Real> box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lo[axis] = plane(axis, cell.corner[axis]);
    box.hi[axis] = plane(axis, cell.end(axis));
  }
  return box;
}

/// A ray as the lattice sees it, mirrored on the axes along which it runs backwards: layer and plane numbers
/// always grow along the ray, and entry(axis, k) never decreases with k.
template <class Real>
class LatticeRay {
 public:
  LatticeRay(const Lattice<Real>& lattice, const Ray<Real>& ray) : lattice_(lattice), crossings_(ray) {
    for (int axis = 0; axis < 3; ++axis) {
      const bool backwards = crossings_.inverse[axis] < 0;
      first_[axis] = backwards ? lattice.layers() : 0;
      sign_[axis] = backwards ? -1 : 1;
      mirror_ |= backwards << axis;
      const Real layers_per_length = 1 / (static_cast<Real>(sign_[axis]) * lattice.step[axis]);
      start_[axis] = (ray.origin[axis] - lattice.plane(axis, first_[axis])) * layers_per_length;
      pace_[axis] = ray.direction[axis] * layers_per_length;
    }
  }

  /// The earliest ray parameter at which it may pass plane k of the mirrored axis, and the latest.
  Real entry(int axis, int k) const { return crossings_.enter(axis, position(axis, k)); }
  Real exit(int axis, int k) const { return crossings_.exit(axis, position(axis, k)); }

  /// Bit `axis` is set where the axis is mirrored: exclusive-or turns octants as the ray sees them into
  /// octants of the lattice, and back.
  unsigned mirror() const { return mirror_; }

  /// Planes of the lattice as the ray sees them, or back.
  Layers mirrored(const Layers& planes) const {
    return {first_[0] + sign_[0] * planes[0], first_[1] + sign_[1] * planes[1],
            first_[2] + sign_[2] * planes[2]};
  }
  /// The same for a cell.
  LatticeCell mirrored(const LatticeCell& cell) const {
    LatticeCell seen{mirrored(cell.corner), cell.size};
    for (int axis = 0; axis < 3; ++axis)
      if (sign_[axis] < 0) seen.corner[axis] -= cell.size[axis];
    return seen;
  }

  /// The closed interval of parameters inside a cell. Empty for rays that are not numbers.
  Interval<Real> inside(const LatticeCell& cell) const {
    return common([&](int axis) {
      return Interval<Real>{entry(axis, cell.corner[axis]), exit(axis, cell.end(axis))};
    });
  }

  /// The same for the cell grown by `margin` on every side.
  Interval<Real> near(const LatticeCell& cell, Real margin) const {
    return common([&](int axis) {
      const Real along = static_cast<Real>(sign_[axis]) * margin;
      return Interval<Real>{crossings_.enter(axis, position(axis, cell.corner[axis]) - along),
                            crossings_.exit(axis, position(axis, cell.end(axis)) + along)};
    });
  }

  /// The last of the layers lowest to highest that the ray has certainly entered before t; the lowest it has.
  int passed_layer(int axis, Real t, int lowest, int highest) const {
    // Guess from the position at t, which is off by rounding at most: often right, never relied on.
    const Real guess = start_[axis] + t * pace_[axis];
    const int k = guess > static_cast<Real>(lowest)
                      ? static_cast<int>(std::min(guess, static_cast<Real>(highest)))
                      : lowest;
    if ((k == lowest || exit(axis, k) < t) && (k == highest || !(exit(axis, k + 1) < t))) return k;
    return searched_layer(axis, t, lowest, highest);
  }

 private:
  Real position(int axis, int k) const { return lattice_.plane(axis, first_[axis] + sign_[axis] * k); }

  /// What the intervals of the three axes have in common; empty where one of them is or is no number.
  template <class OfAxis>
  static Interval<Real> common(const OfAxis& of_axis) {
    Interval<Real> common{-Box<Real>::infinity(), Box<Real>::infinity()};
    for (int axis = 0; axis < 3; ++axis) {
      const Interval<Real> own = of_axis(axis);
      if (!(own.enter <= own.exit)) return {Box<Real>::infinity(), -Box<Real>::infinity()};
      common = {std::max(common.enter, own.enter), std::min(common.exit, own.exit)};
    }
    return common;
  }

  int searched_layer(int axis, Real t, int lowest, int highest) const {
    while (lowest < highest) {
      const int middle = (lowest + highest + 1) / 2;
      if (exit(axis, middle) < t)
        lowest = middle;
      else
        highest = middle - 1;
    }
    return lowest;
  }

  const Lattice<Real>& lattice_;
  Crossings<Real> crossings_;
  std::array<int, 3> first_, sign_;
  std::array<Real, 3> start_, pace_;
  unsigned mirror_ = 0;
};

}  // namespace rayshoot
