#pragma once

#include "accel/parts/axis_tree.h"
#include "scenes/core/geometry.h"

namespace rayshoot {

/// Parameters of the build; kd_tree's manual page explains them.
struct KdRules {
  double traversal_cost = 1, intersection_cost = 0.25;
  double empty_bonus = 0.2;
  /// 0 for 8 + 1.3 times the binary logarithm of the number of objects.
  int max_depth = 0;
  bool clipped = false;
};

/// A tree over a scene by the surface area heuristic, in O(n log n): the ends of the objects' bounds are sorted once along
/// each axis and stay sorted as they are handed down (Wald & Havran 2006). An object is listed in the leaves that its
/// bounds reach or, where they are clipped, in those that the part of its surface in them reaches, both widened by
/// `margin`.
template <class Real>
AxisTree<Real> build_kd_tree(const Geometry<Real>& geometry, const KdRules& rules, Real margin);

/// A dividing plane and what equation (3) expects of it: the cost of a node in ray-object tests, by rays that hit it.
template <class Real>
struct KdSplit {
  int axis = -1;
  Real plane = 0;
  /// Whether objects that lie in the plane belong to the lower child.
  bool flat_to_lower = false;
  double cost = std::numeric_limits<double>::infinity();

  bool found() const { return axis >= 0; }
};

/// Where the bounds of an object begin or end along an axis.
template <class Real>
struct BoundsEvent {
  enum Kind : std::uint32_t { end, flat, begin };
  Real position;
  std::uint32_t object;
  Kind kind;

  /// At a position, ends come first and beginnings last.
  friend bool operator<(const BoundsEvent& a, const BoundsEvent& b) {
    return a.position < b.position || (a.position == b.position && a.kind < b.kind);
  }
};

/// The sorted events of some objects along the three axes.
template <class Real>
using BoundsEvents = std::array<std::vector<BoundsEvent<Real>>, 3>;

template <class Real>
void add_events(BoundsEvents<Real>& events, const Box<Real>& bounds, std::uint32_t object);

/// The plane strictly inside a cell that costs least.
template <class Real>
KdSplit<Real> best_plane(const Box<Real>& cell, std::size_t objects, const BoundsEvents<Real>& events,
                         const KdRules& rules);

}  // namespace rayshoot
