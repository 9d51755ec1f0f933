// sombrero, the graph of a damped cosine (SPD package)
//
// Purpose    A smooth height field in a regular grid of triangles: evenly spread, connected, all near one
//            surface.
// Size       2 (w-1)² triangles over w = 32·2^(size-1) samples a side: 1 → 1922 (default), 2 → 7938, 3 →
//            32258.
// Heights    are rounded to single precision and sampled at accumulated positions that end one step short of
//            the border, off the centre, as in the original.

#include <cmath>
#include <vector>

#include "scenes/spd/database.h"

namespace rayshoot {

namespace {

int samples(const SceneOptions& options) { return 32 << (options.size - 1); }

float height(double x, double y) {
  const double distance = std::sqrt(x * x + y * y);
  return static_cast<float>(3 * std::cos(2 * 3.14159265358 * distance) * std::exp(-distance) / 3);
}

/// One row of the graph: its heights are sampled along y, its vertices lie at depth z.
std::vector<Vec3d> row(int width, double y, double z) {
  const double step = 8.0 / width, edge = 8.0 / (width - 1);
  std::vector<Vec3d> vertices(width);
  double x = -4;
  for (int j = 0; j < width; ++j, x += step)
    vertices[j] = {-4 + j * edge, -3 + static_cast<double>(height(x, y)), z};
  return vertices;
}

void generate(const SceneOptions& options, const Arguments&, SceneBuilder& builder) {
  spd::open(builder, {.from = {0, 5, -8}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle = 40, .hither = 0.01},
            {{10, 10, -10}});
  builder.material({{1, 0.1, 0.1}, 0.8, 0, shine_from_highlight_angle(40), 0, 1});

  // Walk from row to row, two triangles a cell.
  const int width = samples(options);
  const double step = 8.0 / width, edge = 8.0 / (width - 1);
  double y = -4;
  std::vector<Vec3d> previous = row(width, y, -4);
  for (int i = 1; i < width; ++i) {
    y += step;
    const auto strip = builder.group();
    std::vector<Vec3d> current = row(width, y, -4 + i * edge);
    for (int j = 0; j + 1 < width; ++j) {
      builder.triangle(previous[j], current[j + 1], previous[j + 1]);
      builder.triangle(previous[j], current[j], current[j + 1]);
    }
    previous = std::move(current);
  }
}

double object_count(const SceneOptions& options, const Arguments&) {
  const double cells = 32 * std::pow(2, options.size - 1) - 1;
  return 2 * cells * cells;
}

}  // namespace

const SceneGenerator& scene_sombrero() {
  static const SceneGenerator generator{.id = "sombrero",
                                        .title = "Sombrero",
                                        .source = spd::kPackage,
                                        .default_size = 1,
                                        .min_size = 1,
                                        .purpose =
                                            "a smooth height field in a regular grid of triangles; "
                                            "2 (32*2^(size-1) - 1)^2 triangles",
                                        .parameters = {},
                                        .object_count = object_count,
                                        .generate = generate};
  return generator;
}

}  // namespace rayshoot
