#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace rayshoot {

/// A point or a direction in space.
template <class Real>
struct Vec3 {
  Real x{}, y{}, z{};

  constexpr Real& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr const Real& operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }

  /// The same vector in another precision, each component rounded to nearest.
  template <class Other>
  constexpr explicit operator Vec3<Other>() const {
    return {static_cast<Other>(x), static_cast<Other>(y), static_cast<Other>(z)};
  }

  constexpr Vec3& operator+=(const Vec3& b) { return *this = *this + b; }
  constexpr Vec3& operator*=(Real s) { return *this = *this * s; }

  friend constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(const Vec3& a, Real s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec3 operator*(Real s, const Vec3& a) { return a * s; }
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

using Vec3d = Vec3<double>;

template <class Real>
constexpr Real dot(const Vec3<Real>& a, const Vec3<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Real>
constexpr Vec3<Real> cross(const Vec3<Real>& a, const Vec3<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class Real>
Real length(const Vec3<Real>& a) {
  return std::sqrt(dot(a, a));
}

template <class Real>
Vec3<Real> normalized(const Vec3<Real>& a) {
  return a * (Real{1} / length(a));
}

template <class Real>
constexpr Vec3<Real> min(const Vec3<Real>& a, const Vec3<Real>& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}

template <class Real>
constexpr Vec3<Real> max(const Vec3<Real>& a, const Vec3<Real>& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

/// The axis of the largest component; of equal ones the first.
template <class Real>
constexpr int largest_axis(const Vec3<Real>& a) {
  return a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
}

/// The largest component by magnitude.
template <class Real>
Real max_abs(const Vec3<Real>& a) {
  return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
}

/// Whether a point can be traced in `Real`: the square of a coordinate must not overflow. False for what is
/// not a number.
template <class Real>
bool in_range(const Vec3d& p) {
  const double limit = static_cast<double>(std::sqrt(std::numeric_limits<Real>::max()) / 4);
  return std::abs(p.x) <= limit && std::abs(p.y) <= limit && std::abs(p.z) <= limit;
}

template <class Real>
bool is_finite(const Vec3<Real>& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

}  // namespace rayshoot
