// teapot_stadium, STIFF 10: the teapot in the stadium, ever smaller
//
// Construction  The triangles of Newell's teapot, scaled to s times the stadium's length, stand at the origin
//               in a bowl of unit length. Near the origin floats hold the teapot at every scale. Half of the
//               rays run from the stands to vertices of the teapot, half anywhere between the stands. Only
//               here does the stiffness, the scene's diagonal over its smallest feature, grow by what lies in
//               the scene and not by where it is.
// Property      Graded by the oracle.
// Metric        Work, structure and time against stiffness, as ratios to the base s = 1: a technique's
//               break-down is the stiffness at which the cost has doubled.
// Size          Scales in steps of 100 in the short form, of 10 from size 2; the teapot of size 2 + size.
// Anchor        None: suites of other libraries hold no such scene.

#include <fmt/format.h>

#include <numbers>

#include "scenes/core/registry.h"
#include "scenes/core/stiffness.h"
#include "scenes/stiff/parts/scenes.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

constexpr double kLength = 1;

/// The teapot's triangles about the origin, their box of diagonal 1.
TriangleMesh teapot(int size) {
  SceneBuilder builder({.size = size, .form = SceneForm::patches});
  for (const SceneGenerator* generator : scene_generators())
    if (generator->id == "teapot")
      generator->generate({.size = size, .form = SceneForm::patches}, {}, builder);
  const Scene scene = std::move(builder).finish();
  Box<double> box;
  for (const auto& [a, b, c] : scene.triangles) box.include(a), box.include(b), box.include(c);
  const auto place = [&](const Vec3d& p) { return (p - box.centre()) * (1 / length(box.extent())); };
  TriangleMesh mesh;
  for (const auto& [a, b, c] : scene.triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3d& vertex : {a, b, c}) mesh.vertices.push_back(place(vertex));
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// A point of the bowl, `u` around it and `v` from the rim of the field, at 0, to the top.
Vec3d stands(double u, double v) {
  const double angle = 2 * std::numbers::pi * u, radius = 0.25 * kLength * (1 + v);
  return rounded(Vec3d{radius * std::cos(angle), 0.7 * radius * std::sin(angle), 0.2 * kLength * (v - 0.5)});
}

void add_stadium(SceneBuilder& builder) {
  constexpr int kSectors = 24, kTiers = 3;
  for (int tier = 0; tier < kTiers; ++tier)
    for (int sector = 0; sector < kSectors; ++sector) {
      const auto corner = [&](int i, int j) {
        return stands((sector + i) % kSectors * (1.0 / kSectors), (tier + j) * (1.0 / kTiers));
      };
      builder.triangle(corner(0, 0), corner(1, 0), corner(1, 1));
      builder.triangle(corner(0, 0), corner(1, 1), corner(0, 1));
    }
}

std::shared_ptr<const Scene> stadium(const TriangleMesh& cup, double scale, const std::string& label) {
  SceneBuilder builder;
  add_stadium(builder);
  TriangleMesh small = cup;
  for (Vec3d& vertex : small.vertices) vertex = rounded(vertex * (scale * kLength));
  add_mesh(builder, small);
  return share(std::move(builder), "teapot_stadium(" + label + ")");
}

Ray<double> ray_from_stands(const TriangleMesh& cup, double scale, const RandomNumbers& random,
                            std::uint64_t number) {
  const auto seat = [&](std::uint64_t dimension) {
    return stands(random.uniform(number, dimension), random.uniform(number, dimension + 1)) * 0.95;
  };
  if (number % 2 == 1) return ray_to(seat(0), seat(2));
  return ray_to(seat(0), cup.vertices[random.bits(number, 2) % cup.vertices.size()] * (scale * kLength));
}

std::vector<StiffSetting> settings(int size, std::uint64_t) {
  const TriangleMesh cup = teapot(2 + std::min(size, 14));
  std::vector<StiffSetting> result;
  for (int k = 0; k <= 9; k += size > 1 ? 1 : 3) {
    const double scale = std::pow(10, -k);
    const std::string label = k == 0 ? "scale=1" : fmt::format("scale=1e-{}", k);
    const auto scene = stadium(cup, scale, label);
    result.push_back({.label = label,
                      .scene = scene,
                      .rays = ray_by_ray([cup, scale](const RandomNumbers& random, std::uint64_t number) {
                        return ray_from_stands(cup, scale, random, number);
                      }),
                      .base = 0,
                      .stiffness_parameter = stiffness(*scene).value(),
                      .default_rays = 1000});
  }
  return result;
}

}  // namespace

const StiffCase& stiff_teapot_stadium() {
  static const StiffCase entry{
      .id = "teapot_stadium",
      .number = 10,
      .title = "Teapot in a stadium, ever smaller",
      .construction = "a teapot scaled by s = 1 to 1e-9 in the middle of a stadium of unit length",
      .property = "right answers, at a cost that grows no faster than the stiffness",
      .metric = "tests, steps, build time and memory against stiffness; where a technique breaks down",
      .settings = settings};
  return entry;
}

}  // namespace rayshoot
