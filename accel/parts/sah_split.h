#pragma once

#include <immintrin.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "scenes/geometry/lanes.h"

namespace rayshoot {

/// An object as a builder of hierarchies sees it.
template <class Real>
struct alignas(4 * sizeof(Real)) BoxedObject {
  Box<Real> box;
  std::uint32_t object;
  /// Fills the lanes, so that copies are whole vectors.
  std::uint32_t padding[sizeof(Real) == sizeof(float) ? 1 : 3];

  /// Twice the box's centre along an axis.
  Real twice_centre(int axis) const { return box.lo[axis] + box.hi[axis]; }
  LaneBox<Real> lanes() const {
    const Lanes<Real> upper = read_lanes<Real>(box, 2);
    return {read_lanes<Real>(box, 0), __builtin_shufflevector(upper, upper, 1, 2, 3, 3)};
  }
};

/// A union of boxes, in lanes.
template <class Real>
struct BoxUnion {
  Lanes<Real> lo, hi;

  static BoxUnion empty() {
    return {Lanes<Real>{} + Box<Real>::infinity(), Lanes<Real>{} - Box<Real>::infinity()};
  }

  void include(const Lanes<Real>& other_lo, const Lanes<Real>& other_hi) {
    lo = min_lanes(other_lo, lo), hi = max_lanes(other_hi, hi);
  }
  void include(const LaneBox<Real>& box) { include(box.lo, box.hi); }
  void include(const BoxUnion& other) { include(other.lo, other.hi); }

  explicit operator Box<Real>() const { return Box<Real>(LaneBox<Real>{lo, hi}); }
  /// Half of `Box::surface_area`, unless it is empty: the costs of splits are compared in these.
  double half_area() const {
    const WideLanes extent = in_double(hi - lo);
    const WideLanes products = extent * __builtin_shufflevector(extent, extent, 1, 2, 0, 3);
    return products[0] + products[1] + products[2];
  }

 private:
  static WideLanes in_double(const Lanes<float>& a) { return _mm256_cvtps_pd(a); }
  static WideLanes in_double(const WideLanes& a) { return a; }
};

/// The union of the boxes, and of the (doubled) centres, of a range of objects.
template <class Real>
struct Extent {
  BoxUnion<Real> box = BoxUnion<Real>::empty(), twice_centres = BoxUnion<Real>::empty();

  void include(const BoxedObject<Real>& object) {
    const LaneBox<Real> lanes = object.lanes();
    const Lanes<Real> twice_centre = lanes.lo + lanes.hi;
    box.include(lanes), twice_centres.include(twice_centre, twice_centre);
  }
  void include(const Extent& other) { box.include(other.box), twice_centres.include(other.twice_centres); }
  /// The axis along which the centres extend farthest.
  int longest_axis() const { return largest_axis(Box<Real>(twice_centres).extent()); }
};

/// A way to cut a range of objects in two, with the cost S(left) n(left) + S(right) n(right) of equation (3),
/// in units of the parent's surface area.
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
  static constexpr int kMost = 32;

  explicit Bins(const Extent<Real>& extent, int count = kMost)
      : count_(count), lo_(extent.twice_centres.lo), scale_{} {
    const Lanes<Real> length = extent.twice_centres.hi - lo_;
    for (int axis = 0; axis < 3; ++axis) {
      // Along an axis that does not divide all objects fall into the first bin.
      const Real scale = static_cast<Real>(count) / length[axis];
      scale_[axis] = length[axis] > 0 && scale < Box<Real>::infinity() ? scale : 0;
      std::fill_n(bins_[axis], count, BoxUnion<Real>::empty());
      std::fill_n(counts_[axis], count, 0);
    }
  }

  void add(const BoxedObject<Real>& object) {
    const LaneBox<Real> box = object.lanes();
    const Lanes<Real> position = (box.lo + box.hi - lo_) * scale_;
    for (int axis = 0; axis < 3; ++axis) {
      const int bin = std::min(static_cast<int>(position[axis]), count_ - 1);
      bins_[axis][bin].include(box);
      ++counts_[axis][bin];
    }
  }
  void add(const Bins& other) {
    for (int axis = 0; axis < 3; ++axis)
      for (int bin = 0; bin < count_; ++bin) {
        bins_[axis][bin].include(other.bins_[axis][bin]);
        counts_[axis][bin] += other.counts_[axis][bin];
      }
  }

  /// The cheapest split between bins that leaves objects on both sides.
  SahSplit best(const Extent<Real>& parent) const {
    SahSplit best;
    for (int axis = 0; axis < 3; ++axis)
      if (scale_[axis] > 0) consider(axis, best);
    best.cost /= parent.box.half_area();
    return best;
  }
  /// The box of all objects to the left of a split, or to the right.
  BoxUnion<Real> left_box(const SahSplit& split) const {
    return united(split.axis, 0, static_cast<int>(split.place));
  }
  BoxUnion<Real> right_box(const SahSplit& split) const {
    return united(split.axis, static_cast<int>(split.place), count_);
  }

  /// Whether an object belongs to the left part of a split: `add` put it into one of its bins.
  bool goes_left(const BoxedObject<Real>& object, const SahSplit& split) const {
    return position(object, split.axis) < static_cast<Real>(split.place);
  }
  /// The same in lanes, all of which are set or none.
  auto goes_left_lanes(const BoxedObject<Real>& object, const SahSplit& split) const {
    return Lanes<Real>{} + position(object, split.axis) < Lanes<Real>{} + static_cast<Real>(split.place);
  }

 private:
  Real position(const BoxedObject<Real>& object, int axis) const {
    return (object.twice_centre(axis) - lo_[axis]) * scale_[axis];
  }
  BoxUnion<Real> united(int axis, int first, int last) const {
    BoxUnion<Real> box = BoxUnion<Real>::empty();
    for (int bin = first; bin < last; ++bin) box.include(bins_[axis][bin]);
    return box;
  }
  void consider(int axis, SahSplit& best) const {
    double right_cost[kMost];
    BoxUnion<Real> right = BoxUnion<Real>::empty();
    double count = 0;
    for (int bin = count_ - 1; bin > 0; --bin) {
      right.include(bins_[axis][bin]);
      count += counts_[axis][bin];
      // A part without objects makes no split: the area of its box is infinite, or not a number with the count.
      right_cost[bin] = right.half_area() * count;
    }
    BoxUnion<Real> left = BoxUnion<Real>::empty();
    count = 0;
    for (int bin = 1; bin < count_; ++bin) {
      left.include(bins_[axis][bin - 1]);
      count += counts_[axis][bin - 1];
      const double cost = left.half_area() * count + right_cost[bin];
      if (cost < best.cost) best = {axis, static_cast<std::size_t>(bin), cost};
    }
  }

  int count_;
  Lanes<Real> lo_, scale_;
  BoxUnion<Real> bins_[3][kMost];
  std::uint32_t counts_[3][kMost];
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
SahSplit sweep_split(std::span<BoxedObject<Real>> objects, const Extent<Real>& parent) {
  SahSplit best;
  const std::size_t count = objects.size();
  std::vector<double> right_cost(count);
  for (int axis = 0; axis < 3; ++axis) {
    sort_by_centre(objects, axis);
    BoxUnion<Real> right = BoxUnion<Real>::empty();
    for (std::size_t i = count - 1; i > 0; --i) {
      right.include(objects[i].lanes());
      right_cost[i] = right.half_area() * static_cast<double>(count - i);
    }
    BoxUnion<Real> left = BoxUnion<Real>::empty();
    for (std::size_t i = 1; i < count; ++i) {
      left.include(objects[i - 1].lanes());
      const double cost = left.half_area() * static_cast<double>(i) + right_cost[i];
      if (cost < best.cost) best = {axis, i, cost};
    }
  }
  best.cost /= parent.box.half_area();
  return best;
}

}  // namespace rayshoot
