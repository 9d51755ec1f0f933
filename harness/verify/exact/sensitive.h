#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "harness/verify/exact/contact.h"

namespace rayshoot::exact {

/// The distance from |x| to the next larger number; at the largest, from the one before.
template <class Real>
long double ulp(Real x) {
  const Real magnitude = std::min(std::abs(x), std::numeric_limits<Real>::max() / 2);
  const long double next = std::nextafter(magnitude, std::numeric_limits<Real>::infinity());
  return (next - static_cast<long double>(magnitude)) * (magnitude < std::abs(x) ? 2 : 1);
}

/// A number with how far, to first order, it moves as each of the inputs moves by half an ulp: forward
/// differentiation. The range of long double holds every polynomial of coordinates of doubles.
struct Sensitive {
  static constexpr std::size_t kInputs = 19;

  long double value = 0;
  std::array<long double, kInputs> shift{};

  Sensitive() = default;
  explicit Sensitive(long double exact) : value(exact) {}

  /// How far it moves at most when all inputs move at once.
  long double reach() const {
    long double sum = 0;
    for (const long double part : shift) sum += std::abs(part);
    return sum;
  }

  friend Sensitive operator+(const Sensitive& a, const Sensitive& b) {
    return a.plus(b, 1, 1, a.value + b.value);
  }
  friend Sensitive operator-(const Sensitive& a, const Sensitive& b) {
    return a.plus(b, 1, -1, a.value - b.value);
  }
  friend Sensitive operator*(const Sensitive& a, const Sensitive& b) {
    return a.plus(b, b.value, a.value, a.value * b.value);
  }
  Sensitive operator-() const { return Sensitive() - *this; }
  Sensitive& operator+=(const Sensitive& b) { return *this = *this + b; }

 private:
  Sensitive plus(const Sensitive& b, long double own, long double other, long double sum) const {
    Sensitive result(sum);
    for (std::size_t i = 0; i < kInputs; ++i) result.shift[i] = own * shift[i] + other * b.shift[i];
    return result;
  }
};

/// Makes inputs, each free to move by itself.
class Inputs {
 public:
  template <class Real>
  Sensitive operator()(Real x) {
    return moving(x, ulp(x) / 2);
  }
  template <class Real>
  Vec3<Sensitive> operator()(const Vec3<Real>& v) {
    return {(*this)(v.x), (*this)(v.y), (*this)(v.z)};
  }
  Sensitive moving(long double value, long double by) {
    Sensitive input(value);
    input.shift.at(next_++) = by;
    return input;
  }

 private:
  std::size_t next_ = 0;
};

/// The exact sign of a form where half an ulp of the inputs cannot change it, else `kUnknown`.
inline int firm_sign(const Dyadic& exact, const Sensitive& sensitive) {
  return std::abs(exact.rounded()) > sensitive.reach() ? sign(exact) : kUnknown;
}

}  // namespace rayshoot::exact
