// cts_square, STIFF 4: the unit square of the Vulkan conformance tests
//
// Construction  The recipe of the watertightness tests of the Vulkan CTS: a unit square whose triangles are
//               cut again and again at a random point (factors 0.01 to 0.99) of random depth, seen by
//               axis-parallel rays through the centres of 256 x 256 pixels; here every fourth ray goes
//               through a vertex. A cut is taken only where its three triangles have a positive area by exact
//               arithmetic: the original lets rounding fold some (VK- GL-CTS #446).
// Property      Every ray hits; which triangles own the point is decided exactly.
// Metric        Misses per 10^9 rays; rays that hit two triangles off their common edge.
// Size          Up to 1024 triangles, times 4 with every size, at most 65536.
// Anchor        Of 5,242,880 rays of this recipe Embree misses 3, Embree ROBUST none; the CTS demands none.

#include <fmt/format.h>

#include "scenes/stiff/parts/solids.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

constexpr double kLattice = 0x1p-20;

/// Twice the signed area of the projection along z; exact, since coordinates are multiples of 2^-20 up to 1.
double orientation(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Cut one triangle into three at a random point, if all of them keep an area.
void cut(TriangleMesh& mesh, std::size_t triangle, const RandomNumbers& random, std::uint64_t attempt) {
  const auto factor = [&](std::uint64_t dimension) {
    return 0.01 + 0.98 * random.uniform(attempt, dimension);
  };
  const auto [a, b, c] = mesh.triangles[triangle];
  const Vec3d &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
  const double across = factor(1), along = factor(2);
  Vec3d point = p + (q + (r - q) * along - p) * across;
  point.z = -factor(3);
  point = snapped(point, kLattice);
  if (!(orientation(p, q, point) > 0 && orientation(q, r, point) > 0 && orientation(r, p, point) > 0)) return;
  const auto added = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(point);
  mesh.triangles[triangle] = {a, b, added};
  mesh.triangles.push_back({b, c, added});
  mesh.triangles.push_back({c, a, added});
}

TriangleMesh square(std::size_t triangles, std::uint64_t seed) {
  const RandomNumbers random(seed);
  TriangleMesh mesh{{{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {1, 1, -1}}, {{0, 1, 2}, {1, 3, 2}}};
  for (std::uint64_t attempt = 0; mesh.triangles.size() < triangles; ++attempt)
    cut(mesh, random.bits(attempt, 0) % mesh.triangles.size(), random, attempt);
  return mesh;
}

Ray<double> axis_ray(const TriangleMesh& mesh, const RandomNumbers& random, std::uint64_t number) {
  Vec3d target;
  if (number % 4 == 3) {
    target = mesh.vertices[4 + random.bits(number, 0) % (mesh.vertices.size() - 4)];
  } else {
    const std::uint64_t pixel = random.bits(number, 0) % 65536;
    target = {(static_cast<double>(pixel % 256) + 0.5) / 256, (static_cast<double>(pixel / 256) + 0.5) / 256,
              0};
  }
  return {.origin = {target.x, target.y, 0}, .direction = {0, 0, -1}};
}

std::vector<StiffSetting> settings(int size, std::uint64_t seed) {
  std::vector<StiffSetting> result;
  const std::size_t most = std::size_t{1024} << std::min(2 * (size - 1), 6);
  for (std::size_t triangles = 4; triangles <= most; triangles *= 4) {
    const TriangleMesh mesh = square(triangles, seed);
    result.push_back({.label = fmt::format("triangles={}", triangles),
                      .scene = scene_of(mesh, fmt::format("cts_square(triangles={})", triangles)),
                      .rays = ray_by_ray([mesh](const RandomNumbers& random, std::uint64_t number) {
                        return axis_ray(mesh, random, number);
                      }),
                      .stiffness_parameter = static_cast<double>(triangles),
                      .default_rays = 1000});
  }
  return result;
}

}  // namespace

const StiffCase& stiff_cts_square() {
  static const StiffCase entry{
      .id = "cts_square",
      .number = 4,
      .title = "Square of the Vulkan conformance tests",
      .construction =
          "unit square cut at random into n triangles, orientation checked exactly; axis-parallel rays",
      .property = "exactly the exact owner, and never none",
      .metric = "misses per 10^9 rays, double hits",
      .settings = settings};
  return entry;
}

}  // namespace rayshoot
