// csg_stack, STIFF 25: nested solids with coincident walls
//
// Construction  n boxes, each inside the next, with one wall in common; or n spheres, each inside the next,
//               that touch in one point. Rays start in the innermost, every other one towards the common wall
//               or point; or outside of all.
// Property      From inside every ray hits, and crosses each solid's surface once: n crossings, of which
//               those at the common wall coincide. An interval algebra of constructive solid geometry rests on
//               every one of them.
// Metric        Leaks; crossings that the strict optimizer's candidates lack.
// Size          n up to 16 in the short form, times 4 with every size, at most 1024.
// Anchor        None with an exact count.

#include <fmt/format.h>

#include "scenes/stiff/parts/scenes.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

constexpr double kLattice = 0x1p-10;

std::shared_ptr<const Scene> nested(bool boxes, int solids, const std::string& label) {
  SceneBuilder builder;
  for (int i = 1; i <= solids; ++i) {
    const double size = i;
    if (boxes)
      add_box(builder, {-size, -size, -size}, {1, size, size});
    else
      builder.sphere({1 - size, 0, 0}, size);
  }
  return share(std::move(builder), "csg_stack(" + label + ")");
}

Ray<double> ray_from_inside(const RandomNumbers& random, std::uint64_t number) {
  const Vec3d origin = snapped(point_in_cube(random, number, 0) * 0.5, kLattice);
  const Vec3d aim = snapped(point_in_cube(random, number, 3) * 0.25, kLattice);
  return ray_to(origin, number % 2 == 0 ? Vec3d{1, aim.y, aim.z} : origin + aim + Vec3d{0, 0, kLattice});
}

Ray<double> ray_from_outside(double size, const RandomNumbers& random, std::uint64_t number) {
  Vec3d origin = snapped(point_in_cube(random, number, 0) * size, kLattice);
  origin.x = 2;
  return ray_to(origin, snapped(point_in_cube(random, number, 3) * size, kLattice));
}

std::vector<StiffSetting> settings(int size, std::uint64_t) {
  std::vector<StiffSetting> result;
  const int most = 16 << std::min(2 * (size - 1), 6);
  for (const bool boxes : {true, false})
    for (int solids = 1; solids <= most; solids *= 4)
      for (const bool inside : {true, false}) {
        const std::string solid = fmt::format("solid={},n={}", boxes ? "box" : "sphere", solids);
        const RayMaker outer = [solids](const RandomNumbers& random, std::uint64_t number) {
          return ray_from_outside(solids, random, number);
        };
        result.push_back({.label = solid + (inside ? ",from=inside" : ",from=outside"),
                          .scene = nested(boxes, solids, solid),
                          .rays = ray_by_ray(inside ? ray_from_inside : outer),
                          .property = inside ? Property::always_hit : Property::as_oracle,
                          .stiffness_parameter = static_cast<double>(solids),
                          .default_rays = 500});
      }
  return result;
}

}  // namespace

const StiffCase& stiff_csg_stack() {
  static const StiffCase entry{
      .id = "csg_stack",
      .number = 25,
      .title = "Nested solids with coincident walls",
      .construction = "n nested boxes that share a wall, or spheres that touch in a point",
      .property = "as the oracle; from inside at least one hit, always; no crossing is lost",
      .metric = "leaks; crossings lost",
      .settings = settings};
  return entry;
}

}  // namespace rayshoot
