#include "harness/verify/exact/dyadic.h"

#include <cmath>
#include <limits>

namespace rayshoot::exact {

Dyadic::Dyadic(double value) {
  if (value == 0) return;
  constexpr int digits = std::numeric_limits<double>::digits;
  int exponent = 0;
  auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), digits));
  // Trailing zeros only make the numbers that follow longer.
  const int zeros = __builtin_ctzll(static_cast<unsigned long long>(mantissa));
  mantissa /= std::int64_t{1} << zeros;
  mpz_set_si(mantissa_.get_mpz_t(), mantissa);
  exponent_ = exponent - digits + zeros;
}

Dyadic Dyadic::sum(const Dyadic& a, const Dyadic& b, bool subtract) {
  if (sign(b) == 0) return a;
  if (sign(a) == 0) return subtract ? -b : b;
  const bool shift_a = a.exponent_ > b.exponent_;
  const Dyadic& shifted = shift_a ? a : b;
  const Dyadic& other = shift_a ? b : a;
  Dyadic result;
  result.exponent_ = other.exponent_;
  mpz_mul_2exp(result.mantissa_.get_mpz_t(), shifted.mantissa_.get_mpz_t(),
               static_cast<mp_bitcnt_t>(shifted.exponent_ - other.exponent_));
  const mpz_class& left = shift_a ? result.mantissa_ : a.mantissa_;
  const mpz_class& right = shift_a ? b.mantissa_ : result.mantissa_;
  (subtract ? mpz_sub : mpz_add)(result.mantissa_.get_mpz_t(), left.get_mpz_t(), right.get_mpz_t());
  return result;
}

long double Dyadic::rounded() const {
  const std::size_t bits = mpz_sizeinbase(mantissa_.get_mpz_t(), 2);
  const std::size_t dropped = bits > 64 ? bits - 64 : 0;
  mpz_class top;
  mpz_tdiv_q_2exp(top.get_mpz_t(), mantissa_.get_mpz_t(), dropped);
  const auto magnitude = static_cast<long double>(mpz_get_ui(top.get_mpz_t()));
  const std::int64_t exponent = exponent_ + static_cast<std::int64_t>(dropped);
  return std::ldexp(sgn(mantissa_) < 0 ? -magnitude : magnitude, static_cast<int>(exponent));
}

}  // namespace rayshoot::exact
