#include "harness/verify/exact/root.h"

#include <algorithm>

namespace rayshoot::exact {

namespace {

/// The sign of x + y sqrt(r).
int sign_of_sum(const Dyadic& x, const Dyadic& y, const Dyadic& r) {
  const int sx = sign(x), sy = sign(y) * sign(r);
  if (sx == sy || sy == 0) return sx;
  if (sx == 0) return sy;
  return sx * sign(x * x - y * y * r);
}

/// The sign of x + y sqrt(p) + z sqrt(q): where x + y sqrt(p) and z sqrt(q) differ in sign, their squares
/// decide, whose difference has one square root less.
int sign_of_sum(const Dyadic& x, const Dyadic& y, const Dyadic& p, const Dyadic& z, const Dyadic& q) {
  const int s = sign_of_sum(x, y, p), t = sign(z) * sign(q);
  if (s == t || t == 0) return s;
  if (s == 0) return t;
  return s * sign_of_sum(x * x + y * y * p - z * z * q, Dyadic(2) * x * y, p);
}

Dyadic times_side(const Dyadic& a, int side) { return side == 0 ? Dyadic() : side < 0 ? -a : a; }

}  // namespace

long double value(const ExactRoot& root) { return difference(root, 0); }

long double difference(const ExactRoot& root, double t) {
  const Dyadic centre = root.centre - Dyadic(t) * root.scale;
  const long double scale = root.scale.rounded(), along = centre.rounded();
  if (root.side == 0) return along / scale;
  const long double spread = root.side * std::sqrt(root.radicand.rounded());
  if (spread == 0 || (along > 0) == (spread > 0)) return (along + spread) / scale;
  // Of opposite signs: c + s = (c^2 - s^2) / (c - s).
  return (centre * centre - root.radicand).rounded() / (along - spread) / scale;
}

int compare(const ExactRoot& a, const ExactRoot& b) {
  const Dyadic apart = a.centre * b.scale - b.centre * a.scale;
  return sign_of_sum(apart, times_side(b.scale, a.side), a.radicand, times_side(a.scale, -b.side),
                     b.radicand);
}

int compare(const ExactRoot& root, double t) { return linear_sign(root, -Dyadic(t), Dyadic(1)); }

int linear_sign(const ExactRoot& root, const Dyadic& constant, const Dyadic& slope) {
  return sign_of_sum(constant * root.scale + slope * root.centre, times_side(slope, root.side),
                     root.radicand);
}

}  // namespace rayshoot::exact
