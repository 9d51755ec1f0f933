#include "harness/render/shading.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "harness/render/eye_rays.h"
#include "scenes/rays/optics.h"
#include "scenes/rays/ray_tree.h"
#include "scenes/rays/times.h"

namespace rayshoot {

namespace {

/// Rows that a thread shades at a time, which bounds the memory for their ray trees.
constexpr int kRowsPerBand = 8;

/// Light that reaches every surface; NFF has none, and what is in shadow would be black.
constexpr double kAmbient = 0.06;

/// The amounts of light for which a colour of the screen stands, and the other way round (sRGB, IEC
/// 61966-2-1).
double decoded(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}
double encoded(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

Vec3d decoded(const Vec3d& colour) { return {decoded(colour.x), decoded(colour.y), decoded(colour.z)}; }

Rgb encoded(const Vec3d& light) {
  const auto byte = [](double share) {
    return static_cast<std::uint8_t>(std::lround(255 * encoded(std::clamp(share, 0.0, 1.0))));
  };
  return {byte(light.x), byte(light.y), byte(light.z)};
}

/// Sums what the waves of ray trees contribute to the pixels they started from.
class TreeShader {
 public:
  TreeShader(const Scene& scene, std::size_t pixels, int rays_per_pixel)
      : scene_(scene), light_(pixels), rays_per_pixel_(rays_per_pixel) {}

  void add(const Wave& wave) {
    std::vector<Sight> sights = wave.generation == 1 ? first_sights(wave) : later_sights(wave);
    for (std::size_t ray = 0; ray < sights.size(); ++ray)
      add_light(sights[ray], constant_light(wave.encounters[ray]));
    for (std::size_t shadow_ray = 0; shadow_ray < wave.blocked.size(); ++shadow_ray)
      if (!wave.blocked[shadow_ray])
        add_light(sights[wave.shadow_rays.parents[shadow_ray]], local_light(wave, shadow_ray));
    for (std::size_t ray = 0; ray < sights.size(); ++ray)
      if (wave.encounters[ray].object != kNoObject) sights[ray].material = &material(wave.encounters[ray]);
    previous_ = std::move(sights);
  }

  const std::vector<Vec3d>& light() const { return light_; }

 private:
  /// What a ray of the tree is for: the share of a pixel's light that it brings, and what it met.
  struct Sight {
    std::uint32_t pixel = 0;
    double weight = 1;
    const Material* material = nullptr;
    bool refracts = false;
  };

  const Material& material(const Encounter& met) const { return scene_.material_of(met.object); }

  void add_light(const Sight& sight, const Vec3d& colour) { light_[sight.pixel] += colour * sight.weight; }

  std::vector<Sight> first_sights(const Wave& wave) const {
    std::vector<Sight> sights(wave.encounters.size());
    for (std::size_t ray = 0; ray < sights.size(); ++ray)
      sights[ray] = {static_cast<std::uint32_t>(ray / rays_per_pixel_), 1.0 / rays_per_pixel_};
    return sights;
  }

  /// A mirror passes on its specular share, glass its transmittance: where light is totally reflected,
  /// backwards.
  std::vector<Sight> later_sights(const Wave& wave) {
    for (std::size_t ray = 0; ray < wave.encounters.size(); ++ray)
      if (wave.rays.origins[ray].kind == RayKind::refracted)
        previous_[wave.rays.parents[ray]].refracts = true;
    std::vector<Sight> sights(wave.encounters.size());
    for (std::size_t ray = 0; ray < sights.size(); ++ray) {
      const Sight& parent = previous_[wave.rays.parents[ray]];
      const Material& surface = *parent.material;
      const double reflected = surface.specular + (parent.refracts ? 0 : surface.transmittance);
      const bool refracted = wave.rays.origins[ray].kind == RayKind::refracted;
      sights[ray] = {parent.pixel, parent.weight * (refracted ? surface.transmittance : reflected)};
    }
    return sights;
  }

  /// What a ray sees without any light: the background, or the ambient light on a surface.
  Vec3d constant_light(const Encounter& met) const {
    if (met.object == kNoObject) return decoded(scene_.background);
    return decoded(material(met).colour) * (material(met).diffuse * kAmbient);
  }

  /// Diffuse light and highlight from the light at the end of a shadow ray (Phong 1975).
  Vec3d local_light(const Wave& wave, std::size_t shadow_ray) const {
    const std::uint32_t parent = wave.shadow_rays.parents[shadow_ray];
    const Encounter& met = wave.encounters[parent];
    const Material& surface = material(met);
    const Vec3d& to_light = wave.shadow_rays.rays[shadow_ray].direction;
    const double diffuse = surface.diffuse * dot(met.normal, to_light);
    const double along_mirror = dot(reflected(wave.rays.rays[parent].direction, met.normal), to_light);
    const double highlight = surface.specular > 0 && along_mirror > 0
                                 ? surface.specular * std::pow(along_mirror, surface.shine)
                                 : 0;

    const double intensity = 1 / std::sqrt(static_cast<double>(scene_.lights.size()));
    const Vec3d light = scene_.lights[wave.shadow_rays.origins[shadow_ray].light].colour.value_or(
        Vec3d{intensity, intensity, intensity});
    const Vec3d reflectance = decoded(surface.colour) * diffuse + Vec3d{highlight, highlight, highlight};
    return {reflectance.x * light.x, reflectance.y * light.y, reflectance.z * light.z};
  }

  const Scene& scene_;
  std::vector<Vec3d> light_;
  int rays_per_pixel_;
  std::vector<Sight> previous_;
};

/// Shade some rows of the picture.
void shade(Image& image, const Rows& rows, const Scene& scene, const Tracer& tracer, int samples) {
  const int width = image.width();
  TreeShader shader(scene, static_cast<std::size_t>(rows.last - rows.first) * width, samples * samples);
  std::vector<Ray<double>> rays = eye_rays(scene.view, width, image.height(), rows, samples);
  set_times(rays, scene, static_cast<std::uint64_t>(rows.first));
  grow_ray_trees(scene, tracer, ray_tree_rules("clean"), std::move(rays),
                 [&](const Wave& wave) { shader.add(wave); });
  for (std::size_t pixel = 0; pixel < shader.light().size(); ++pixel)
    image.at(static_cast<int>(pixel % width), rows.first + static_cast<int>(pixel / width)) =
        encoded(shader.light()[pixel]);
}

}  // namespace

Image shaded_picture(const Scene& scene, const Tracer& tracer, int width, int height, int samples,
                     int threads) {
  Image image(width, height);
  const int bands = (height + kRowsPerBand - 1) / kRowsPerBand;
  tbb::task_arena(threads).execute([&] {
    tbb::parallel_for(0, bands, [&](int band) {
      const Rows rows{band * kRowsPerBand, std::min(height, (band + 1) * kRowsPerBand)};
      shade(image, rows, scene, tracer, samples);
    });
  });
  return image;
}

}  // namespace rayshoot
