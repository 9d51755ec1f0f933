#pragma once

#include <array>

#include "scenes/geometry/box.h"

namespace rayshoot {

/// An affine map p -> (x.p, y.p, z.p) + offset, rows x, y, z.
struct Affine {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  Vec3d offset{0, 0, 0};

  /// The image of a point.
  Vec3d operator()(const Vec3d& p) const { return direction(p) + offset; }
  /// The image of a direction: the offset does not move it.
  Vec3d direction(const Vec3d& p) const { return {dot(x, p), dot(y, p), dot(z, p)}; }
  friend bool operator==(const Affine&, const Affine&) = default;
};

/// The map that applies `second` after `first`.
inline Affine compose(const Affine& second, const Affine& first) {
  const Vec3d cx{first.x.x, first.y.x, first.z.x}, cy{first.x.y, first.y.y, first.z.y},
      cz{first.x.z, first.y.z, first.z.z};
  const auto row = [&](const Vec3d& r) { return Vec3d{dot(r, cx), dot(r, cy), dot(r, cz)}; };
  return {row(second.x), row(second.y), row(second.z), second(first.offset)};
}

/// The map that undoes another; its numbers are not finite where there is none.
inline Affine inverse(const Affine& map) {
  // The columns of the inverse are the cross products of the rows, over the determinant.
  const double scale = 1 / dot(map.x, cross(map.y, map.z));
  const Vec3d c0 = cross(map.y, map.z) * scale, c1 = cross(map.z, map.x) * scale,
              c2 = cross(map.x, map.y) * scale;
  Affine undone{{c0.x, c1.x, c2.x}, {c0.y, c1.y, c2.y}, {c0.z, c1.z, c2.z}, {}};
  undone.offset = -undone.direction(map.offset);
  return undone;
}

/// The box about the image of a box.
inline Box<double> image(const Affine& map, const Box<double>& box) {
  Box<double> around;
  if (box.empty()) return around;
  for (int corner = 0; corner < 8; ++corner)
    around.include(map({corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y,
                        corner & 4 ? box.hi.z : box.lo.z}));
  return around;
}

inline Affine translation(const Vec3d& by) { return {.offset = by}; }

inline Affine scaling(double factor) { return {{factor, 0, 0}, {0, factor, 0}, {0, 0, factor}, {}}; }

/// Right-handed rotation about a unit axis (Rodrigues), angle in radians.
inline Affine rotation(const Vec3d& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const auto image = [&](const Vec3d& v) {
    return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1 - c));
  };
  const Vec3d ex = image({1, 0, 0}), ey = image({0, 1, 0}), ez = image({0, 0, 1});
  return {{ex.x, ey.x, ez.x}, {ex.y, ey.y, ez.y}, {ex.z, ey.z, ez.z}, {}};
}

}  // namespace rayshoot
