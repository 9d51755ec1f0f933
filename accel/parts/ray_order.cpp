#include "accel/parts/ray_order.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace rayshoot {

namespace {

/// Along each axis. More of either made no difference of note.
constexpr int kOriginBits = 6, kDirectionBits = 2;
constexpr int kBits = 3 * (kOriginBits + kDirectionBits), kBitsAtOnce = 12;

/// Ten bits, each followed by two zeros.
std::uint32_t spread(std::uint32_t bits) {
  bits = (bits | bits << 16) & 0x030000FF;
  bits = (bits | bits << 8) & 0x0300F00F;
  bits = (bits | bits << 4) & 0x030C30C3;
  return (bits | bits << 2) & 0x09249249;
}

/// The cell of a number between 0 and 1; of what lies beside the nearest, of what is no number the first.
std::uint32_t cell(float position, int bits) {
  const auto cells = static_cast<float>(1 << bits);
  return static_cast<std::uint32_t>(std::min(std::max(0.0f, position * cells), cells - 1));
}

std::uint32_t morton(const Vec3<float>& position, int bits) {
  return spread(cell(position.x, bits)) | spread(cell(position.y, bits)) << 1 |
         spread(cell(position.z, bits)) << 2;
}

/// Where a ray is first inside of a box; none where it never is.
std::optional<Vec3<float>> first_inside(const Ray<float>& ray, const Box<float>& bounds) {
  const Vec3<float>& from = ray.origin;
  if (bounds.contains({from, from})) return from;
  const Interval<float> inside = interval_inside(bounds, ray);
  const float enter = std::max(inside.enter, ray.t_min);
  if (enter <= std::min(inside.exit, ray.t_max)) return ray.at(enter);
  return std::nullopt;
}

}  // namespace

std::span<const std::uint32_t> RayOrder::sorted(std::span<const Ray<float>> rays, const Box<float>& bounds) {
  keyed_.clear(), order_.resize(rays.size());
  const Vec3<float> extent = bounds.extent();
  Vec3<float> scale;
  for (int axis = 0; axis < 3; ++axis) scale[axis] = extent[axis] > 0 ? 1 / extent[axis] : 0;
  std::size_t last = rays.size();
  for (std::size_t ray = 0; ray < rays.size(); ++ray) {
    const auto begins = first_inside(rays[ray], bounds);
    if (!begins) {
      order_[--last] = static_cast<std::uint32_t>(ray);
      continue;
    }
    Vec3<float> from = *begins - bounds.lo, to = rays[ray].direction;
    const float half = 0.5f / max_abs(to);
    for (int axis = 0; axis < 3; ++axis) from[axis] *= scale[axis], to[axis] = to[axis] * half + 0.5f;
    const std::uint32_t key = morton(from, kOriginBits) << 3 * kDirectionBits | morton(to, kDirectionBits);
    keyed_.push_back({key, static_cast<std::uint32_t>(ray)});
  }
  other_.resize(keyed_.size());
  for (int bit = 0; bit < kBits; bit += kBitsAtOnce) sort_by(bit);
  std::transform(keyed_.begin(), keyed_.end(), order_.begin(), [](const Keyed& ray) { return ray.ray; });
  return order_;
}

/// One step of a sort by digits, the lowest first: equal ones keep their order.
void RayOrder::sort_by(int first_bit) {
  const auto digit = [&](const Keyed& ray) { return ray.key >> first_bit & ((1u << kBitsAtOnce) - 1); };
  std::array<std::uint32_t, 1 << kBitsAtOnce> places{};
  for (const Keyed& ray : keyed_) ++places[digit(ray)];
  std::uint32_t before = 0;
  for (std::uint32_t& place : places) before += std::exchange(place, before);
  for (const Keyed& ray : keyed_) other_[places[digit(ray)]++] = ray;
  keyed_.swap(other_);
}

}  // namespace rayshoot
