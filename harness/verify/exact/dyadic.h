#pragma once

#include <gmpxx.h>

#include <cstdint>

namespace rayshoot::exact {

/// The exact number mantissa * 2^exponent: every finite floating-point number, and whatever addition,
/// subtraction and multiplication make of them.
class Dyadic {
 public:
  Dyadic() = default;
  explicit Dyadic(double value);

  friend Dyadic operator+(const Dyadic& a, const Dyadic& b) { return sum(a, b, false); }
  friend Dyadic operator-(const Dyadic& a, const Dyadic& b) { return sum(a, b, true); }
  friend Dyadic operator*(const Dyadic& a, const Dyadic& b) {
    Dyadic product;
    mpz_mul(product.mantissa_.get_mpz_t(), a.mantissa_.get_mpz_t(), b.mantissa_.get_mpz_t());
    product.exponent_ = a.exponent_ + b.exponent_;
    return product;
  }
  Dyadic operator-() const {
    Dyadic negated = *this;
    mpz_neg(negated.mantissa_.get_mpz_t(), negated.mantissa_.get_mpz_t());
    return negated;
  }
  Dyadic& operator+=(const Dyadic& b) { return *this = *this + b; }

  friend int sign(const Dyadic& a) { return sgn(a.mantissa_); }
  /// The number rounded towards zero, to within one unit in the last place of long double.
  long double rounded() const;

 private:
  static Dyadic sum(const Dyadic& a, const Dyadic& b, bool subtract);

  mpz_class mantissa_;
  std::int64_t exponent_ = 0;
};

/// The sign of a - b.
inline int compare(const Dyadic& a, const Dyadic& b) { return sign(a - b); }

}  // namespace rayshoot::exact
