// lattice, spheres joined by cylinders in a cubic lattice (SPD package)
//
// Purpose    Equal objects, evenly spread, all around the eye: the ideal case for uniform subdivision. Every
//            object has a material of its own, as in the original.
// Size       (size+1)³ spheres and 3 size (size+1)² cylinders: 5 → 756, 12 → 8281 (default), 14 → 12825.

#include <cmath>

#include "scenes/spd/database.h"

namespace rayshoot {

namespace {

void generate(const SceneOptions& options, const Arguments&, SceneBuilder& builder) {
  // The eye is inside, between the middle planes.
  const double size = options.size;
  const double middle = (std::floor(size / 2) + 0.5) / size, half_cell = 1 / (2 * size);
  spd::open(builder,
            {.from = {middle, 1, 1 - half_cell},
             .at = {middle, -1, -1 - half_cell},
             .up = {0.2, 1, 0},
             .angle = 60,
             .hither = 0},
            {{2, 0.5, 0.5}, {-1, 0.5, 0.5}, {0.5, 2, 0.5}, {0.5, -1, 0.5}, {0.5, 0.5, 2}, {0.5, 0.5, -1}});

  const Material node{{0.9, 0.9, 0.9}, 0.5, 0.5, shine_from_highlight_angle(37), 0, 0};
  const double sphere_radius = 1 / (4 * size), rod_radius = 1 / (16 * size);
  const double gap = 0.99 * sphere_radius / 2;
  for (int x = 0; x <= options.size; ++x) {
    const auto layer = builder.group();
    for (int y = 0; y <= options.size; ++y) {
      const auto row = builder.group();
      for (int z = 0; z <= options.size; ++z) {
        const auto node_with_rods = builder.group();
        const std::array at{x, y, z};
        const Vec3d centre{x / size, y / size, z / size};
        builder.material(node);
        builder.sphere(centre, sphere_radius);

        // A rod to the next node along each axis; its ends are hidden in the spheres.
        for (int axis = 0; axis < 3; ++axis) {
          if (at[axis] == options.size) continue;
          Vec3d colour{0.1, 0.1, 0.1}, from = centre, to = centre;
          colour[axis] = 0.9;
          from[axis] += gap, to[axis] = centre[axis] + 1 / size - gap;
          builder.material({colour, 0.99, 0, spd::kNoHighlight, 0, 0});
          builder.cone(from, rod_radius, to, rod_radius);
        }
      }
    }
  }
}

double object_count(const SceneOptions& options, const Arguments&) {
  const double s = options.size;
  return (s + 1) * (s + 1) * ((s + 1) * patches_of_sphere(options) + 3 * s * patches_of_cone(options));
}

}  // namespace

const SceneGenerator& scene_lattice() {
  static const SceneGenerator generator{.id = "lattice",
                                        .title = "Lattice of spheres and cylinders",
                                        .source = spd::kPackage,
                                        .default_size = 12,
                                        .min_size = 1,
                                        .purpose =
                                            "equal spheres and cylinders, evenly spread around the eye; "
                                            "(size+1)^3 spheres, 3 size (size+1)^2 cylinders",
                                        .parameters = {},
                                        .object_count = object_count,
                                        .generate = generate};
  return generator;
}

}  // namespace rayshoot
