// grass, a meadow of tufts (after Snyder & Barr 1987)
//
// Purpose    Far more objects than memory holds. A tuft of 25 blades is stored once; a patch places a hundred tufts, a lawn a
//            hundred patches, and so on, each time turned.
// Size       25 * 100^size blades and the ground: 1 -> 2501, 2 -> 250,001 (default), 3 -> 2.5e7, 4 -> 2.5e9. What is
//            stored are 26 objects and 100 places for each unit of size.

#include <cmath>
#include <memory>
#include <numbers>

#include "scenes/core/registry.h"
#include "scenes/rays/random.h"

namespace rayshoot {

namespace {

constexpr int kBlades = 25, kRows = 10;
constexpr double kTurn = 2 * std::numbers::pi;
constexpr std::uint64_t kSeed = 1987;

/// Triangles about the middle of a cell of one unit, which bend away from it.
std::shared_ptr<const Scene> tuft() {
  const RandomNumbers random(kSeed);
  SceneBuilder builder;
  for (int blade = 0; blade < kBlades; ++blade) {
    const auto u = [&](std::uint64_t dimension) {
      return random.uniform(static_cast<std::uint64_t>(blade), dimension);
    };
    builder.material({{0.15 + 0.2 * u(0), 0.45 + 0.3 * u(1), 0.12}, 0.9, 0, 1, 0, 1});
    const Affine around = rotation({0, 0, 1}, kTurn * (blade + u(2)) / kBlades);
    const double out = 0.1 + 0.25 * u(3), lean = 0.05 + 0.1 * u(4), height = 0.5 + 0.6 * u(5);
    builder.triangle(around(Vec3d{out, -0.03, 0}), around(Vec3d{out, 0.03, 0}),
                     around(Vec3d{out + lean, 0, height}));
  }
  return std::make_shared<const Scene>(std::move(builder).finish());
}

/// Ten rows of ten cells of `side` units, a part in the middle of each, turned: a tuft by any angle, what is square by
/// quarters. The first corner is at the origin.
std::shared_ptr<const Scene> rows_of(const std::shared_ptr<const Scene>& part, double side, bool square) {
  const RandomNumbers random(kSeed + static_cast<std::uint64_t>(side));
  const double middle = square ? side / 2 : 0;
  SceneBuilder builder;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kRows; ++column) {
      const double u = random.uniform(static_cast<std::uint64_t>(kRows * row + column), 0);
      const double angle = square ? std::floor(4 * u) * kTurn / 4 : kTurn * u;
      const Affine turned = compose(rotation({0, 0, 1}, angle), translation({-middle, -middle, 0}));
      builder.place(part, compose(translation({(column + 0.5) * side, (row + 0.5) * side, 0}), turned));
    }
  return std::make_shared<const Scene>(std::move(builder).finish());
}

void generate(const SceneOptions& options, const Arguments&, SceneBuilder& builder) {
  std::shared_ptr<const Scene> meadow = tuft();
  double side = 1;
  for (int level = 0; level < options.size; ++level, side *= kRows) meadow = rows_of(meadow, side, level > 0);

  builder.background({0.55, 0.75, 0.95});
  builder.view({.from = {side / 2, -3, 2.2}, .at = {side / 2 + 1, 8, 0.4}, .up = {0, 0, 1}, .angle = 50});
  builder.light({side / 2 - 40, -30, 60});
  builder.material({{0.35, 0.25, 0.15}, 0.9, 0, 1, 0, 1});
  builder.polygon(std::array{Vec3d{0, 0, 0}, Vec3d{side, 0, 0}, Vec3d{side, side, 0}, Vec3d{0, side, 0}});
  builder.place(meadow, {});
}

double object_count(const SceneOptions& options, const Arguments&) {
  return 1 + kBlades * std::pow(kRows * kRows, options.size);
}

double stored_objects(const SceneOptions& options, const Arguments&) {
  return 2 + kBlades + static_cast<double>(kRows) * kRows * options.size;
}

}  // namespace

const SceneGenerator& scene_grass() {
  static const SceneGenerator generator{
      .id = "grass",
      .title = "Meadow of placed tufts",
      .source = "after Snyder & Barr, Ray Tracing Complex Models Containing Surface Tessellations, 1987",
      .default_size = 2,
      .min_size = 1,
      .purpose = "parts placed in parts: 25 * 100^size blades, few of them stored",
      .parameters = {},
      .object_count = object_count,
      .stored_objects = stored_objects,
      .generate = generate};
  return generator;
}

}  // namespace rayshoot
