// huge, STIFF 20: coordinates up to the largest float
//
// Construction  Objects of every kind of about unit size, inside a closed box of twelve triangles of half
//               width 2^e; e = 126 is a quarter of the largest float and e = 88 that over 2^40. Rays start
//               among the objects or far out.
// Property      Graded by the oracle, for what has not been set aside as out of range.
// Metric        Not-a-numbers and refusals; the largest e with no wrong answer and no refusal.
// Size          Six exponents in the short form, steps of 6 from size 2.
// Anchor        Embree silently drops triangles with coordinates over 1.844e18 = 2^60.7.

#include <fmt/format.h>

#include "scenes/stiff/parts/scenes.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

constexpr double kLattice = 0x1p-20;

std::shared_ptr<const Scene> boxed(const Scene& objects, double half_width, const std::string& label) {
  SceneBuilder builder;
  add_box(builder, Vec3d{-1, -1, -1} * half_width, Vec3d{1, 1, 1} * half_width);
  Scene scene = std::move(builder).finish();
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  for (SceneObject object : objects.objects) {
    if (object.kind == ObjectKind::triangle)
      object.index += static_cast<std::uint32_t>(scene.triangles.size());
    scene.objects.push_back(object);
  }
  append(scene.triangles, objects.triangles), append(scene.polygons, objects.polygons);
  append(scene.polygon_vertices, objects.polygon_vertices);
  append(scene.spheres, objects.spheres), append(scene.cones, objects.cones);
  return share(std::move(scene), "huge(" + label + ")");
}

/// From among the objects, every third one from far out back to them.
Ray<double> ray_in_box(const Scene& objects, double half_width, const RandomNumbers& random,
                       std::uint64_t number) {
  const Ray<double> near = lattice_ray(objects, random, number, kLattice, 1);
  if (number % 3 != 0) return near;
  return ray_to(point_in_cube(random, number, 10) * (0.5 * half_width), near.at(1));
}

std::vector<StiffSetting> settings(int size, std::uint64_t seed) {
  std::vector<int> exponents{2, 40, 60, 62, 88, 126};
  if (size > 1) {
    exponents.clear();
    for (int e = 2; e <= 122; e += 6) exponents.push_back(e);
    exponents.push_back(126);
  }
  const Scene objects = mixed_scene(seed, kLattice);
  std::vector<StiffSetting> result;
  for (const int e : exponents) {
    const double half_width = std::ldexp(1, e);
    const std::string label = fmt::format("half_width=2^{}", e);
    result.push_back({.label = label,
                      .scene = boxed(objects, half_width, label),
                      .rays = ray_by_ray([=](const RandomNumbers& random, std::uint64_t number) {
                        return ray_in_box(objects, half_width, random, number);
                      }),
                      .base = 0,
                      .stiffness_parameter = half_width,
                      .default_rays = 1000});
  }
  return result;
}

}  // namespace

const StiffCase& stiff_huge() {
  static const StiffCase entry{
      .id = "huge",
      .number = 20,
      .title = "Coordinates up to a quarter of the largest float",
      .construction = "a scene of unit size inside a box of half width 2^e, e up to 126",
      .property = "refused, or answered rightly; no bounds that are infinite or no number",
      .metric = "not-a-numbers, refusals; the largest safe coordinate",
      .settings = settings};
  return entry;
}

}  // namespace rayshoot
