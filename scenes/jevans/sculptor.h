#pragma once

#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "scenes/core/affine.h"
#include "scenes/core/registry.h"

namespace rayshoot {

/// How the models after Jevans (1990) are made of polygons. His models are lost; what he says of them is not.
namespace jevans {

inline constexpr double kPi = std::numbers::pi;
inline constexpr const char* kPaper =
    "Stand-in after the description in Jevans, Adaptive subdivision for ray tracing scenes of varying local "
    "complexity, 1990";

/// Which edges of a sheet are sewn together.
enum class Seam { none, around, both };

/// Cells of a sheet at size 1; a model of size s has s times as many each way.
struct Cells {
  int around = 1, along = 1;
  Seam seam = Seam::around;
};

/// Shapes models from sheets, whose number of triangles grows with the square of the size, and single polygons. Without
/// a builder it only counts.
class Sculptor {
 public:
  explicit Sculptor(int size, SceneBuilder* builder = nullptr) : size_(size), builder_(builder) {}

  /// Number of polygons so far.
  double polygons() const { return polygons_; }
  void material(const Material& material) {
    if (builder_) builder_->material(material);
  }
  void polygon(std::span<const Vec3d> vertices) {
    ++polygons_;
    if (builder_) builder_->polygon(vertices);
  }

  /// Keeps what is shaped during its life together as a group.
  [[nodiscard]] std::unique_ptr<SceneBuilder::GroupScope> part() {
    return builder_ ? std::make_unique<SceneBuilder::GroupScope>(*builder_) : nullptr;
  }

  /// The surface point(u, v), u and v from 0 to 1, as two triangles a cell.
  template <class Surface>
  void sheet(const Cells& cells, const Surface& point) {
    polygons_ += 2.0 * cells.around * cells.along * size_ * size_;
    if (!builder_) return;
    const auto whole_sheet = part();
    const int around = cells.around * size_, along = cells.along * size_;
    std::vector<Vec3d> row = ring(cells, point, 0), first = row;
    for (int j = 1; j <= along; ++j) {
      const bool back_at_start = cells.seam == Seam::both && j == along;
      std::vector<Vec3d> next = back_at_start ? first : ring(cells, point, static_cast<double>(j) / along);
      for (int i = 0; i < around; ++i) {
        builder_->triangle(row[i], row[i + 1], next[i + 1]);
        builder_->triangle(row[i], next[i + 1], next[i]);
      }
      row = std::move(next);
    }
  }

  /// A sheet sewn around, with its two flat ends covered by one polygon each.
  template <class Surface>
  void closed_sheet(const Cells& cells, const Surface& point) {
    const auto closed = part();
    sheet(cells, point);
    cap(cells, point, 0);
    cap(cells, point, 1);
  }

  /// The polygon that covers a sheet's flat end, v = 0 or v = 1.
  template <class Surface>
  void cap(const Cells& cells, const Surface& point, double v) {
    ++polygons_;
    if (!builder_) return;
    std::vector<Vec3d> corners = ring(cells, point, v);
    corners.pop_back();
    if (v == 0) std::reverse(corners.begin(), corners.end());
    builder_->polygon(corners);
  }

  /// A box with the given half widths along the axes of `frame`: six polygons.
  void box(const Affine& frame, const Vec3d& half) {
    const auto whole_box = part();
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-1.0, 1.0}) {
        std::array<Vec3d, 4> corners;
        for (int k = 0; k < 4; ++k) {
          Vec3d p{};
          p[axis] = side * half[axis];
          p[(axis + 1) % 3] = (k == 1 || k == 2 ? side : -side) * half[(axis + 1) % 3];
          p[(axis + 2) % 3] = (k >= 2 ? 1.0 : -1.0) * half[(axis + 2) % 3];
          corners[static_cast<std::size_t>(k)] = frame(p);
        }
        polygon(corners);
      }
  }

 private:
  /// The points of a sheet at v, the first one again at the end where the sheet is sewn around.
  template <class Surface>
  std::vector<Vec3d> ring(const Cells& cells, const Surface& point, double v) const {
    const int around = cells.around * size_;
    std::vector<Vec3d> points;
    points.reserve(static_cast<std::size_t>(around) + 1);
    for (int i = 0; i < around; ++i) points.push_back(point(static_cast<double>(i) / around, v));
    points.push_back(cells.seam == Seam::none ? point(1.0, v) : points.front());
    return points;
  }

  int size_;
  SceneBuilder* builder_;
  double polygons_ = 0;
};

/// The unit circle, by fractions of a turn.
inline Vec3d on_circle(double u) { return {std::cos(2 * kPi * u), std::sin(2 * kPi * u), 0}; }

/// A frame at `origin` whose z axis points along `z`.
inline Affine frame_along(const Vec3d& origin, const Vec3d& z) {
  const Vec3d e3 = normalized(z);
  const Vec3d e1 = normalized(cross(std::abs(e3.z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{1, 0, 0}, e3));
  const Vec3d e2 = cross(e3, e1);
  return {{e1.x, e2.x, e3.x}, {e1.y, e2.y, e3.y}, {e1.z, e2.z, e3.z}, origin};
}

/// A surface of revolution about the z axis of `frame`; profile(v) is the pair of radius and height.
template <class Profile>
auto revolved(const Affine& frame, const Profile& profile) {
  return [=](double u, double v) {
    const auto [radius, height] = profile(v);
    return frame(on_circle(u) * radius + Vec3d{0, 0, height});
  };
}

/// A round rod from a to b.
inline auto rod(const Vec3d& a, const Vec3d& b, double radius_a, double radius_b) {
  const double height = length(b - a);
  return revolved(frame_along(a, b - a), [=](double v) {
    return std::pair{radius_a + (radius_b - radius_a) * v, v * height};
  });
}
inline auto rod(const Vec3d& a, const Vec3d& b, double radius) { return rod(a, b, radius, radius); }

/// A torus about the z axis of `frame`, for a sheet sewn both ways.
inline auto torus(const Affine& frame, double radius, double tube_radius) {
  return revolved(frame, [=](double v) {
    return std::pair{radius - tube_radius * std::cos(2 * kPi * v), -tube_radius * std::sin(2 * kPi * v)};
  });
}

/// A tube of radius(v) along the curve path(v), which is nowhere parallel to `up`.
template <class Path, class Radius>
auto tube(const Path& path, const Vec3d& up, const Radius& radius) {
  return [=](double u, double v) {
    constexpr double kStep = 1e-5;
    const Vec3d tangent = normalized(path(v + kStep) - path(v - kStep));
    const Vec3d side = normalized(cross(up, tangent)), over = cross(tangent, side);
    const Vec3d c = on_circle(u);
    return path(v) + (side * c.x + over * c.y) * radius(v);
  };
}

/// A rounded box (a superellipsoid) about the origin of `frame`: exponent 1 is an ellipsoid, smaller ones are boxier. Its
/// poles, on the z axis, are flat.
inline auto rounded_box(const Affine& frame, const Vec3d& half, double exponent) {
  const auto power = [=](double x) { return std::copysign(std::pow(std::abs(x), exponent), x); };
  return [=](double u, double v) {
    const double latitude = (v - 0.5) * kPi * 0.96;
    const Vec3d c = on_circle(u);
    const double across = power(std::cos(latitude));
    return frame(Vec3d{half.x * across * power(c.x), half.y * across * power(c.y),
                       half.z * power(std::sin(latitude))});
  };
}
inline auto ellipsoid(const Affine& frame, const Vec3d& half) { return rounded_box(frame, half, 1); }

}  // namespace jevans

}  // namespace rayshoot
