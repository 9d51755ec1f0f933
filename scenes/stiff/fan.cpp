// fan, STIFF 3: many triangles around one vertex
//
// Construction  k triangles from a hub to a closed rim, like an umbrella; rays from above to the hub, even
//               ones exactly, odd ones rounded.
// Property      Every ray hits: whichever side of the hub it passes, there is a triangle.
// Metric        Leaks as a function of k.
// Size          k up to 512 in the short form, to 4096 from size 2.
// Anchor        The vertices of the icospheres of closed_vertex are fans of 5 and 6.

#include <fmt/format.h>

#include <numbers>

#include "scenes/stiff/parts/solids.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

constexpr Vec3d kHub{0.125, -0.0625, 0.25};

TriangleMesh umbrella(std::uint32_t k) {
  TriangleMesh mesh{{kHub}, {}};
  for (std::uint32_t i = 0; i < k; ++i) {
    const double angle = 2 * std::numbers::pi * i / k;
    mesh.vertices.push_back(snapped(Vec3d{0.99 * std::cos(angle), 0.99 * std::sin(angle), 0}, kStep));
    mesh.triangles.push_back({0, i + 1, (i + 1) % k + 1});
  }
  return mesh;
}

Ray<double> ray_to_hub(const RandomNumbers& random, std::uint64_t number) {
  const Vec3d offset = point_in_cube(random, number, 0) * 0.5;
  const Vec3d origin = Vec3d{0, 0, 1.25} + offset;
  return ray_to(number % 2 == 0 ? snapped(origin, kStep) : origin, kHub);
}

std::vector<StiffSetting> settings(int size, std::uint64_t) {
  std::vector<std::uint32_t> counts{3, 8, 64, 512};
  if (size > 1) counts = {3, 4, 5, 6, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096};
  std::vector<StiffSetting> result;
  for (const std::uint32_t k : counts)
    result.push_back({.label = fmt::format("k={}", k),
                      .scene = scene_of(umbrella(k), fmt::format("fan(k={})", k)),
                      .rays = ray_by_ray(ray_to_hub),
                      .property = Property::always_hit,
                      .stiffness_parameter = static_cast<double>(k),
                      .default_rays = 2000});
  return result;
}

}  // namespace

const StiffCase& stiff_fan() {
  static const StiffCase entry{
      .id = "fan",
      .number = 3,
      .title = "Rays to the hub of k triangles",
      .construction = "k triangles around one vertex, k = 3 to 4096; rays to that vertex",
      .property = "at least one hit, always",
      .metric = "leaks as a function of k",
      .settings = settings};
  return entry;
}

}  // namespace rayshoot
