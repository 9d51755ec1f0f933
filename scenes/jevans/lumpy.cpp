// lumpy, a small creature in a wide landscape (after Jevans 1990)
//
// Purpose    Large extents with most polygons in one small place, whose own extents differ from axis to axis. A uniform
//            grid leaves that place in a few cells, an octree grows deep to reach it, and Jevans' one-dimensional grids
//            gain on three-dimensional ones because they divide its long axis alone.
// Idea       A lumpy caterpillar six units long stands on a coarse desert of 1200 by 900 units among ten mesas.
// Size       366 size^2 + 82 polygons: 1 → 448, 4 → 5938 (default, Jevans' number), 8 → 23506.

#include "scenes/jevans/sculptor.h"

namespace rayshoot {

namespace {

using jevans::Sculptor;
using jevans::Seam;

/// Dunes that die away where the creature stands.
double ground_height(double x, double y) {
  const double dunes = 7 * std::sin(x / 47 + 1) * std::cos(y / 61) + 5 * std::sin((x + y) / 113);
  return dunes * std::min(1.0, std::hypot(x, y) / 300);
}

void landscape(Sculptor& sculptor) {
  const auto together = sculptor.part();
  sculptor.material({{0.87, 0.7, 0.45}, 0.9, 0, 100000, 0, 1});
  sculptor.sheet({5, 4, Seam::none}, [](double u, double v) {
    const double x = 1200 * (u - 0.5), y = 900 * (v - 0.5);
    return Vec3d{x, y, ground_height(x, y)};
  });
  // Place, half widths and turn of each mesa; a mesa reaches as far below the ground as it is wide.
  struct Mesa {
    double x, y, width, depth, height, turn;
  };
  constexpr Mesa kMesas[] = {{-560, 120, 30, 22, 75, 0.3}, {-430, 300, 55, 30, 60, 0.9},
                             {-390, -40, 16, 18, 62, 0.1}, {-300, 390, 28, 24, 95, 0.5},
                             {-180, 340, 42, 20, 50, 1.2}, {-520, -210, 40, 34, 55, 0.7},
                             {-60, 410, 24, 26, 70, 0.2},  {330, 330, 50, 30, 80, 0.6},
                             {470, -120, 30, 45, 65, 1.0}, {180, -380, 36, 26, 58, 0.4}};
  sculptor.material({{0.72, 0.38, 0.24}, 0.9, 0, 100000, 0, 1});
  for (const Mesa& mesa : kMesas)
    sculptor.box(compose(translation({mesa.x, mesa.y, (mesa.height - mesa.width) / 2}),
                         rotation({0, 0, 1}, mesa.turn)),
                 {mesa.width, mesa.depth, (mesa.height + mesa.width) / 2});
}

/// The middle of the body from head (v = 0) to tail.
Vec3d spine(double v) { return {2.6 - 5.4 * v, 0.3 * std::sin(6 * v), 0.8 + 0.15 * std::sin(8 * v)}; }

/// Seven lumps, smaller towards the tail.
double girth(double v) { return (0.3 + 0.22 * std::abs(std::sin(7 * jevans::kPi * v))) * (1.15 - 0.5 * v); }

void creature(Sculptor& sculptor) {
  const auto together = sculptor.part();
  sculptor.material({{0.3, 0.7, 0.25}, 0.8, 0.05, 30, 0, 1});
  sculptor.closed_sheet({6, 13}, jevans::tube(spine, {0, 0, 1}, girth));
  sculptor.closed_sheet({5, 5}, jevans::ellipsoid(translation({2.95, 0, 1.15}), {0.6, 0.58, 0.6}));

  sculptor.material({{0.85, 0.3, 0.15}, 0.8, 0.05, 30, 0, 1});
  for (const double side : {-1.0, 1.0}) {
    for (const double where : {0.12, 0.4, 0.7}) {
      const Vec3d hip = spine(where) + Vec3d{0, 0.25 * side, 0};
      sculptor.closed_sheet({3, 2}, jevans::rod(hip, {hip.x, hip.y + 0.2 * side, -0.05}, 0.24, 0.16));
    }
    const Vec3d root{2.9, 0.25 * side, 1.6}, tip{3.1, 0.5 * side, 2.35};
    const auto antenna = jevans::rod(root, tip, 0.05, 0.09);
    sculptor.sheet({3, 1}, antenna);
    sculptor.cap({3, 1}, antenna, 1);
  }
  sculptor.material({{0.98, 0.98, 0.95}, 0.8, 0.1, 100, 0, 1});
  for (const double side : {-1.0, 1.0})
    sculptor.closed_sheet({3, 3},
                          jevans::ellipsoid(translation({3.38, 0.24 * side, 1.38}), {0.16, 0.17, 0.2}));
}

void model(Sculptor& sculptor) {
  landscape(sculptor);
  creature(sculptor);
}

void generate(const SceneOptions& options, const Arguments&, SceneBuilder& builder) {
  builder.background({0.6, 0.78, 0.95});
  builder.view(
      {.from = {7.5, -7, 2.9}, .at = {0.3, 0.3, 1.05}, .up = {0, 0, 1}, .angle = 40, .hither = 0.01});
  builder.light({400, -300, 500});
  builder.light({-100, -500, 300});
  Sculptor sculptor(options.size, &builder);
  model(sculptor);
}

double object_count(const SceneOptions& options, const Arguments&) {
  Sculptor counter(options.size);
  model(counter);
  return counter.polygons();
}

}  // namespace

const SceneGenerator& scene_lumpy() {
  static const SceneGenerator generator{
      .id = "lumpy",
      .title = "Creature in a wide landscape",
      .source = jevans::kPaper,
      .default_size = 4,
      .min_size = 1,
      .purpose = "most polygons in a small long place of a very large scene; 366 size^2 + 82 polygons",
      .parameters = {},
      .object_count = object_count,
      .generate = generate};
  return generator;
}

}  // namespace rayshoot
