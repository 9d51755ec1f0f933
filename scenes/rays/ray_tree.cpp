#include "scenes/rays/ray_tree.h"

#include "scenes/rays/optics.h"

namespace rayshoot {

void RayBatch::add(const Ray<double>& ray, const RayOrigin& origin, std::uint32_t parent) {
  rays.push_back(ray);
  origins.push_back(origin);
  parents.push_back(parent);
}

namespace {

/// The normal on the side that a direction comes from.
Vec3d facing(const Vec3d& normal, const Vec3d& direction) {
  return dot(normal, direction) > 0 ? -normal : normal;
}

}  // namespace

std::vector<Encounter> encounters_of(const Scene& scene, const Tracer& tracer, const RayTreeRules& rules,
                                     std::span<const Ray<double>> rays) {
  std::vector<Hit<double>> hits(rays.size());
  tracer.closest(rays, hits);
  std::vector<Encounter> encounters(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].object == kNoObject) continue;
    Encounter& met = encounters[i];
    met.object = hits[i].object;
    met.time = rays[i].time;
    met.point = rays[i].at(hits[i].t);
    met.outward = outward_normal(rules, scene, met.object, met.point, met.time);
    met.normal = rules.normals_face_the_ray ? facing(met.outward, rays[i].direction) : met.outward;
    met.flat = facing(surface_normal(scene, met.object, met.point, false, met.time), rays[i].direction);
  }
  return encounters;
}

namespace {

/// Casts what hits ask for.
class Caster {
 public:
  Caster(const Scene& scene, const RayTreeRules& rules)
      : scene_(scene),
        rules_(rules),
        diagonal_(scene.objects.empty() ? 0 : length(scene.bounds().extent())) {}

  /// One shadow ray to each light in front of the surface.
  void cast_shadow_rays(Wave& wave, std::uint32_t parent) const {
    const Encounter& met = wave.encounters[parent];
    for (std::size_t light = 0; light < scene_.lights.size(); ++light) {
      const Vec3d to_light = scene_.lights[light].position - met.point;
      if (!(dot(met.normal, to_light) > 0)) continue;
      const double distance = length(to_light);
      Ray<double> ray = ray_from(met, to_light * (1 / distance));
      ray.t_max = distance;
      wave.shadow_rays.add(ray, origin(wave, parent, RayKind::shadow, ray, static_cast<std::int32_t>(light)),
                           parent);
    }
  }

  /// The reflected and the refracted ray, as the material asks for them.
  void cast_secondary_rays(Wave& wave, std::uint32_t parent, RayBatch& next) const {
    const Encounter& met = wave.encounters[parent];
    const Material& material = scene_.material_of(met.object);
    const Vec3d& incoming = wave.rays.rays[parent].direction;
    const auto cast = [&](RayKind kind, const Vec3d& direction) {
      const Ray<double> ray = ray_from(met, direction);
      next.add(ray, origin(wave, parent, kind, ray), parent);
    };
    if (material.reflects()) cast(RayKind::reflected, reflected(incoming, met.outward));
    if (!material.refracts()) return;
    if (const auto onward = refracted(incoming, met.outward, material.index_of_refraction))
      cast(RayKind::refracted, *onward);
    else
      ++wave.total_internal_reflections;
  }

 private:
  Ray<double> ray_from(const Encounter& met, const Vec3d& direction) const {
    return {.origin = met.point,
            .t_min = first_distance(rules_, diagonal_, met.point),
            .direction = direction,
            .time = met.time};
  }

  static RayOrigin origin(const Wave& wave, std::uint32_t parent, RayKind kind, const Ray<double>& ray,
                          std::int32_t light = -1) {
    const Encounter& met = wave.encounters[parent];
    const int generation = wave.generation + (kind == RayKind::shadow ? 0 : 1);
    const auto cosine = static_cast<float>(std::abs(dot(met.flat, ray.direction)));
    return {kind, static_cast<std::uint8_t>(generation), light, met.object, cosine};
  }

  const Scene& scene_;
  const RayTreeRules& rules_;
  double diagonal_;
};

}  // namespace

void grow_ray_trees(const Scene& scene, const Tracer& tracer, const RayTreeRules& rules,
                    std::vector<Ray<double>> eye_rays, const std::function<void(const Wave&)>& visit) {
  const Caster caster(scene, rules);
  RayBatch rays;
  rays.rays = std::move(eye_rays);
  rays.origins.assign(rays.rays.size(), {.kind = RayKind::primary});
  rays.parents.assign(rays.rays.size(), 0);
  for (int generation = 1; generation <= kRayTreeDepth && !rays.rays.empty(); ++generation) {
    Wave wave{.generation = generation, .rays = std::move(rays)};
    wave.encounters = encounters_of(scene, tracer, rules, wave.rays.rays);

    RayBatch next;
    for (std::uint32_t ray = 0; ray < wave.encounters.size(); ++ray) {
      if (wave.encounters[ray].object == kNoObject) continue;
      caster.cast_shadow_rays(wave, ray);
      if (generation < kRayTreeDepth) caster.cast_secondary_rays(wave, ray, next);
    }

    wave.blocked.resize(wave.shadow_rays.rays.size());
    tracer.any(wave.shadow_rays.rays, wave.blocked);
    visit(wave);
    rays = std::move(next);
  }
}

}  // namespace rayshoot
