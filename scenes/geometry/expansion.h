#pragma once

#include <array>
#include <cmath>

namespace rayshoot {

/// A number as the exact sum of two doubles.
struct TwoTerms {
  double high = 0, low = 0;
};

/// a - b exactly, unless it overflows (Knuth).
inline TwoTerms exact_difference(double a, double b) {
  const double high = a - b, b_seen = a - high, a_seen = high + b_seen;
  return {high, (a - a_seen) + (b_seen - b)};
}

/// a b exactly, unless it overflows or underflows.
inline TwoTerms exact_product(double a, double b) {
  const double high = a * b;
  return {high, std::fma(a, b, -high)};
}

/// A number as the exact sum of doubles that do not overlap, the largest last (Shewchuk 1997). Large enough for the
/// sums of triple products below; exact unless a product overflows or underflows.
class Expansion {
 public:
  Expansion& operator+=(double term) {
    int kept = 0;
    for (int i = 0; i < size_; ++i) {
      const double sum = term + terms_[i], seen = sum - term;
      const double error = (term - (sum - seen)) + (terms_[i] - seen);
      if (error != 0) terms_[kept++] = error;
      term = sum;
    }
    // Full only of what is not a number, or where products underflow.
    if (kept == static_cast<int>(terms_.size())) term += terms_[--kept];
    if (term != 0) terms_[kept++] = term;
    size_ = kept;
    return *this;
  }
  Expansion& operator+=(const TwoTerms& number) { return *this += number.low, *this += number.high; }
  Expansion& operator+=(const Expansion& number) {
    for (int i = 0; i < number.size_; ++i) *this += number.terms_[i];
    return *this;
  }

  /// Add a factor times a number.
  void add_product(double factor, const Expansion& number) {
    for (int i = 0; i < number.size_; ++i) *this += exact_product(factor, number.terms_[i]);
  }
  /// Add a b c.
  void add_product(double a, double b, double c) {
    const TwoTerms ab = exact_product(a, b);
    *this += exact_product(ab.low, c), *this += exact_product(ab.high, c);
  }

  /// The sum, off by less than a unit in the last place; zero, positive or negative as the number is.
  double rounded() const {
    double sum = 0;
    for (int i = 0; i < size_; ++i) sum += terms_[i];
    return sum;
  }

 private:
  /// Terms do not overlap, so there is room for no more over the whole range of exponents.
  std::array<double, 64> terms_;
  int size_ = 0;
};

}  // namespace rayshoot
