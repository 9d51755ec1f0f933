#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "harness/baseline/embree_scene.h"
#include "scenes/geometry/ray.h"

/// Rays in the forms in which Embree takes them: one by one, and as packets of sixteen.
namespace rayshoot {

/// Whether Embree takes the ray: it aborts on numbers that are not finite or too large, and on a negative
/// t_min.
inline bool acceptable(const Ray<float>& ray) {
  const auto bounded = [](const Vec3<float>& v) {
    return (std::abs(v.x) <= kEmbreeLargest) & (std::abs(v.y) <= kEmbreeLargest) &
           (std::abs(v.z) <= kEmbreeLargest);
  };
  return bounded(ray.origin) & bounded(ray.direction) & (ray.t_min >= 0) & (ray.t_max > ray.t_min);
}

/// The ray for Embree; one that Embree passes over where it would not take the ray.
inline RTCRay embree_ray(const Ray<float>& ray) {
  const Vec3<float>&o = ray.origin, &d = ray.direction;
  if (!acceptable(ray)) return {.tnear = 1, .dir_x = 1, .tfar = 0};
  return {.org_x = o.x,
          .org_y = o.y,
          .org_z = o.z,
          .tnear = ray.t_min,
          .dir_x = d.x,
          .dir_y = d.y,
          .dir_z = d.z,
          .time = 0,
          .tfar = ray.t_max,
          .mask = ~0u,
          .id = 0,
          .flags = 0};
}

/// Embree ends a ray that is blocked before its start.
inline bool is_blocked(float t_far) { return t_far == -std::numeric_limits<float>::infinity(); }

inline constexpr std::size_t kPacketRays = 16;

/// Which rays of a packet are traced: -1 for those that are, 0 for the others.
using PacketMask = std::array<int, kPacketRays>;

/// Fill a packet with up to sixteen rays. Those that are missing, and those that Embree would not take, are masked off.
inline void fill(RTCRay16& packet, PacketMask& mask, std::span<const Ray<float>> rays) {
  for (std::size_t i = 0; i < kPacketRays; ++i) {
    const RTCRay ray = embree_ray(i < rays.size() ? rays[i] : rays.front());
    mask[i] = i < rays.size() && acceptable(rays[i]) ? -1 : 0;
    packet.org_x[i] = ray.org_x, packet.org_y[i] = ray.org_y, packet.org_z[i] = ray.org_z;
    packet.dir_x[i] = ray.dir_x, packet.dir_y[i] = ray.dir_y, packet.dir_z[i] = ray.dir_z;
    packet.tnear[i] = ray.tnear, packet.tfar[i] = ray.tfar;
    packet.time[i] = 0, packet.mask[i] = ~0u, packet.id[i] = 0, packet.flags[i] = 0;
  }
}

}  // namespace rayshoot
