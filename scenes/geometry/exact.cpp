#include "scenes/geometry/exact.h"

#include "scenes/geometry/expansion.h"

namespace rayshoot {

namespace {

/// A vector whose components are exact sums.
using ExactVector = std::array<TwoTerms, 3>;

ExactVector exact_way(const Vec3d& from, const Vec3d& to) {
  return {exact_difference(to.x, from.x), exact_difference(to.y, from.y), exact_difference(to.z, from.z)};
}

ExactVector exact_vector(const Vec3d& v) { return {TwoTerms{v.x}, TwoTerms{v.y}, TwoTerms{v.z}}; }

void add_product(Expansion& sum, const TwoTerms& a, const TwoTerms& b, const TwoTerms& c, double sign) {
  for (const double x : {a.high, a.low})
    for (const double y : {b.high, b.low})
      for (const double z : {c.high, c.low})
        if (x != 0 && y != 0 && z != 0) sum.add_product(sign * x, y, z);
}

/// a . (b x c)
Expansion triple_product(const ExactVector& a, const ExactVector& b, const ExactVector& c) {
  Expansion sum;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    add_product(sum, a[i], b[j], c[k], 1);
    add_product(sum, a[i], b[k], c[j], -1);
  }
  return sum;
}

/// a . (b x c) in plain arithmetic, zero where rounding might have given it its sign.
double certain_triple_product(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const auto magnitude = [](const Vec3d& v) { return Vec3d{std::abs(v.x), std::abs(v.y), std::abs(v.z)}; };
  const Vec3d p = magnitude(a), q = magnitude(b), r = magnitude(c);
  const double largest =
      p.x * (q.y * r.z + q.z * r.y) + p.y * (q.z * r.x + q.x * r.z) + p.z * (q.x * r.y + q.y * r.x);
  // Two roundings of differences, five of the product: 7 units of 2^-53, and one more for the bound itself.
  const double product = dot(a, cross(b, c)), error = 4.5 * std::numeric_limits<double>::epsilon() * largest;
  return std::abs(product) > error ? product : 0;
}

bool differ(double u, double v, double w) { return (u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0); }

double exact_quotient(const Expansion& dividend, const Expansion& divisor) {
  const double quotient = dividend.rounded() / divisor.rounded();
  Expansion rest = dividend;
  rest.add_product(-quotient, divisor);
  return quotient + rest.rounded() / divisor.rounded();
}

}  // namespace

double exact_distance(const Triangle<double>& triangle, const Vec3d& origin, const Vec3d& direction) {
  // Reject the ray where plain arithmetic is certain that it passes two edges on different sides.
  const Vec3d a = triangle.a - origin, b = triangle.b - origin, c = triangle.c - origin;
  if (!is_finite(a) || !is_finite(b) || !is_finite(c) || !is_finite(direction)) return kMiss<double>;
  if (differ(certain_triple_product(direction, b, c), certain_triple_product(direction, c, a),
             certain_triple_product(direction, a, b)))
    return kMiss<double>;

  // Decide exactly.
  const ExactVector to_a = exact_way(origin, triangle.a), to_b = exact_way(origin, triangle.b),
                    to_c = exact_way(origin, triangle.c), along = exact_vector(direction);
  const Expansion u = triple_product(along, to_b, to_c), v = triple_product(along, to_c, to_a),
                  w = triple_product(along, to_a, to_b);
  if (differ(u.rounded(), v.rounded(), w.rounded())) return kMiss<double>;
  Expansion volume = u;
  volume += v, volume += w;
  if (volume.rounded() == 0) return kMiss<double>;

  // Measure the distance: the volume that the corners span with the origin over that which they span with the ray.
  return exact_quotient(triple_product(to_a, to_b, to_c), volume);
}

double exact_side(const Vec3d& a, const Vec3d& b, const Vec3d& origin, const Vec3d& direction) {
  const double certain = certain_triple_product(direction, a - origin, b - origin);
  if (certain != 0) return certain;
  return triple_product(exact_vector(direction), exact_way(origin, a), exact_way(origin, b)).rounded();
}

double exact_height(const Vec3d& point, const Vec3d& origin, const Vec3d& direction, const ViewAxes& axes) {
  const ExactVector way = exact_way(origin, point);
  Expansion height;
  for (const double term : {way[axes.up].low, way[axes.up].high})
    height += exact_product(term, direction[axes.along]);
  for (const double term : {way[axes.along].low, way[axes.along].high})
    height += exact_product(-term, direction[axes.up]);
  return height.rounded();
}

}  // namespace rayshoot
