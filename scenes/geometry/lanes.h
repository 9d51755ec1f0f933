#pragma once

#include <cstring>

#include "scenes/geometry/box.h"

namespace rayshoot {

/// Vectors handled by one instruction (the vector extension of GCC and Clang): four numbers, and half as
/// many.
template <class Real>
struct LaneTypes;
template <>
struct LaneTypes<float> {
  typedef float Four __attribute__((vector_size(16)));
  typedef float Two __attribute__((vector_size(8)));
};
template <>
struct LaneTypes<double> {
  typedef double Four __attribute__((vector_size(32)));
  typedef double Two __attribute__((vector_size(16)));
};
template <class Real>
using Lanes = typename LaneTypes<Real>::Four;
/// The same vector in double precision.
using WideLanes = Lanes<double>;

/// The larger of each pair.
template <class Vector>
inline Vector max_lanes(Vector a, Vector b) {
  return a > b ? a : b;
}
/// The smaller of each pair.
template <class Vector>
inline Vector min_lanes(Vector a, Vector b) {
  return a < b ? a : b;
}

// Points and directions in lanes x, y and z. What the fourth lane holds is of no account.

/// Four numbers of `object`, an aggregate of them, from number `first` on.
template <class Real, class Object>
inline Lanes<Real> read_lanes(const Object& object, std::size_t first) {
  Lanes<Real> lanes;
  std::memcpy(&lanes, reinterpret_cast<const char*>(&object) + first * sizeof(Real), sizeof lanes);
  return lanes;
}

template <class Vector>
inline WideLanes widened(Vector a) {
  return WideLanes{double{a[0]}, double{a[1]}, double{a[2]}, double{a[3]}};
}

inline double dot(WideLanes a, WideLanes b) {
  const WideLanes products = a * b;
  return products[0] + products[1] + products[2];
}

inline WideLanes cross(WideLanes a, WideLanes b) {
  const auto turned = [](WideLanes v) { return __builtin_shufflevector(v, v, 1, 2, 0, 3); };
  return turned(a * turned(b) - turned(a) * b);
}

/// The largest of x, y and z.
template <class Vector>
inline auto largest(Vector a) {
  return std::max(std::max(a[0], a[1]), a[2]);
}
/// The smallest of x, y and z.
template <class Vector>
inline auto smallest(Vector a) {
  return std::min(std::min(a[0], a[1]), a[2]);
}

/// A box in lanes.
template <class Real>
struct LaneBox {
  Lanes<Real> lo, hi;

  explicit operator Box<Real>() const { return {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}}; }
};

/// The box grown as `padded` grows it.
template <class Real>
LaneBox<Real> padded(const LaneBox<Real>& box) {
  const Lanes<Real> magnitude = max_lanes(max_lanes(box.lo, -box.lo), max_lanes(box.hi, -box.hi));
  const Real margin = padding(largest(magnitude));
  return {box.lo - margin, box.hi + margin};
}

}  // namespace rayshoot
