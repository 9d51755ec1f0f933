#include "scenes/stiff/parts/solids.h"

#include <fmt/format.h>

#include <map>
#include <numbers>
#include <set>

#include "scenes/io/subdivide.h"
#include "scenes/stiff/parts/scenes.h"

namespace rayshoot::stiff {

namespace {

/// Just under 1, so that no coordinate reaches it.
constexpr double kRadius = 0.9990234375;

TriangleMesh icosahedron() {
  constexpr double g = std::numbers::phi;
  return {{{-1, g, 0},
           {1, g, 0},
           {-1, -g, 0},
           {1, -g, 0},
           {0, -1, g},
           {0, 1, g},
           {0, -1, -g},
           {0, 1, -g},
           {g, 0, -1},
           {g, 0, 1},
           {-g, 0, -1},
           {-g, 0, 1}},
          {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
           {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
           {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
}

/// Every triangle as four, with the midpoints of its edges as new vertices.
TriangleMesh divided(const TriangleMesh& mesh) {
  TriangleMesh result{mesh.vertices, {}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> midpoints;
  const auto midpoint = [&](std::uint32_t a, std::uint32_t b) {
    const auto [entry, is_new] = midpoints.try_emplace(std::minmax(a, b), result.vertices.size());
    if (is_new) result.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]) * 0.5);
    return entry->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
    for (const auto& triangle : {std::array{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}})
      result.triangles.push_back(triangle);
  }
  return result;
}

void blow_up(TriangleMesh& mesh) {
  for (Vec3d& vertex : mesh.vertices) vertex = normalized(vertex) * kRadius;
}

void snap(TriangleMesh& mesh) {
  for (Vec3d& vertex : mesh.vertices) vertex = snapped(vertex, kStep);
}

/// The least distance of the origin from a plane of the mesh, negative where the origin is on its outer side: all
/// points nearer than that see every triangle from inside.
double kernel_radius(const TriangleMesh& mesh) {
  double radius = 1;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3d &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
    radius = std::min(radius, dot(normalized(cross(q - p, r - p)), p));
  }
  return radius;
}

Solid star_shaped(std::string name, TriangleMesh mesh) {
  snap(mesh);
  const double room = kernel_radius(mesh) / 2;
  return {std::move(name), std::move(mesh), {{{}, room}}};
}

/// Each vertex farther or nearer by up to `share` of its distance.
void dent(TriangleMesh& mesh, const RandomNumbers& random, std::uint64_t step, double share) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    mesh.vertices[i] *= 1 + share * (2 * random.uniform(i, step) - 1);
}

/// The dents of one try, the largest vertex at `kRadius`.
TriangleMesh dented(SubdivisionRule rule, int steps, const RandomNumbers& random, double share) {
  TriangleMesh mesh = icosahedron();
  for (int step = 0; step < steps; ++step) {
    dent(mesh, random, static_cast<std::uint64_t>(step), share);
    mesh = subdivided(mesh, rule);
  }
  double largest = 0;
  for (const Vec3d& vertex : mesh.vertices) largest = std::max(largest, length(vertex));
  for (Vec3d& vertex : mesh.vertices) vertex *= kRadius / largest;
  return mesh;
}

}  // namespace

Solid icosphere(int level) {
  TriangleMesh mesh = icosahedron();
  blow_up(mesh);
  for (int i = 0; i < level; ++i) {
    mesh = divided(mesh);
    blow_up(mesh);
  }
  return star_shaped(fmt::format("solid=icosphere,level={}", level), std::move(mesh));
}

Solid tetrahedron() {
  TriangleMesh mesh{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
                    {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
  blow_up(mesh);
  return star_shaped("solid=tetrahedron", std::move(mesh));
}

Solid ring(int around, int along) {
  constexpr double kCore = 0.7, kTube = 0.25;
  Solid solid{fmt::format("solid=ring,around={}", around), {}, {}};
  const auto turn = [](int i, int n) { return 2 * std::numbers::pi * i / n; };
  const auto number = [&](int i, int j) {
    return static_cast<std::uint32_t>(i % around * along + j % along);
  };
  for (int i = 0; i < around; ++i) {
    const double u = turn(i, around);
    solid.inside.push_back({{kCore * std::cos(u), kCore * std::sin(u), 0}, kTube / 2});
    for (int j = 0; j < along; ++j) {
      const double v = turn(j, along), radius = kCore + kTube * std::cos(v);
      solid.mesh.vertices.push_back({radius * std::cos(u), radius * std::sin(u), kTube * std::sin(v)});
      solid.mesh.triangles.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
      solid.mesh.triangles.push_back({number(i, j), number(i + 1, j + 1), number(i, j + 1)});
    }
  }
  snap(solid.mesh);
  return solid;
}

Solid random_solid(SubdivisionRule rule, int steps, std::uint64_t seed) {
  const RandomNumbers random(seed);
  // Halve the dents until the centre sees all of the surface.
  double share = 0.4;
  TriangleMesh mesh = dented(rule, steps, random, share);
  while (kernel_radius(mesh) < 0.1) mesh = dented(rule, steps, random, share /= 2);
  const char* name = rule == SubdivisionRule::loop ? "loop" : "sqrt3";
  return star_shaped(fmt::format("solid=random_{},steps={}", name, steps), std::move(mesh));
}

std::shared_ptr<const Scene> scene_of(const TriangleMesh& mesh, const std::string& id) {
  SceneBuilder builder;
  add_mesh(builder, mesh);
  return share(std::move(builder), id);
}

std::vector<std::array<std::uint32_t, 2>> edges_of(const TriangleMesh& mesh) {
  std::set<std::array<std::uint32_t, 2>> edges;
  for (const auto& [a, b, c] : mesh.triangles)
    for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}})
      edges.insert({std::min(from, to), std::max(from, to)});
  return {edges.begin(), edges.end()};
}

Vec3d point_inside(const Solid& solid, const RandomNumbers& random, std::uint64_t number, bool on_lattice) {
  constexpr std::uint64_t kDimension = 1000;
  const Ball& ball = solid.inside[random.bits(number, kDimension) % solid.inside.size()];
  // The cube inscribed in the ball has half its width.
  const Vec3d offset = point_in_cube(random, number, kDimension + 1) * (0.57 * ball.radius);
  const Vec3d point = ball.centre + offset;
  return on_lattice ? snapped(point, kStep / 2) : rounded(point);
}

std::vector<Solid> solids(int size, std::uint64_t seed) {
  std::vector<Solid> result;
  for (int level = 2; level <= std::min(2 + size, 8); ++level) result.push_back(icosphere(level));
  result.push_back(tetrahedron());
  result.push_back(ring(16 * std::min(size, 16), 8 * std::min(size, 16)));
  result.push_back(random_solid(SubdivisionRule::loop, std::min(2 + size, 6), seed));
  result.push_back(random_solid(SubdivisionRule::sqrt3, std::min(3 + size, 8), seed));
  return result;
}

std::vector<StiffSetting> settings_inside_solids(const std::string& id, int size, std::uint64_t seed,
                                                 const std::function<RayMaker(const Solid&)>& rays_in) {
  std::vector<StiffSetting> settings;
  for (Solid& made : solids(size, seed)) {
    const auto solid = std::make_shared<const Solid>(std::move(made));
    const auto scene = scene_of(solid->mesh, id + "(" + solid->name + ")");
    settings.push_back({.label = solid->name,
                        .scene = scene,
                        .rays = ray_by_ray([solid, ray = rays_in(*solid)](const RandomNumbers& random,
                                                                          std::uint64_t number) {
                          return ray(random, number);
                        }),
                        .property = Property::always_hit,
                        .stiffness_parameter = static_cast<double>(scene->size()),
                        .default_rays = 2000});
  }
  return settings;
}

}  // namespace rayshoot::stiff
