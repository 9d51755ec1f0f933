// swarm, objects that fly in all directions (after Glassner 1988)
//
// Purpose    Motion: the box about all of an object's way is several times as large as the object, so a technique that knows
//            no time tests many objects that are elsewhere by then.
// Size       size^3 flying objects, spheres, cones and darts in turn, and a floor: 4 -> 128, 12 -> 3457 (default): a dart is
//            four triangles.
// Parameters speed (3): the longest way of an object, in units of the distance between neighbours.

#include <cmath>
#include <memory>

#include "scenes/core/registry.h"
#include "scenes/rays/random.h"

namespace rayshoot {

namespace {

constexpr std::uint64_t kSeed = 1988;
constexpr int kDartFaces = 4;

using Part = std::shared_ptr<const Scene>;

Part ball(const SceneOptions& options) {
  SceneBuilder builder(options);
  builder.material({{0.9, 0.75, 0.3}, 0.6, 0.3, 30, 0, 1});
  builder.sphere({0, 0, 0}, 0.25);
  return std::make_shared<const Scene>(std::move(builder).finish());
}

Part horn(const SceneOptions& options) {
  SceneBuilder builder(options);
  builder.material({{0.35, 0.55, 0.9}, 0.9, 0, 1, 0, 1});
  builder.cone({0, 0, -0.3}, 0.2, {0, 0, 0.3}, 0.05);
  return std::make_shared<const Scene>(std::move(builder).finish());
}

Part dart() {
  SceneBuilder builder;
  builder.material({{0.85, 0.3, 0.3}, 0.9, 0, 1, 0, 1});
  const std::array corners = {Vec3d{0, 0, 0.4}, Vec3d{0.2, 0.1, -0.2}, Vec3d{-0.2, 0.1, -0.2},
                              Vec3d{0, -0.15, -0.2}};
  for (int left_out = 0; left_out < kDartFaces; ++left_out)
    builder.triangle(corners[(left_out + 1) % 4], corners[(left_out + 2) % 4], corners[(left_out + 3) % 4]);
  return std::make_shared<const Scene>(std::move(builder).finish());
}

void generate(const SceneOptions& options, const Arguments& arguments, SceneBuilder& builder) {
  const double n = options.size, speed = arguments.real("speed");
  builder.background({0.1, 0.12, 0.2});
  builder.view(
      {.from = {-0.6 * n, -1.1 * n, 1.1 * n}, .at = {n / 2, n / 2, 0.4 * n}, .up = {0, 0, 1}, .angle = 45});
  builder.light({-n, -2 * n, 4 * n});
  builder.material({{0.5, 0.5, 0.55}, 0.9, 0, 1, 0, 1});
  builder.polygon(
      std::array{Vec3d{-n, -n, -4}, Vec3d{2 * n, -n, -4}, Vec3d{2 * n, 2 * n, -4}, Vec3d{-n, 2 * n, -4}});

  const std::array parts = {ball(options), horn(options), dart()};
  const RandomNumbers random(kSeed);
  std::uint64_t number = 0;
  for (int x = 0; x < options.size; ++x)
    for (int y = 0; y < options.size; ++y)
      for (int z = 0; z < options.size; ++z, ++number) {
        // A place in its cell, a turn and a way, each at random.
        const auto signed_unit = [&](std::uint64_t dimension) {
          return 2 * random.uniform(number, dimension) - 1;
        };
        const Vec3d place{x + 0.3 * signed_unit(0), y + 0.3 * signed_unit(1), z + 0.3 * signed_unit(2)};
        const Vec3d axis{signed_unit(3), signed_unit(4), signed_unit(5) + 2},
            way{signed_unit(6), signed_unit(7), signed_unit(8)};
        const Affine turned = rotation(normalized(axis), 3 * signed_unit(9));
        builder.place(parts[number % parts.size()], compose(translation(place), turned),
                      way * (speed * random.uniform(number, 10) / std::max(1.0, length(way))));
      }
}

double flying(const SceneOptions& options) { return std::pow(options.size, 3); }

double object_count(const SceneOptions& options, const Arguments&) {
  const double count = flying(options), darts = std::floor(count / 3), horns = std::floor((count + 1) / 3);
  return 1 + (count - darts - horns) * patches_of_sphere(options) + horns * patches_of_cone(options) +
         darts * kDartFaces;
}

double stored_objects(const SceneOptions& options, const Arguments&) {
  return 1 + flying(options) + patches_of_sphere(options) + patches_of_cone(options) + kDartFaces;
}

}  // namespace

const SceneGenerator& scene_swarm() {
  static const SceneGenerator generator{
      .id = "swarm",
      .title = "Objects that fly in all directions",
      .source = "after Glassner, Spacetime Ray Tracing for Animation, 1988",
      .default_size = 12,
      .min_size = 2,
      .purpose = "moving objects whose ways cross: size^3 of them over a floor",
      .parameters = {real_parameter(
          "speed", 3, 0, 1000, "the longest way of an object, in units of the distance between neighbours")},
      .object_count = object_count,
      .stored_objects = stored_objects,
      .generate = generate};
  return generator;
}

}  // namespace rayshoot
