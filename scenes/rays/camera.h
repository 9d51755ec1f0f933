#pragma once

#include <vector>

#include "scenes/core/scene.h"

namespace rayshoot {

/// The two ways in which published ray counts laid a square of rays over the view.
enum class PixelGrid {
  edge_to_edge,      ///< the outermost rays lie on the frustum's edge (Havran): -1 + 2 i / (n - 1)
  pixel_corners_512  ///< NFF's angle spans pixel centres, rays go through their corners (Haines): (i - m) /
                     ///< (m - 1/2)
};

/// The pinhole camera of a view. A view that looks nowhere or straight up along `up` gets some frame instead.
class Camera {
 public:
  explicit Camera(const View& view);

  /// The ray through the image point (right, up), each -1 to 1 across the field of view; of unit direction.
  Ray<double> ray(double right, double up) const;

 private:
  Vec3d from_, forward_, right_, up_;
};

/// resolution x resolution eye rays in rows from the upper left.
std::vector<Ray<double>> pixel_rays(const View& view, int resolution, PixelGrid grid);

}  // namespace rayshoot
