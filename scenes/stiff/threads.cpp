// threads, STIFF 27: the same run by any number of threads
//
// Construction  Objects of every kind of moderate size, and three sets of rays: between points of space, to
//               vertices, and along axes. What varies is the harness's: the number of threads, the
//               instruction set of the build, fused multiplication and addition.
// Property      Graded by the oracle; beyond that the digest of all answers must not change.
// Metric        Differences of digests; where there are any, they must all be ambiguous.
// Size          40 size^2 objects of each kind, at most 4000.
// Anchor        Embree #423: one triangle is hit by its SSE2, SSE4.2 and AVX code and missed by AVX2.

#include "scenes/stiff/parts/scenes.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

constexpr double kLattice = 0x1p-20;

Ray<double> between_points(const RandomNumbers& random, std::uint64_t number) {
  return ray_to(point_in_cube(random, number, 0) * 1.5, point_in_cube(random, number, 3));
}

Ray<double> along_axis(const Scene& scene, const RandomNumbers& random, std::uint64_t number) {
  Ray<double> ray = lattice_ray(scene, random, number, kLattice, 1);
  const int axis = pick(random, number, 10, 0, 2);
  const Vec3d target = ray.at(1);
  ray.origin = target, ray.direction = {};
  ray.origin[axis] = number % 4 < 2 ? -2 : 2;
  ray.direction[axis] = number % 4 < 2 ? 1 : -1;
  return ray;
}

std::vector<StiffSetting> settings(int size, std::uint64_t seed) {
  const auto scene = share(mixed_scene(seed, kLattice, 40 * std::min(size, 10) * std::min(size, 10)),
                           "threads(scene=mixed)");
  std::vector<StiffSetting> result;
  const auto add = [&](const char* label, const RayMaker& ray) {
    result.push_back({.label = label,
                      .scene = scene,
                      .rays = ray_by_ray(ray),
                      .stiffness_parameter = static_cast<double>(result.size()),
                      .default_rays = 2000});
  };
  add("rays=between_points", between_points);
  add("rays=to_vertices", [scene](const RandomNumbers& random, std::uint64_t number) {
    return lattice_ray(*scene, random, 2 * number, kLattice, 1);
  });
  add("rays=along_axes", [scene](const RandomNumbers& random, std::uint64_t number) {
    return along_axis(*scene, random, number);
  });
  return result;
}

}  // namespace

const StiffCase& stiff_threads() {
  static const StiffCase entry{
      .id = "threads",
      .number = 27,
      .title = "The same run on any machine code and any threads",
      .construction = "a plain scene of objects of every kind; random rays, rays to vertices and along axes",
      .property = "equal answers for 1 to n threads and every instruction set",
      .metric = "differences of digests",
      .settings = settings};
  return entry;
}

}  // namespace rayshoot
