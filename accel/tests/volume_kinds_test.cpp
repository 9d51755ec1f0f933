// The volumes of accel/parts/volume_kinds.h hold every hit, and are as tight as their kind allows.
#include "accel/parts/volume_kinds.h"

#include <gtest/gtest.h>

#include <numbers>

#include "accel/tests/nasty_scenes.h"
#include "scenes/core/affine.h"

namespace rayshoot {
namespace {

template <class Real>
void expect_no_hit_lost() {
  for (const nasty::NamedScene& named : nasty::scenes())
    for (const double scale : nasty::kScales) {
      SCOPED_TRACE(named.name);
      const Geometry<Real> geometry(nasty::scaled(named.scene, scale));
      const std::vector<Ray<Real>> rays = nasty::rays(geometry, scale, 40);
      for (std::uint32_t object = 0; object < geometry.size(); ++object) {
        const std::uint32_t alone[] = {object};
        const auto volumes = bounding_volumes<Real>(geometry, alone);
        for (const Ray<Real>& ray : rays) {
          const Real t = geometry.hit_distance(object, ray);
          if (t == kMiss<Real>) continue;
          for (const Volume<Real>& volume : volumes) {
            const Interval<Real> inside = volume.inside(VolumeRay<Real>(ray));
            ASSERT_TRUE(inside.enter <= t && t <= inside.exit) << kVolumeKindNames[int(volume.kind)];
          }
        }
      }
    }
}

TEST(VolumeKinds, LoseNoHitInFloat) { expect_no_hit_lost<float>(); }
TEST(VolumeKinds, LoseNoHitInDouble) { expect_no_hit_lost<double>(); }

std::array<Volume<double>, 4> volumes_of(SceneBuilder&& builder) {
  const Scene scene = std::move(builder).finish();
  const Geometry<double> geometry(scene);
  std::vector<std::uint32_t> objects(geometry.size());
  for (std::uint32_t i = 0; i < geometry.size(); ++i) objects[i] = i;
  return bounding_volumes<double>(geometry, objects);
}

const Volume<double>& of_kind(const std::array<Volume<double>, 4>& volumes, VolumeKind kind) {
  return volumes[static_cast<std::size_t>(kind)];
}

/// Twelve points of a slab of 4 x 2 x 1, as slivers of triangles along its edges, turned.
SceneBuilder turned_slab(double angle) {
  SceneBuilder builder;
  const Affine turn = rotation(normalized(Vec3d{1, 2, 3}), angle);
  for (const double y : {-1.0, 1.0})
    for (const double z : {-0.5, 0.5})
      builder.triangle(turn({-2, y, z}), turn({2, y, z}), turn({0, y, 0.9 * z}));
  return builder;
}

TEST(VolumeKinds, AnOrientedBoxTurnsWithItsObjects) {
  const double surface = 2 * (4 * 2 + 2 * 1 + 1 * 4);
  for (const double angle : {0.0, 0.3, 0.8, 2.0}) {
    const auto volumes = volumes_of(turned_slab(angle));
    EXPECT_NEAR(of_kind(volumes, VolumeKind::oriented_box).surface_area(), surface, 1e-9 * surface) << angle;
    if (angle == 0) continue;
    EXPECT_GT(of_kind(volumes, VolumeKind::axis_box).surface_area(), 1.1 * surface) << angle;
  }
}

TEST(VolumeKinds, ASphereIsBoundedByItself) {
  SceneBuilder builder;
  builder.sphere({1, 2, 3}, 0.5);
  const auto volumes = volumes_of(std::move(builder));
  EXPECT_NEAR(of_kind(volumes, VolumeKind::sphere).surface_area(), std::numbers::pi, 1e-9);
  EXPECT_EQ(cheapest_volume<double>(volumes, VolumeFit::projected_area).kind, VolumeKind::sphere);
}

TEST(VolumeKinds, ALongSlantedCylinderIsBoundedByACylinder) {
  SceneBuilder builder;
  builder.cone({0, 0, 0}, 0.01, {3, 2, 1}, 0.01);
  const auto volumes = volumes_of(std::move(builder));
  const double own = 2 * std::numbers::pi * 0.01 * (std::sqrt(14) + 0.01);
  EXPECT_NEAR(of_kind(volumes, VolumeKind::cylinder).surface_area(), own, 0.03 * own);
  const VolumeKind kind = cheapest_volume<double>(volumes, VolumeFit::projected_area).kind;
  EXPECT_TRUE(kind == VolumeKind::cylinder || kind == VolumeKind::oriented_box);
}

TEST(VolumeKinds, ARayThroughTheMiddleIsInsideForTheDiameter) {
  SceneBuilder builder;
  builder.cone({0, 0, -1}, 2, {0, 0, 1}, 2);
  const auto volumes = volumes_of(std::move(builder));
  const VolumeRay<double> across({.origin = {-10, 0, 0}, .direction = {2, 0, 0}});
  for (const auto& [kind, enter] : {std::pair{VolumeKind::sphere, 5 - std::sqrt(5) / 2},
                                    {VolumeKind::axis_box, 4.0},
                                    {VolumeKind::cylinder, 4.0}}) {
    const Interval<double> inside = of_kind(volumes, kind).inside(across);
    EXPECT_NEAR(inside.enter, enter, 0.05) << kVolumeKindNames[int(kind)];
    EXPECT_NEAR(inside.exit, 10 - enter, 0.05) << kVolumeKindNames[int(kind)];
  }
}

TEST(VolumeKinds, ARayBesideThemMissesAll) {
  const auto volumes = volumes_of(turned_slab(0.5));
  const VolumeRay<double> beside({.origin = {-10, 5, 0}, .direction = {1, 0, 0}});
  for (const Volume<double>& volume : volumes) {
    const Interval<double> inside = volume.inside(beside);
    EXPECT_GT(inside.enter, inside.exit) << kVolumeKindNames[int(volume.kind)];
  }
}

}  // namespace
}  // namespace rayshoot
