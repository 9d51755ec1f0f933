#include "scenes/stiff/parts/scenes.h"

namespace rayshoot::stiff {

std::shared_ptr<const Scene> share(Scene scene, const std::string& id) {
  scene.id = id;
  return std::make_shared<const Scene>(std::move(scene));
}

std::shared_ptr<const Scene> share(SceneBuilder&& builder, const std::string& id) {
  return share(std::move(builder).finish(), id);
}

void add_mesh(SceneBuilder& builder, const TriangleMesh& mesh) {
  for (const auto& [a, b, c] : mesh.triangles)
    builder.triangle(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
}

void add_box(SceneBuilder& builder, const Vec3d& lo, const Vec3d& hi) {
  TriangleMesh box;
  for (int corner = 0; corner < 8; ++corner)
    box.vertices.push_back({corner & 1 ? hi.x : lo.x, corner & 2 ? hi.y : lo.y, corner & 4 ? hi.z : lo.z});
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  add_mesh(builder, box);
}

namespace {

/// Scatters multiples of `step` for one object after another.
class Scatter {
 public:
  Scatter(const RandomNumbers& random, double extent, double step)
      : random_(random), extent_(extent), step_(step) {}

  void next_object() { ++number_, dimension_ = 0; }
  Vec3d place() { return lattice_point(1 - 2 * extent_); }
  Vec3d offset() { return lattice_point(extent_); }
  /// A length of at least two steps.
  double length() {
    const double share = 0.1 + 0.9 * random_.uniform(number_, dimension_++);
    return std::max(2 * step_, std::nearbyint(0.5 * extent_ * share / step_) * step_);
  }

 private:
  Vec3d lattice_point(double half_width) {
    const Vec3d p = point_in_cube(random_, number_, dimension_) * half_width;
    dimension_ += 3;
    return snapped(p, step_);
  }

  const RandomNumbers& random_;
  double extent_, step_;
  std::uint64_t number_ = 0, dimension_ = 0;
};

}  // namespace

void add_scattered(SceneBuilder& builder, const Counts& counts, const RandomNumbers& random, double extent,
                   double step) {
  Scatter scatter(random, extent, step);
  for (int i = 0; i < counts.triangles; ++i, scatter.next_object()) {
    const Vec3d a = scatter.place(), to_b = scatter.offset(), to_c = scatter.offset();
    builder.triangle(a, a + to_b, a + to_c);
  }
  for (int i = 0; i < counts.parallelograms; ++i, scatter.next_object()) {
    const Vec3d a = scatter.place(), u = scatter.offset() * 0.5, v = scatter.offset() * 0.5;
    const Vec3d p = snapped(u, step), q = snapped(v, step);
    builder.polygon(std::array{a, a + p, a + p + q, a + q});
  }
  for (int i = 0; i < counts.spheres; ++i, scatter.next_object()) {
    const Vec3d centre = scatter.place();
    builder.sphere(centre, scatter.length());
  }
  for (int i = 0; i < counts.cones; ++i, scatter.next_object()) {
    const Vec3d base = scatter.place(), apex = base + scatter.offset();
    const double base_radius = scatter.length(),
                 apex_radius = i % 3 == 0 ? base_radius : scatter.length() * (i % 3 - 1);
    builder.cone(base, base_radius, apex, apex_radius);
  }
}

Scene mixed_scene(std::uint64_t seed, double step, int objects_of_a_kind) {
  SceneBuilder builder;
  const int n = objects_of_a_kind;
  add_scattered(builder, {2 * n, n, n, n}, RandomNumbers(seed), 0.25, step);
  return std::move(builder).finish();
}

Scene placed(const Scene& scene, double scale, const Vec3d& offset) {
  Scene result = scene;
  const auto place = [&](Vec3d& p) { p = rounded(p * scale + offset); };
  const auto enlarge = [&](double& radius) { radius = static_cast<float>(radius * scale); };
  for (auto& [a, b, c] : result.triangles) place(a), place(b), place(c);
  for (Vec3d& vertex : result.polygon_vertices) place(vertex);
  for (auto& [centre, radius] : result.spheres) place(centre), enlarge(radius);
  for (Cone<double>& cone : result.cones) {
    place(cone.base), place(cone.apex);
    enlarge(cone.base_radius), enlarge(cone.apex_radius);
  }
  return result;
}

Ray<double> lattice_ray(const Scene& scene, const RandomNumbers& random, std::uint64_t number, double step,
                        double half_width) {
  const Vec3d origin = snapped(point_in_cube(random, number, 0) * (2 * half_width), step);
  if (number % 2 == 1) return ray_to(origin, snapped(point_in_cube(random, number, 3) * half_width, step));
  const auto& [a, b, c] = scene.triangles[random.bits(number, 3) % scene.triangles.size()];
  const int corner = pick(random, number, 4, 0, 2);
  return ray_to(origin, corner == 0 ? a : corner == 1 ? b : c);
}

}  // namespace rayshoot::stiff
