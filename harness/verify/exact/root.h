#pragma once

#include "harness/verify/exact/bounded.h"
#include "harness/verify/exact/dyadic.h"

namespace rayshoot::exact {

/// The ray parameter (centre + side sqrt(radicand)) / scale with scale > 0 and radicand >= 0: a fraction where
/// side is 0, else the lower (-1) or the upper (1) root of a quadratic.
template <class Number>
struct Root {
  Number centre, radicand, scale;
  int side = 0;
};

using ExactRoot = Root<Dyadic>;

template <class Float>
Bounded<Float> value(const Root<Bounded<Float>>& root) {
  if (root.side == 0) return root.centre / root.scale;
  const Bounded<Float> spread = sqrt(root.radicand);
  return (root.side < 0 ? root.centre - spread : root.centre + spread) / root.scale;
}

/// The root rounded to within a few units in the last place of long double, without cancellation.
long double value(const ExactRoot& root);

/// root - t, as accurate.
long double difference(const ExactRoot& root, double t);

/// The sign of a - b.
int compare(const ExactRoot& a, const ExactRoot& b);

/// The sign of root - t.
template <class Float>
int compare(const Root<Bounded<Float>>& root, double t) {
  return compare(value(root), Bounded<Float>(t));
}
int compare(const ExactRoot& root, double t);

/// The sign of constant + slope * root.
template <class Float>
int linear_sign(const Root<Bounded<Float>>& root, const Bounded<Float>& constant,
                const Bounded<Float>& slope) {
  return sign(constant + slope * value(root));
}
int linear_sign(const ExactRoot& root, const Dyadic& constant, const Dyadic& slope);

}  // namespace rayshoot::exact
