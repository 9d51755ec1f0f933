// gears, meshing gears in a cubic arrangement (Haines 1987)
//
// Purpose    Polygons of very different complexity and shape: 128 non-convex faces of 144 vertices next to
//            thousands of thin quadrilaterals; a fifth of the gears are glass.
// Size       1 + 146 size³ polygons: 1 → 147, 2 → 1169, 4 → 9345 (default), 5 → 18251.

#include <algorithm>
#include <cmath>

#include "scenes/spd/database.h"

namespace rayshoot {

namespace {

constexpr int kTeeth = 36;
constexpr double kToothAngle = 2 * spd::kPi / kTeeth;

using Outline = std::array<Vec3d, 4 * kTeeth>;

struct Gear {
  Vec3d centre;
  double radius, thickness;
  /// By how much the first tooth is turned from the x axis.
  double phase;
};

/// The outline of a gear's top, counter-clockwise for `sense` 1, clockwise for -1: four points a tooth.
Outline outline(const Gear& gear, double sense) {
  const double tip = 0.995 * gear.radius, root = 0.9 * gear.radius, tooth = sense * kToothAngle;
  Outline points;
  auto next = points.begin();
  for (int n = 0; n < kTeeth; ++n) {
    const double middle = gear.phase + n * tooth;
    const auto add = [&](double radius, double angle) {
      *next++ = gear.centre + Vec3d{radius * std::cos(angle), radius * std::sin(angle), 0};
    };
    add(tip, middle - 0.19 * tooth);
    add(tip, middle + 0.19 * tooth);
    add(root, middle + 0.3 * tooth);
    add(root, middle + 0.7 * tooth);
  }
  return points;
}

void emit(SceneBuilder& builder, const Gear& gear) {
  const auto whole_gear = builder.group();
  const Vec3d down{0, 0, -gear.thickness};
  const Outline top = outline(gear, 1);
  builder.polygon(top);
  for (std::size_t tooth = 0; tooth < top.size(); tooth += 4) {
    const auto faces_of_tooth = builder.group();
    for (std::size_t i = tooth; i < tooth + 4; ++i) {
      const Vec3d &a = top[i], &b = top[(i + 1) % top.size()];
      builder.polygon(std::array{a, a + down, b + down, b});
    }
  }
  builder.polygon(outline({gear.centre + down, gear.radius, gear.thickness, gear.phase}, -1));
}

/// A colour for each place of the arrangement, one component at its full value; every fifth gear is of glass.
Material material_at(int ix, int iy, int iz) {
  const auto shade = [](int sum, int numerator) {
    const double value = static_cast<double>(sum) * numerator / 7;
    return 0.01 + (value - std::trunc(value));
  };
  const Vec3d colour{shade(3 * ix + 2 * iy + iz + 1, 5), shade(ix + 3 * iy + 2 * iz + 1, 3),
                     shade(2 * ix + iy + 3 * iz + 1, 2)};
  const double full = max_abs(colour);
  const Vec3d bright{colour.x / full, colour.y / full, colour.z / full};
  if ((4 * ix + 2 * iy + iz) % 5 == 0) return {bright, 0.2, 0, spd::kNoHighlight, 0.8, 1.1};
  return {bright, 1, 0, spd::kNoHighlight, 0, 0};
}

void generate(const SceneOptions& options, const Arguments&, SceneBuilder& builder) {
  spd::open(builder, {.from = {-1.1, -2.1, 2.6}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle = 45, .hither = 1},
            {{2, 4, 4}, {-2, 4, 3}, {2, -2.5, 2.5}, {-1, -4, 2}, {-1.111, -2.121, 2.626}});
  builder.material({{1, 0.85, 0.7}, 0.3, 0.6, shine_from_highlight_angle(37), 0, 0});
  builder.polygon(std::array{Vec3d{2, 2, 0}, Vec3d{-2, 2, 0}, Vec3d{-2, -2, 0}, Vec3d{2, -2, 0}});

  // Fill the cube [-1,1] x [-1,1] x [0,1]; neighbours overlap by a twentieth of a radius, so that their teeth
  // mesh.
  const int size = options.size;
  const double radius = 1 / (size - 0.05 * (size - 1)), pitch = 1.9 * radius;
  const double thickness = std::min(0.1, 1 / (2.0 * size));
  for (int iz = 0; iz < size; ++iz) {
    const auto layer = builder.group();
    for (int iy = 0; iy < size; ++iy) {
      const auto row = builder.group();
      for (int ix = 0; ix < size; ++ix) {
        builder.material(material_at(ix, iy, iz));
        const Vec3d centre{-1 + radius + pitch * ix, -1 + radius + pitch * iy,
                           1 - static_cast<double>(iz) / size};
        emit(builder, {centre, radius, thickness, (ix + iy + iz) % 2 == 1 ? kToothAngle / 2 : 0});
      }
    }
  }
}

double object_count(const SceneOptions& options, const Arguments&) {
  return 1 + 146 * std::pow(options.size, 3);
}

}  // namespace

const SceneGenerator& scene_gears() {
  static const SceneGenerator generator{.id = "gears",
                                        .title = "Gears",
                                        .source = spd::kPaper,
                                        .default_size = 4,
                                        .min_size = 1,
                                        .purpose =
                                            "non-convex polygons of 144 vertices among thin quadrilaterals, "
                                            "some of glass; 1 + 146 size^3 polygons",
                                        .parameters = {},
                                        .object_count = object_count,
                                        .generate = generate};
  return generator;
}

}  // namespace rayshoot
