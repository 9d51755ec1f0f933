#pragma once

#include <vector>

#include "scenes/core/scene.h"

namespace rayshoot {

/// Rows [first, last) of a picture.
struct Rows {
  int first, last;
};

/// The rays through some rows of a picture, samples x samples to a pixel, evenly over its area. The field of
/// view spans the picture's shorter side.
std::vector<Ray<double>> eye_rays(const View& view, int width, int height, const Rows& rows, int samples);

}  // namespace rayshoot
