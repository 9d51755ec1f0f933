// shells, a sea shell of overlapping spheres (SPD package)
//
// Purpose    Spheres that overlap one another heavily and shrink geometrically along a spiral: any ray that
//            meets the shell pierces dozens of them, so culling by volume helps little and stopping early
//            helps much.
// Size       180·2^size + 1 spheres: 3 → 1441, 5 → 5761 (default), 6 → 11521. More spheres fill the same
//            spiral.

#include <cmath>

#include "scenes/spd/database.h"

namespace rayshoot {

namespace {

void generate(const SceneOptions& options, const Arguments&, SceneBuilder& builder) {
  spd::open(builder, {.from = {-6, -60, 35}, .at = {0, 8, -15}, .up = {0, 0, 1}, .angle = 45, .hither = 0.5},
            {{-100, -100, 100}});
  builder.material({{1, 0.8, 0.4}, 0.8, 0.2, shine_from_highlight_angle(10), 0, 1});

  // Nine turns of a logarithmic spiral, six inwards and three outwards of radius 1.
  const long long n = 180LL << options.size;
  std::optional<SceneBuilder::GroupScope> turn;
  for (long long i = -2 * n / 3; i <= n / 3; ++i) {
    if (9 * i % n == 0) turn.emplace(builder);
    const double angle = 18 * spd::kPi * static_cast<double>(i) / static_cast<double>(n);
    const double radius = std::exp(0.15 * angle);
    builder.sphere({radius * std::sin(angle), radius * std::cos(angle), -2 * radius}, radius);
  }
}

double object_count(const SceneOptions& options, const Arguments&) {
  return (180 * std::pow(2, options.size) + 1) * patches_of_sphere(options);
}

}  // namespace

const SceneGenerator& scene_shells() {
  static const SceneGenerator generator{.id = "shells",
                                        .title = "Sea shell",
                                        .source = spd::kPackage,
                                        .default_size = 5,
                                        .min_size = 1,
                                        .purpose =
                                            "heavily overlapping spheres of geometrically growing size; "
                                            "180*2^size + 1 spheres",
                                        .parameters = {},
                                        .object_count = object_count,
                                        .generate = generate};
  return generator;
}

}  // namespace rayshoot
