// needle_field, STIFF 12: parallel needles across the scene
//
// Construction  n triangles as long as the scene and 2^-12 of that wide, parallel to an axis or to the
//               diagonal of the scene; in the base setting as many triangles are compact, of about the same
//               area.
// Property      Graded by the oracle.
// Metric        References per object, memory and work, as ratios to the base: along the diagonal every
//               cell's box holds parts of needles that boxes of objects cannot tell apart.
// Size          600 size^2 needles, at most 100,000.
// Anchor        None: the suites known count no references.

#include <fmt/format.h>

#include <array>

#include "scenes/stiff/parts/scenes.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

constexpr double kLattice = 0x1p-20, kWidth = 0x1p-12;

std::shared_ptr<const Scene> field(const Vec3d& path, const Vec3d& across, int count, std::uint64_t seed,
                                   const std::string& label) {
  const RandomNumbers random(seed);
  SceneBuilder builder;
  for (int i = 0; i < count; ++i) {
    // Room for the triangle in the cube of half width 1.
    Vec3d start = point_in_cube(random, static_cast<std::uint64_t>(i), 0);
    for (int axis = 0; axis < 3; ++axis) {
      const double reach = std::max(std::abs(path[axis]), std::abs(across[axis]));
      start[axis] =
          reach > 1.5 ? -1 + (start[axis] + 1) * (1 - reach / 2) : start[axis] * (1 - reach / 2) - reach / 2;
    }
    start = snapped(start, kLattice);
    builder.triangle(start, start + path, start + across);
  }
  return share(std::move(builder), "needle_field(" + label + ")");
}

std::vector<StiffSetting> settings(int size, std::uint64_t seed) {
  const int count = static_cast<int>(std::min(600ll * size * size, 100'000ll));
  const double side = std::sqrt(2 * kWidth);
  const auto crumb = [&](double x, double y, double z) { return snapped(Vec3d{x, y, z} * side, kLattice); };
  struct Field {
    const char* label;
    Vec3d path, across;
  };
  const std::array fields = {Field{"shape=compact", crumb(1, 0, 0), crumb(0, 0.6, 0.8)},
                             Field{"shape=axis", {1.875, 0, 0}, {0, kWidth / 2, kWidth / 2}},
                             Field{"shape=diagonal", {1.75, 1.75, 1.75}, {kWidth, 0, -kWidth}}};
  std::vector<StiffSetting> result;
  for (const auto& [label, path, across] : fields) {
    const auto scene = field(path, across, count, seed, label);
    result.push_back({.label = label,
                      .scene = scene,
                      .rays = ray_by_ray([scene](const RandomNumbers& random, std::uint64_t number) {
                        return lattice_ray(*scene, random, number, kLattice, 1);
                      }),
                      .base = 0,
                      .stiffness_parameter = length(path) / length(across),
                      .default_rays = 1000});
  }
  return result;
}

}  // namespace

const StiffCase& stiff_needle_field() {
  static const StiffCase entry{
      .id = "needle_field",
      .number = 12,
      .title = "Parallel needles across the scene",
      .construction =
          "n long thin parallel triangles that cross the whole scene, along an axis or the diagonal",
      .property = "right answers, without a blow-up of references",
      .metric = "references per object, memory, tests and steps",
      .settings = settings};
  return entry;
}

}  // namespace rayshoot
