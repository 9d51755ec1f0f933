#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "scenes/geometry/box.h"

namespace rayshoot {

/// An object as a builder of hierarchies sees it.
template <class Real>
struct BoxedObject {
  Box<Real> box;
  std::uint32_t object;

  /// Twice the box's centre along an axis.
  Real twice_centre(int axis) const { return box.lo[axis] + box.hi[axis]; }
};

/// The union of the boxes, and of the (doubled) centres, of a range of objects.
template <class Real>
struct Extent {
  Box<Real> box, twice_centres;

  void include(const BoxedObject<Real>& object) {
    box.include(object.box);
    twice_centres.include(object.box.lo + object.box.hi);
  }
  void include(const Extent& other) { box.include(other.box), twice_centres.include(other.twice_centres); }
};

/// A way to cut a range of objects in two, with the cost S(left) n(left) + S(right) n(right) of equation (3),
/// in units of the parent's surface area.
template <class Real>
struct SahSplit {
  int axis = -1;
  /// Objects up to this place go left: a bin for a binned split, a position in sorted order for a swept one.
  std::size_t place = 0;
  double cost = std::numeric_limits<double>::infinity();

  bool found() const { return axis >= 0; }
};

/// Maps (doubled) centres to bins along each axis; `place` of a binned split means bins [0, place).
template <class Real>
class Bins {
 public:
  static constexpr int kCount = 32;

  explicit Bins(const Box<Real>& twice_centres) : lo_(twice_centres.lo) {
    const Vec3<Real> extent = twice_centres.extent();
    for (int axis = 0; axis < 3; ++axis) scale_[axis] = extent[axis] > 0 ? kCount / extent[axis] : 0;
  }

  /// The bin of an object along an axis that divides.
  int bin(const BoxedObject<Real>& object, int axis) const {
    const Real position = (object.twice_centre(axis) - lo_[axis]) * scale_[axis];
    return position < kCount ? static_cast<int>(position) : kCount - 1;
  }
  /// Whether the centres extend far enough along the axis to be told apart.
  bool divides(int axis) const { return scale_[axis] > 0 && scale_[axis] < Box<Real>::infinity(); }

  void add(const BoxedObject<Real>& object) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!divides(axis)) continue;
      Bin& into = bins_[axis][bin(object, axis)];
      into.box.include(object.box);
      ++into.count;
    }
  }
  void add(const Bins& other) {
    for (int axis = 0; axis < 3; ++axis)
      for (int b = 0; b < kCount; ++b) {
        bins_[axis][b].box.include(other.bins_[axis][b].box);
        bins_[axis][b].count += other.bins_[axis][b].count;
      }
  }

  /// The cheapest split between bins that leaves objects on both sides.
  SahSplit<Real> best(const Box<Real>& parent) const {
    SahSplit<Real> best;
    for (int axis = 0; axis < 3; ++axis)
      if (divides(axis)) consider(axis, parent.surface_area(), best);
    return best;
  }

 private:
  struct Bin {
    Box<Real> box;
    std::size_t count = 0;
  };

  void consider(int axis, double parent_area, SahSplit<Real>& best) const {
    double right_cost[kCount];
    std::size_t right_count[kCount];
    Bin right;
    for (int b = kCount - 1; b > 0; --b) {
      right.box.include(bins_[axis][b].box);
      right.count += bins_[axis][b].count;
      right_cost[b] = right.box.surface_area() * static_cast<double>(right.count);
      right_count[b] = right.count;
    }
    Bin left;
    for (int b = 1; b < kCount; ++b) {
      left.box.include(bins_[axis][b - 1].box);
      left.count += bins_[axis][b - 1].count;
      if (left.count == 0 || right_count[b] == 0) continue;
      const double left_cost = left.box.surface_area() * static_cast<double>(left.count);
      const double cost = (left_cost + right_cost[b]) / parent_area;
      if (cost < best.cost) best = {axis, static_cast<std::size_t>(b), cost};
    }
  }

  Vec3<Real> lo_, scale_;
  Bin bins_[3][kCount];
};

/// Sort a range by the centres along an axis, equal ones by object, so that the order is unique.
template <class Real>
void sort_by_centre(std::span<BoxedObject<Real>> objects, int axis) {
  std::sort(objects.begin(), objects.end(), [axis](const auto& a, const auto& b) {
    const Real ca = a.twice_centre(axis), cb = b.twice_centre(axis);
    return ca < cb || (ca == cb && a.object < b.object);
  });
}

/// The cheapest of all splits between neighbours in sorted order. Leaves the range sorted along the last
/// axis.
template <class Real>
SahSplit<Real> sweep_split(std::span<BoxedObject<Real>> objects, const Box<Real>& parent,
                           std::vector<double>& right_cost) {
  SahSplit<Real> best;
  const std::size_t count = objects.size();
  right_cost.resize(count);
  const double parent_area = parent.surface_area();
  for (int axis = 0; axis < 3; ++axis) {
    sort_by_centre(objects, axis);
    Box<Real> right;
    for (std::size_t i = count - 1; i > 0; --i) {
      right.include(objects[i].box);
      right_cost[i] = right.surface_area() * static_cast<double>(count - i);
    }
    Box<Real> left;
    for (std::size_t i = 1; i < count; ++i) {
      left.include(objects[i - 1].box);
      const double cost = (left.surface_area() * static_cast<double>(i) + right_cost[i]) / parent_area;
      if (cost < best.cost) best = {axis, i, cost};
    }
  }
  return best;
}

}  // namespace rayshoot
