#include "harness/render/eye_rays.h"

#include <algorithm>

#include "scenes/rays/camera.h"

namespace rayshoot {

std::vector<Ray<double>> eye_rays(const View& view, int width, int height, const Rows& rows, int samples) {
  const Camera camera(view);
  const double half = 0.5 * std::min(width, height);
  std::vector<Ray<double>> rays;
  rays.reserve(static_cast<std::size_t>(rows.last - rows.first) * width * samples * samples);
  for (int y = rows.first; y < rows.last; ++y)
    for (int x = 0; x < width; ++x)
      for (int sample = 0; sample < samples * samples; ++sample) {
        const double across = x + (sample % samples + 0.5) / samples;
        const double down = y + (sample / samples + 0.5) / samples;
        rays.push_back(camera.ray((across - 0.5 * width) / half, (0.5 * height - down) / half));
      }
  return rays;
}

}  // namespace rayshoot
