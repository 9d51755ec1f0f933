// coplanar_overlap, STIFF 14: overlapping tiles, and decals close above them
//
// Construction  Overlapping rectangles in one plane, and small ones in a plane `gap` units in the last place
//               above, both with all corners on the lattice, so that planes are exact. Rays fall from above
//               onto points of the lattice: many onto edges and corners.
// Property      The exact nearest: the decal where there is one, unless the gap is 0, when the lowest number
//               wins.
// Metric        Rate of wrong order as a function of the gap.
// Size          120 tiles, times 4 with every size, at most 122,880; gaps 0, 1, 2, 16 in the short form,
//               powers of two up to 256 from size 2.
// Anchor        None: no suite known has a gap of less than 1e-6.

#include <fmt/format.h>

#include <array>

#include "scenes/stiff/parts/scenes.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

constexpr double kLattice = 0x1p-8;
/// The last place of floats from 1 to 2, where the heights of all corners are.
constexpr double kUlp = 0x1p-23;

/// Height of the plane: level, or tilted in multiples of an eighth of the lattice.
double height(bool tilted, double x, double y) { return 1.5 + (tilted ? (x + y) / 8 : 0); }

void add_tile(SceneBuilder& builder, bool tilted, double above, double size, const RandomNumbers& random,
              std::uint64_t number) {
  const Vec3d lo = snapped(point_in_cube(random, number, 0) * (1 - size), kLattice);
  const double width = kLattice * pick(random, number, 3, 4, static_cast<int>(size / kLattice));
  const double depth = kLattice * pick(random, number, 4, 4, static_cast<int>(size / kLattice));
  const auto corner = [&](double x, double y) { return Vec3d{x, y, height(tilted, x, y) + above}; };
  const Vec3d a = corner(lo.x, lo.y), b = corner(lo.x + width, lo.y), c = corner(lo.x + width, lo.y + depth);
  const Vec3d d = corner(lo.x, lo.y + depth);
  if (number % 3 == 0) return builder.polygon(std::array{a, b, c, d});
  builder.triangle(a, b, c);
  builder.triangle(a, c, d);
}

std::shared_ptr<const Scene> tiles(bool tilted, int gap, int size, std::uint64_t seed,
                                   const std::string& label) {
  const RandomNumbers random(seed);
  SceneBuilder builder;
  const std::uint64_t count = 60ull << std::min(2 * (size - 1), 10);
  for (std::uint64_t i = 0; i < count; ++i) add_tile(builder, tilted, 0, 0.5, random, i);
  for (std::uint64_t i = count; i < 2 * count; ++i) add_tile(builder, tilted, gap * kUlp, 0.125, random, i);
  return share(std::move(builder), "coplanar_overlap(" + label + ")");
}

Ray<double> falling_ray(bool tilted, const RandomNumbers& random, std::uint64_t number) {
  const Vec3d foot = snapped(point_in_cube(random, number, 0), kLattice);
  const Vec3d aside = snapped(point_in_cube(random, number, 3), kLattice);
  const Vec3d target{foot.x, foot.y, height(tilted, foot.x, foot.y)};
  return ray_to({target.x + aside.x, target.y + aside.y, 4}, target);
}

std::vector<StiffSetting> settings(int size, std::uint64_t seed) {
  std::vector<int> gaps{0, 1, 2, 16};
  if (size > 1) gaps = {0, 1, 2, 4, 8, 16, 32, 64, 128, 256};
  std::vector<StiffSetting> result;
  for (const bool tilted : {false, true})
    for (const int gap : gaps) {
      const std::string label = fmt::format("plane={},gap_ulps={}", tilted ? "tilted" : "level", gap);
      result.push_back({.label = label,
                        .scene = tiles(tilted, gap, size, seed, label),
                        .rays = ray_by_ray([tilted](const RandomNumbers& random, std::uint64_t number) {
                          return falling_ray(tilted, random, number);
                        }),
                        .stiffness_parameter = static_cast<double>(gap),
                        .default_rays = 1000});
    }
  return result;
}

}  // namespace

const StiffCase& stiff_coplanar_overlap() {
  static const StiffCase entry{
      .id = "coplanar_overlap",
      .number = 14,
      .title = "Overlapping tiles and decals",
      .construction = "overlapping coplanar tiles with decals 0 to 256 ulps above them, level or tilted",
      .property = "the exact nearest; of coincident ones the lowest number",
      .metric = "rate of wrong order against the gap in ulps",
      .settings = settings};
  return entry;
}

}  // namespace rayshoot
