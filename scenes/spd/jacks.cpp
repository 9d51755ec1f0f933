// jacks, a recursive cube of jacks (SPD package)
//
// Purpose    Thin crossing cylinders with spheres at their ends, nested in one another over several scales.
// Size       9 objects a jack (3 cylinders, 6 spheres), sum of 8^k jacks for k = 0 to size-1: 1 → 9
//            (default), 2 → 81, 3 → 657. A jack becomes 336 patches: its tessellation is always 2, whatever
//            is asked for, and its normals are as long as it is small (1/scale), as in the original.

#include "scenes/spd/database.h"

namespace rayshoot {

namespace {

constexpr double kJackScale = 0.75;
constexpr int kTessellation = 2;

/// The unit jack, scaled into its place.
void jack(SceneBuilder& builder, const Affine& place, double scale) {
  const Vec3d axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  builder.place_in(compose(place, scaling(kJackScale)), scale);
  for (const Vec3d& axis : axes) builder.cone(-axis, 0.1, axis, 0.1);
  for (const Vec3d& axis : axes) builder.sphere(axis, 0.2);
  for (const Vec3d& axis : axes) builder.sphere(-axis, 0.2);
}

/// A jack and, at the corners of a cube around it, eight half its size.
void divide(SceneBuilder& builder, const Affine& place, double scale, int levels) {
  const auto jack_with_smaller = builder.group();
  jack(builder, place, scale);
  if (levels == 1) return;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double z : {-0.5, 0.5})
        divide(builder, compose(place, compose(translation({x, y, z}), scaling(0.5))), 0.5 * scale,
               levels - 1);
}

void generate(const SceneOptions& options, const Arguments&, SceneBuilder& builder) {
  spd::open(builder,
            {.from = {0, 0, -8},
             .at = {0, 0, 0},
             .up = {0, 1, 0},
             .angle = 25,
             .hither = 0.001,
             .width = 256,
             .height = 256},
            {{-10, 3, -20}}, {0.2, 0.05, 0.2});
  builder.material({{0.737, 0.561, 0.561}, 0.7, 0.7, shine_from_highlight_angle(20), 0, 1});
  builder.override_tessellation(kTessellation);
  const Affine root = compose(rotation({1, 0, 0}, spd::radians(-30)), rotation({0, 1, 0}, spd::radians(-20)));
  divide(builder, root, kJackScale, options.size);
}

double object_count(const SceneOptions& options, const Arguments&) {
  SceneOptions tessellated = options;
  tessellated.tessellation = kTessellation;
  const double jacks = (std::pow(8, options.size) - 1) / 7;
  return jacks * (3 * patches_of_cone(tessellated) + 6 * patches_of_sphere(tessellated));
}

}  // namespace

const SceneGenerator& scene_jacks() {
  static const SceneGenerator generator{.id = "jacks",
                                        .title = "Jacks",
                                        .source = spd::kPackage,
                                        .default_size = 1,
                                        .min_size = 1,
                                        .purpose =
                                            "thin crossing cylinders with spheres at their ends, nested over "
                                            "several scales; 9 (8^size - 1) / 7",
                                        .parameters = {},
                                        .object_count = object_count,
                                        .generate = generate};
  return generator;
}

}  // namespace rayshoot
