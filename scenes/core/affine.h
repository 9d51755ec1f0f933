#pragma once

#include <array>

#include "scenes/geometry/vec.h"

namespace rayshoot {

/// An affine map p -> (x.p, y.p, z.p) + offset, rows x, y, z.
struct Affine {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  Vec3d offset{0, 0, 0};

  /// The image of a point.
  Vec3d operator()(const Vec3d& p) const { return direction(p) + offset; }
  /// The image of a direction: the offset does not move it.
  Vec3d direction(const Vec3d& p) const { return {dot(x, p), dot(y, p), dot(z, p)}; }
};

/// The map that applies `second` after `first`.
inline Affine compose(const Affine& second, const Affine& first) {
  const Vec3d cx{first.x.x, first.y.x, first.z.x}, cy{first.x.y, first.y.y, first.z.y},
      cz{first.x.z, first.y.z, first.z.z};
  const auto row = [&](const Vec3d& r) { return Vec3d{dot(r, cx), dot(r, cy), dot(r, cz)}; };
  return {row(second.x), row(second.y), row(second.z), second(first.offset)};
}

inline Affine translation(const Vec3d& by) { return {.offset = by}; }

inline Affine scaling(double factor) { return {{factor, 0, 0}, {0, factor, 0}, {0, 0, factor}, {}}; }

/// Right-handed rotation about a unit axis (Rodrigues), angle in radians.
inline Affine rotation(const Vec3d& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const auto image = [&](const Vec3d& v) { return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1 - c)); };
  const Vec3d ex = image({1, 0, 0}), ey = image({0, 1, 0}), ez = image({0, 0, 1});
  return {{ex.x, ey.x, ez.x}, {ex.y, ey.y, ez.y}, {ex.z, ey.z, ez.z}, {}};
}

}  // namespace rayshoot
