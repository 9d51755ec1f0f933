// in_plane, STIFF 15: rays inside of faces, walls and split planes
//
// Construction  Boxes of twelve triangles fill random cells of a grid of 4 x 4 x 4, so that their faces lie
//               on the walls of any grid or octree of a power of two, and on planes of median splits. Rays
//               run in the plane of faces, along edges, in the faces of the scene's box, and, as a base, off
//               all planes.
// Property      Graded by the oracle: a ray in the plane of a triangle misses it and hits what stands across.
// Metric        False hits and misses; the ratio of steps to the base, since a traversal on a wall may walk
//               both sides, or for ever.
// Size          4 x 4 x 4 cells times size each way, at most 16.
// Anchor        None: conformance tests leave rays in a triangle's plane open.

#include <fmt/format.h>

#include <array>

#include "scenes/stiff/parts/scenes.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

constexpr double kLattice = 0x1p-10;

enum class Course { off_planes, in_face, along_edge, in_box_face, along_box_edge };

std::shared_ptr<const Scene> city(int cells, std::uint64_t seed) {
  const RandomNumbers random(seed);
  SceneBuilder builder;
  // Two corners fix the box of the scene.
  add_box(builder, {0, 0, 0}, {1, 1, 1});
  add_box(builder, Vec3d{1, 1, 1} * (cells - 1.0), Vec3d{1, 1, 1} * (1.0 * cells));
  for (int i = 0; i < cells * cells * cells; ++i) {
    const Vec3d lo{1.0 * (i % cells), 1.0 * (i / cells % cells), 1.0 * (i / cells / cells)};
    if (random.uniform(static_cast<std::uint64_t>(i), 0) < 0.3) add_box(builder, lo, lo + Vec3d{1, 1, 1});
  }
  return share(std::move(builder), fmt::format("in_plane(cells={})", cells));
}

/// A ray with as many coordinates on planes as the course asks for, in directions that keep it there.
Ray<double> ray_on(Course course, int cells, const RandomNumbers& random, std::uint64_t number) {
  const double width = cells;
  Vec3d origin = snapped((point_in_cube(random, number, 0) + Vec3d{1, 1, 1}) * (width / 2), kLattice);
  origin += Vec3d{0x1p-12, 0x1p-12, 0x1p-12};  // off all planes of the lattice
  Vec3d direction = snapped(point_in_cube(random, number, 3), kLattice) + Vec3d{0x1p-12, 0x1p-12, 0x1p-12};
  const int first = pick(random, number, 6, 0, 2);
  const int planes = course == Course::off_planes                                 ? 0
                     : course == Course::in_face || course == Course::in_box_face ? 1
                                                                                  : 2;
  const bool outer = course == Course::in_box_face || course == Course::along_box_edge;
  for (int i = 0; i < planes; ++i) {
    const int axis = (first + i) % 3,
              plane = pick(random, number, 7 + static_cast<std::uint64_t>(i), 0, cells);
    origin[axis] = outer ? (plane % 2) * width : plane;
    direction[axis] = 0;
  }
  return {.origin = origin, .direction = direction};
}

std::vector<StiffSetting> settings(int size, std::uint64_t seed) {
  const int cells = 4 * std::min(size, 4);
  const auto scene = city(cells, seed);
  const std::array names = {"off_planes", "in_face", "along_edge", "in_box_face", "along_box_edge"};
  std::vector<StiffSetting> result;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto course = static_cast<Course>(i);
    result.push_back({.label = fmt::format("rays={}", names[i]),
                      .scene = scene,
                      .rays = ray_by_ray([=](const RandomNumbers& random, std::uint64_t number) {
                        return ray_on(course, cells, random, number);
                      }),
                      .base = 0,
                      .stiffness_parameter = static_cast<double>(i),
                      .default_rays = 1000});
  }
  return result;
}

}  // namespace

const StiffCase& stiff_in_plane() {
  static const StiffCase entry{.id = "in_plane",
                               .number = 15,
                               .title = "Rays in planes of faces, walls and boxes",
                               .construction =
                                   "boxes that fill cells of a grid; rays in the planes of their faces, "
                                   "along edges and along the scene's box",
                               .property = "coplanar objects are missed, their neighbours hit",
                               .metric = "false hits, endless loops; bound on steps",
                               .settings = settings};
  return entry;
}

}  // namespace rayshoot
