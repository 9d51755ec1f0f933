#pragma once

namespace rayshoot {

// `dot` and `cross` of vectors in lanes, each of three numbers; in the order of their sums, to the last bit.

template <class Lanes>
Lanes wide_dot(const Lanes* a, const Lanes* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class Lanes>
void wide_cross(const Lanes* a, const Lanes* b, Lanes* product) {
  product[0] = a[1] * b[2] - a[2] * b[1];
  product[1] = a[2] * b[0] - a[0] * b[2];
  product[2] = a[0] * b[1] - a[1] * b[0];
}

}  // namespace rayshoot
