#pragma once

#include <cmath>
#include <limits>

#include "scenes/geometry/vec.h"

namespace rayshoot::exact {

/// What `sign` and `compare` return besides -1, 0 and 1 where a number is not known well enough.
inline constexpr int kUnknown = 2;

/// A real number known to within `error` of `value`: the floating filter. Running error analysis: with u the
/// unit roundoff, an operation's result rounds by at most u |result|, or by less than the smallest number where
/// it underflows, on top of what its operands' errors make of it. The error itself is computed with at most
/// seven roundings, hence the factor `kUpward`; whatever underflows on the way is within `kTiny`. Overflow
/// makes the error infinite or not a number, and either way the sign unknown.
template <class Float>
struct Bounded {
  static constexpr Float kRoundoff = std::numeric_limits<Float>::epsilon() / 2;
  static constexpr Float kUpward = 1 + 16 * kRoundoff;
  static constexpr Float kTiny = 16 * std::numeric_limits<Float>::denorm_min();

  Float value = 0, error = 0;

  Bounded() = default;
  explicit Bounded(Float exact) : value(exact) {}
  Bounded(Float computed, Float operand_error)
      : value(computed), error((operand_error + kRoundoff * std::abs(computed)) * kUpward + kTiny) {}

  Bounded operator-() const {
    Bounded negated = *this;
    negated.value = -value;
    return negated;
  }
  Float lowest() const { return (value - error) - kRoundoff * 2 * std::abs(value - error); }
  Float highest() const { return (value + error) + kRoundoff * 2 * std::abs(value + error); }

  friend Bounded operator+(const Bounded& a, const Bounded& b) {
    return {a.value + b.value, a.error + b.error};
  }
  friend Bounded operator-(const Bounded& a, const Bounded& b) {
    return {a.value - b.value, a.error + b.error};
  }
  friend Bounded operator*(const Bounded& a, const Bounded& b) {
    return {a.value * b.value, std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error};
  }
  /// |a/b - a'/b'| <= (|a - a'| + |a/b| |b - b'|) / |b'|. Unknown where b may be zero.
  friend Bounded operator/(const Bounded& a, const Bounded& b) {
    const Float smallest = (std::abs(b.value) - b.error) * (1 - 2 * kRoundoff);
    if (!(smallest > 0)) return {0, std::numeric_limits<Float>::infinity()};
    const Float quotient = a.value / b.value;
    return {quotient, (a.error + std::abs(quotient) * kUpward * b.error + kTiny) / smallest};
  }
  Bounded& operator+=(const Bounded& b) { return *this = *this + b; }
};

/// |sqrt x - sqrt x'| <= sqrt |x - x'|, and <= |x - x'| / sqrt x. A negative number counts as zero.
template <class Float>
Bounded<Float> sqrt(const Bounded<Float>& a) {
  const Float root = a.value > 0 ? std::sqrt(a.value) : 0;
  const Float near_zero = std::sqrt(a.error + (a.value < 0 ? -a.value : 0));
  return {root, root > 0 ? std::min(near_zero, a.error / root * Bounded<Float>::kUpward) : near_zero};
}

template <class Float>
int sign(const Bounded<Float>& a) {
  if (a.value > a.error) return 1;
  if (a.value < -a.error) return -1;
  return a.value == 0 && a.error == 0 ? 0 : kUnknown;
}

/// The sign of a - b.
template <class Float>
int compare(const Bounded<Float>& a, const Bounded<Float>& b) {
  return sign(a - b);
}

}  // namespace rayshoot::exact
