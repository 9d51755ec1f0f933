// ray_class_border, STIFF 26: directions on borders of ray classes
//
// Construction  Techniques that classify rays (5D classification, light buffers, beams) cut the cube of
//               directions into cells. Directions here lie in planes between its faces (|x| = |y|), on lines
//               u = m / 16 within a face, in its corners and along axes; the base has directions beside them.
//               Rays run through vertices, from lattice points two directions before.
// Property      Graded by the oracle: what a ray hits must be among the candidates of its class, whichever of
//               two classes takes a ray on the border.
// Metric        Candidate sets without the hit, which must be none: the safety half of the efficiency M.
// Size          40 size^2 objects of each kind, at most 4000.
// Anchor        None.

#include <fmt/format.h>

#include <array>

#include "scenes/stiff/parts/scenes.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

constexpr double kLattice = 0x1p-10;

enum class Border { none, face, cell, corner, axis };

/// A direction on the cube of directions: its largest component is 1.
Vec3d direction_on(Border border, const RandomNumbers& random, std::uint64_t number) {
  const auto share = [&](std::uint64_t dimension, int parts) {
    return static_cast<double>(pick(random, number, dimension, -parts + 1, parts - 1)) / parts;
  };
  // Odd numerators of 1/512 are on no border.
  const double beside_u = share(0, 256) + 0x1p-9, beside_v = share(1, 256) + 0x1p-9;
  Vec3d d{1, beside_u, beside_v};
  if (border == Border::face) d.y = 1;
  if (border == Border::cell) d.y = share(0, 16);
  if (border == Border::corner) d = {1, 1, 1};
  if (border == Border::axis) d = {1, 0, 0};
  const int turn = pick(random, number, 2, 0, 2);
  const std::uint64_t signs = random.bits(number, 3);
  Vec3d result;
  for (int axis = 0; axis < 3; ++axis) result[axis] = d[(axis + turn) % 3] * (signs >> axis & 1 ? 1 : -1);
  return result;
}

Ray<double> border_ray(const Scene& scene, Border border, const RandomNumbers& random, std::uint64_t number) {
  const Vec3d direction = direction_on(border, random, number);
  const auto& [a, b, c] = scene.triangles[random.bits(number, 4) % scene.triangles.size()];
  const Vec3d middle = snapped((a + b + c) * (1.0 / 3), kLattice);
  return {.origin = (number % 2 == 0 ? a : middle) - direction * 2, .direction = direction};
}

std::vector<StiffSetting> settings(int size, std::uint64_t seed) {
  const auto scene = share(mixed_scene(seed, kLattice, 40 * std::min(size, 10) * std::min(size, 10)),
                           "ray_class_border(scene=mixed)");
  const std::array names = {"none", "face", "cell", "corner", "axis"};
  std::vector<StiffSetting> result;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto border = static_cast<Border>(i);
    result.push_back({.label = fmt::format("border={}", names[i]),
                      .scene = scene,
                      .rays = ray_by_ray([=](const RandomNumbers& random, std::uint64_t number) {
                        return border_ray(*scene, border, random, number);
                      }),
                      .base = 0,
                      .stiffness_parameter = static_cast<double>(i),
                      .default_rays = 1000});
  }
  return result;
}

}  // namespace

const StiffCase& stiff_ray_class_border() {
  static const StiffCase entry{
      .id = "ray_class_border",
      .number = 26,
      .title = "Directions on borders of ray classes",
      .construction =
          "directions on borders of cells on the direction cube, origins and targets on a lattice",
      .property = "the candidates hold what is hit",
      .metric = "candidate sets without the hit, which must be none",
      .settings = settings};
  return entry;
}

}  // namespace rayshoot
