// points: lines of sight between random points of the scene
//
// Purpose    Rays that start anywhere in space, as those of scattering media and of point queries do, rather
//            than outside of all or on a surface.
// Rules      Origin and target are uniform in the box of the scene; the ray leads from one towards the other
//            and on without end.
// Parameters rays: 100,000, for a standard error of an average per ray of well under one per cent.

#include "scenes/rays/distribution.h"
#include "scenes/rays/random.h"
#include "scenes/rays/times.h"

namespace rayshoot {

namespace {

Ray<double> ray_between_points(const Box<double>& box, const RandomNumbers& random, std::uint64_t ray) {
  const auto point = [&](std::uint64_t dimension) {
    const Vec3d u{random.uniform(ray, dimension), random.uniform(ray, dimension + 1),
                  random.uniform(ray, dimension + 2)};
    const Vec3d extent = box.extent();
    return box.lo + Vec3d{u.x * extent.x, u.y * extent.y, u.z * extent.z};
  };
  const Vec3d origin = point(0), path = point(3) - origin;
  return {.origin = origin, .direction = path == Vec3d{} ? Vec3d{0, 0, 1} : normalized(path)};
}

RaySet generate(const RayRequest& request) {
  const Box<double> bounds = request.scene.bounds();
  const Box<double> box = bounds.empty() ? Box<double>{{0, 0, 0}, {1, 1, 1}} : bounds;
  const RandomNumbers random(request.seed);
  RaySet set;
  set.closest_rays = static_cast<std::size_t>(request.arguments.integer("rays"));
  set.rays.reserve(set.closest_rays);
  for (std::size_t ray = 0; ray < set.closest_rays; ++ray)
    set.rays.push_back(ray_between_points(box, random, ray));
  set_times(set.rays, request.scene, request.seed);
  set.origins.assign(set.rays.size(), {.kind = RayKind::point_pair});
  return set;
}

}  // namespace

const RayDistribution& rays_points() {
  static const RayDistribution distribution{
      .id = "points",
      .title = "From a random point of the scene's box towards another",
      .source = "common in tests of ray queries",
      .parameters = {integer_parameter("rays", 100'000, 1, 1e9, "number of rays")},
      .needs_lights = false,
      .cone_sides = [](const Arguments&) { return ConeSides::both; },
      .generate = generate};
  return distribution;
}

}  // namespace rayshoot
