#include "accel/parts/ray_order.h"

#include <immintrin.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace rayshoot {

namespace {

/// Along each axis. More of either made no difference of note.
constexpr int kOriginBits = 6, kDirectionBits = 2;

typedef std::int32_t Cells __attribute__((vector_size(16)));

/// The cell of three numbers between 0 and 1 along a Morton curve; of what lies beside the nearest, of what is no number the
/// first.
std::uint32_t morton(const Lanes<float>& position, int bits) {
  const Lanes<float> first{}, last = first + static_cast<float>((1 << bits) - 1);
  const Lanes<float> within = min_lanes(max_lanes(position * static_cast<float>(1 << bits), first), last);
  const Cells cell = __builtin_convertvector(within, Cells);
  return _pdep_u32(static_cast<std::uint32_t>(cell[0]), 0x09249249) |
         _pdep_u32(static_cast<std::uint32_t>(cell[1]), 0x12492492) |
         _pdep_u32(static_cast<std::uint32_t>(cell[2]), 0x24924924);
}

Lanes<float> in_lanes(const Vec3<float>& vector) { return Lanes<float>{vector.x, vector.y, vector.z, 0}; }
LaneBox<float> in_lanes(const Box<float>& box) { return {in_lanes(box.lo), in_lanes(box.hi)}; }

/// Where a ray is first inside of a box; none where it never is.
std::optional<Lanes<float>> first_inside(const Ray<float>& ray, const Box<float>& bounds) {
  if (bounds.contains({ray.origin, ray.origin})) return in_lanes(ray.origin);
  const Interval<float> inside = interval_inside(bounds, ray);
  const float enter = std::max(inside.enter, ray.t_min);
  if (enter <= std::min(inside.exit, ray.t_max)) return in_lanes(ray.at(enter));
  return std::nullopt;
}

std::uint32_t key_of(const Lanes<float>& begins, const Vec3<float>& direction) {
  const Lanes<float> to = in_lanes(direction) * (0.5f / max_abs(direction)) + 0.5f;
  return morton(begins, kOriginBits) << 3 * kDirectionBits | morton(to, kDirectionBits);
}

}  // namespace

std::span<const std::uint32_t> RayOrder::sorted(std::span<const Ray<float>> rays, const Box<float>& bounds) {
  keyed_.resize(rays.size()), other_.resize(rays.size()), order_.resize(rays.size());
  counts_ = {};

  // Find the cell of each ray, and what there is of each digit. Rays that miss go to the end.
  const LaneBox<float> box = in_lanes(bounds);
  const Lanes<float> extent = box.hi - box.lo, scale = extent > 0 ? 1 / extent : Lanes<float>{};
  std::size_t last = rays.size(), coming = 0;
  for (std::uint32_t ray = 0; ray < rays.size(); ++ray) {
    if (const auto begins = first_inside(rays[ray], bounds))
      add(coming++, {key_of((*begins - box.lo) * scale, rays[ray].direction), ray});
    else
      order_[--last] = ray;
  }

  // Sort by the digits, the lowest first: equal ones keep their order.
  sort_by(0, keyed_.data(), coming, [this](std::uint32_t place, const Keyed& ray) { other_[place] = ray; });
  sort_by(1, other_.data(), coming, [this](std::uint32_t place, const Keyed& ray) { keyed_[place] = ray; });
  sort_by(2, keyed_.data(), coming,
          [this](std::uint32_t place, const Keyed& ray) { order_[place] = ray.ray; });
  return order_;
}

}  // namespace rayshoot
