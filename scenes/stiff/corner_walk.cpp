// corner_walk, STIFF 16: through the corners and along the edges of cells
//
// Construction  The scene's box is a cube of 8 x 8 x 8 unit cells. Each triangle touches one cell corner with
//               its vertex and lies in one cell beside it. Rays pass exactly through corners: along diagonals
//               of cells, of their faces, along edges, and in steps of (1, 2, 1); as a base, beside the
//               corners. A 3D-DDA that takes two axes at once, or one too early, skips the cell that holds
//               the answer.
// Property      Graded by the oracle.
// Metric        Misses; ratio of steps to the base.
// Size          400 size^2 triangles, at most 40,000.
// Anchor        None published; walls of cells are met exactly only where the structure's box is not padded,
//               or is symmetric about the scene's.

#include <fmt/format.h>

#include <array>

#include "scenes/stiff/parts/scenes.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

constexpr int kCells = 8;
constexpr double kLattice = 0x1p-10;

/// A triangle at a corner of a cell, in one of the eight cells around.
void add_crumb(SceneBuilder& builder, const Vec3d& corner, const Vec3d& into) {
  const auto offset = [&](double x, double y, double z) {
    return corner + Vec3d{x * into.x, y * into.y, z * into.z} * 0.25;
  };
  builder.triangle(corner, offset(1, 0.5, 0.25), offset(0.25, 1, 0.75));
}

Vec3d random_corner(const RandomNumbers& random, std::uint64_t number) {
  const auto coordinate = [&](std::uint64_t axis) { return 1.0 * pick(random, number, axis, 1, kCells - 1); };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

Vec3d random_signs(const RandomNumbers& random, std::uint64_t number, std::uint64_t dimension) {
  const std::uint64_t bits = random.bits(number, dimension);
  return {bits & 1 ? 1.0 : -1.0, bits & 2 ? 1.0 : -1.0, bits & 4 ? 1.0 : -1.0};
}

std::shared_ptr<const Scene> crumbs(int size, std::uint64_t seed) {
  const RandomNumbers random(seed);
  SceneBuilder builder;
  add_crumb(builder, {0, 0, 0}, {1, 1, 1});
  add_crumb(builder, Vec3d{1, 1, 1} * kCells, {-1, -1, -1});
  const int count = 400 * std::min(size, 10) * std::min(size, 10);
  for (int i = 0; i < count; ++i) {
    const auto number = static_cast<std::uint64_t>(i);
    add_crumb(builder, random_corner(random, number), random_signs(random, number, 3));
  }
  return share(std::move(builder), fmt::format("corner_walk(triangles={})", count + 2));
}

Ray<double> ray_through_corner(const Vec3d& course, bool beside, const RandomNumbers& random,
                               std::uint64_t number) {
  const Vec3d signs = random_signs(random, number, 3);
  const int turn = pick(random, number, 4, 0, 2);
  Vec3d direction;
  for (int axis = 0; axis < 3; ++axis) direction[axis] = signs[axis] * course[(axis + turn) % 3];
  Vec3d through = random_corner(random, number);
  if (beside) through += snapped(point_in_cube(random, number, 5) * 0.5, kLattice);
  return {.origin = through - direction * (2 * kCells), .direction = direction};
}

std::vector<StiffSetting> settings(int size, std::uint64_t seed) {
  struct Rays {
    const char* label;
    Vec3d course;
    bool beside;
  };
  constexpr std::array kRays = {Rays{"rays=beside_corners", {1, 1, 1}, true},
                                Rays{"rays=cell_diagonal", {1, 1, 1}, false},
                                Rays{"rays=face_diagonal", {1, 1, 0}, false},
                                Rays{"rays=edge", {1, 0, 0}, false}, Rays{"rays=knight", {1, 2, 1}, false}};
  const auto scene = crumbs(size, seed);
  std::vector<StiffSetting> result;
  for (const auto& [label, course, beside] : kRays)
    result.push_back({.label = label,
                      .scene = scene,
                      .rays = ray_by_ray([course = course, beside = beside](const RandomNumbers& random,
                                                                            std::uint64_t number) {
                        return ray_through_corner(course, beside, random, number);
                      }),
                      .base = 0,
                      .stiffness_parameter = static_cast<double>(result.size()),
                      .default_rays = 1000});
  return result;
}

}  // namespace

const StiffCase& stiff_corner_walk() {
  static const StiffCase entry{.id = "corner_walk",
                               .number = 16,
                               .title = "Rays through corners of cells",
                               .construction =
                                   "small triangles touching the corners of a grid's cells; rays through "
                                   "corners and along edges of cells",
                               .property = "no cell is skipped: what touches the corner is found",
                               .metric = "cells skipped, misses; ratio of steps to rays beside the corners",
                               .settings = settings};
  return entry;
}

}  // namespace rayshoot
