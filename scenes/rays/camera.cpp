#include "scenes/rays/camera.h"

#include <numbers>

namespace rayshoot {

namespace {

Vec3d unit_or(const Vec3d& vector, const Vec3d& otherwise) {
  const Vec3d unit = normalized(vector);
  return is_finite(unit) ? unit : otherwise;
}

/// Image coordinate of sample i of n, where n >= 3.
double image_coordinate(int i, int n, PixelGrid grid) {
  const double middle = 0.5 * (n - 1);
  return (i - middle) / (grid == PixelGrid::edge_to_edge ? middle : middle - 0.5);
}

}  // namespace

Camera::Camera(const View& view) : from_(view.from) {
  forward_ = unit_or(view.at - view.from, {0, 0, 1});
  const Vec3d any_side = std::abs(forward_.z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{1, 0, 0};
  right_ = unit_or(cross(forward_, view.up), normalized(cross(forward_, any_side)));
  up_ = cross(right_, forward_);
  const double half_width = std::tan(view.angle * std::numbers::pi / 360);
  right_ *= half_width, up_ *= half_width;
}

Ray<double> Camera::ray(double right, double up) const {
  return {.origin = from_, .direction = normalized(forward_ + right_ * right + up_ * up)};
}

std::vector<Ray<double>> pixel_rays(const View& view, int resolution, PixelGrid grid) {
  const Camera camera(view);
  std::vector<Ray<double>> rays;
  rays.reserve(static_cast<std::size_t>(resolution) * resolution);
  for (int row = 0; row < resolution; ++row)
    for (int column = 0; column < resolution; ++column)
      rays.push_back(
          camera.ray(image_coordinate(column, resolution, grid), -image_coordinate(row, resolution, grid)));
  return rays;
}

}  // namespace rayshoot
