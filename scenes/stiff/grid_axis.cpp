// grid_axis, STIFF 5: axis-parallel rays along an integer grid
//
// Construction  A mesh over the integer grid with heights 0 to 3. Rays along z through grid points, edges and
//               diagonals, and along x through grid lines at whole and half heights; the base setting sends
//               the same rays along z beside all lines.
// Property      The exact owner. Rays along x at whole heights run in the plane of level triangles, which
//               they miss.
// Metric        Misses, and the ratio of steps and tests to those of the base: where it is large, rays on a
//               line make a technique visit everything beside it.
// Size          24 x 24 cells at size 1, times size, at most 240.
// Anchor        tinybvh lost rays through a mesh quantised to the integer grid (#168); in madmann91's bvh
//               axis-parallel rays over a grid visited nearly all leaves (#60).

#include <fmt/format.h>

#include <array>

#include "scenes/stiff/parts/solids.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

enum class Line { jittered, vertex, edge, diagonal, along_x, level_x };

TriangleMesh terrain(int cells, std::uint64_t seed) {
  const RandomNumbers random(seed);
  TriangleMesh mesh;
  const auto number = [&](int x, int y) { return static_cast<std::uint32_t>(y * (cells + 1) + x); };
  for (int y = 0; y <= cells; ++y)
    for (int x = 0; x <= cells; ++x)
      mesh.vertices.push_back({1.0 * x, 1.0 * y, 1.0 * pick(random, number(x, y), 0, 0, 3)});
  for (int y = 0; y < cells; ++y)
    for (int x = 0; x < cells; ++x) {
      mesh.triangles.push_back({number(x, y), number(x + 1, y), number(x + 1, y + 1)});
      mesh.triangles.push_back({number(x, y), number(x + 1, y + 1), number(x, y + 1)});
    }
  return mesh;
}

Ray<double> line_ray(Line line, int cells, const RandomNumbers& random, std::uint64_t number) {
  const double x = pick(random, number, 0, 1, cells - 1), y = pick(random, number, 1, 1, cells - 1);
  // Odd numerators of 2^-10, never on a line.
  const double u = (2 * pick(random, number, 2, 0, 511) + 1) * 0x1p-10;
  const double v = (2 * pick(random, number, 3, 0, 511) + 1) * 0x1p-10;
  if (line == Line::along_x || line == Line::level_x) {
    const double height = pick(random, number, 4, 0, 2) + (line == Line::level_x ? 0 : 0.5);
    return {.origin = {-2, y, height}, .direction = {1, 0, 0}};
  }
  const double beside_x = line == Line::jittered || line == Line::diagonal ? u : 0;
  const double beside_y = line == Line::diagonal ? u : line == Line::vertex ? 0 : v;
  return {.origin = {x + beside_x, y + beside_y, 8}, .direction = {0, 0, -1}};
}

std::vector<StiffSetting> settings(int size, std::uint64_t seed) {
  const int cells = 24 * std::min(size, 10);
  const auto scene = scene_of(terrain(cells, seed), fmt::format("grid_axis(cells={})", cells));
  std::vector<StiffSetting> result;
  const std::array names = {"jittered", "vertex", "edge", "diagonal", "along_x", "level_x"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto line = static_cast<Line>(i);
    result.push_back({.label = fmt::format("rays={}", names[i]),
                      .scene = scene,
                      .rays = ray_by_ray([=](const RandomNumbers& random, std::uint64_t number) {
                        return line_ray(line, cells, random, number);
                      }),
                      .base = 0,
                      .stiffness_parameter = static_cast<double>(i),
                      .default_rays = 1000});
  }
  return result;
}

}  // namespace

const StiffCase& stiff_grid_axis() {
  static const StiffCase entry{
      .id = "grid_axis",
      .number = 5,
      .title = "Axis-parallel rays along an integer grid",
      .construction =
          "mesh over an integer grid with integer heights; axis-parallel rays through its points and lines",
      .property = "the exact owner, at no more work than beside the lines",
      .metric = "misses; ratio of steps and tests to jittered rays",
      .settings = settings};
  return entry;
}

}  // namespace rayshoot
