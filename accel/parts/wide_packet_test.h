#pragma once

#include "accel/parts/wide_packet.h"

// Read where code for a kind of processor begins: all that is not included is a template over its instructions.

namespace rayshoot {

/// The rays of one part of a packet, one in each lane of a triangle test.
template <class Isa>
struct WidePacketPart {
  const WidePacket<Isa>& packet;
  std::uint32_t first;

  auto direction(int axis) const { return Isa::widened(Isa::load(packet.direction[axis] + first)); }
  auto exact_origin(int axis) const { return Isa::widened(origin(axis)); }
  auto origin(int axis) const { return Isa::load(packet.origin[axis] + first); }
  auto earliest(int axis) const { return Isa::load(packet.earliest[axis] + first); }
  auto latest(int axis) const { return Isa::load(packet.latest[axis] + first); }
  auto t_min() const { return Isa::load(packet.t_min + first); }
};

/// A leaf prepared for tests with packets: which rays cannot hit a triangle is seen in single precision, as far as that
/// is beyond doubt; the others get the exact test.
template <class Isa>
class WidePacketTest {
 public:
  using Lanes = typename Isa::Lanes;

  WidePacketTest(const float* leaf, std::uint32_t count) : leaf_(leaf), count_(count) {
    __m256 corner[3][3], edge[2][3], normal[3], longest = _mm256_set1_ps(kShortest);
    for (std::uint32_t which = 0; which < 3; ++which)
      for (std::uint32_t axis = 0; axis < 3; ++axis)
        corner[which][axis] = _mm256_loadu_ps(leaf + (3 * which + axis) * count);
    for (int axis = 0; axis < 3; ++axis) {
      _mm256_store_ps(a_[axis], corner[0][axis]);
      for (int side = 0; side < 2; ++side) {
        edge[side][axis] = corner[side + 1][axis] - corner[0][axis];
        _mm256_store_ps(edge_[side][axis], edge[side][axis]);
        longest = _mm256_max_ps(longest, _mm256_max_ps(edge[side][axis], -edge[side][axis]));
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      const int next = (axis + 1) % 3, last = (axis + 2) % 3;
      normal[axis] = edge[0][next] * edge[1][last] - edge[0][last] * edge[1][next];
      _mm256_store_ps(normal_[axis], normal[axis]);
    }
    _mm256_store_ps(longest_, longest);
  }

  /// One bit for each ray that may hit a triangle.
  unsigned may_hit(const WidePacket<Isa>& packet, std::uint32_t triangle) const {
    Lanes direction[3], to_a[3], largest = Isa::all(kShortest), away = largest;
    for (int axis = 0; axis < 3; ++axis) {
      direction[axis] = Isa::lanes(packet.direction[axis]);
      to_a[axis] = Isa::all(a_[axis][triangle]) - Isa::lanes(packet.origin[axis]);
      largest = Isa::larger(largest, Isa::magnitudes(direction[axis]));
      away = Isa::larger(away, Isa::magnitudes(to_a[axis]));
    }
    const auto cross = [&](int axis) {
      const int next = (axis + 1) % 3, last = (axis + 2) % 3;
      return Isa::rest(to_a[last], direction[next], to_a[next] * direction[last]);
    };
    const Lanes q[3] = {cross(0), cross(1), cross(2)};
    const auto along = [&](const float(&of)[3][kWideWidth], const Lanes* with) {
      const Lanes one = Isa::all(of[0][triangle]) * with[0];
      return Isa::sum(Isa::all(of[2][triangle]), with[2], Isa::sum(Isa::all(of[1][triangle]), with[1], one));
    };
    const Lanes approach = along(normal_, direction), sign = Isa::signs(approach);
    const Lanes u = Isa::turned(along(edge_[1], q), sign), minus_v = Isa::turned(along(edge_[0], q), sign);

    // Rounding moves u and v by less than this, and the approach, of which they are parts, by less than `doubt`.
    const Lanes longest = Isa::all(kDoubt * longest_[triangle]);
    const Lanes beside = longest * away * largest, doubt = longest * Isa::all(longest_[triangle]) * largest;
    const Lanes size = Isa::magnitudes(approach);
    const unsigned beyond = Isa::below(u, -beside) | Isa::below(beside, minus_v) |
                            Isa::below(size + doubt + (beside + beside), u - minus_v);
    return WidePacket<Isa>::kAll & ~(beyond & Isa::below(doubt, size));
  }

  /// Call hit(ray, t) for the exact hits of some rays with a triangle, up to their `reach`.
  template <class Hit>
  void hits(const WidePacket<Isa>& packet, std::uint32_t triangle, unsigned rays, const Hit& hit) const {
    typename Isa::Floats corner[3][3];
    for (std::uint32_t which = 0; which < 3; ++which)
      for (std::uint32_t axis = 0; axis < 3; ++axis)
        corner[which][axis] = Isa::spread(leaf_[(3 * which + axis) * count_ + triangle]);
    for (std::uint32_t first = 0; first < Isa::kRays; first += Isa::kObjects) {
      const unsigned part = rays >> first & ((1u << Isa::kObjects) - 1);
      if (part == 0) continue;
      const auto found = WideTriangleTest<Isa>::hits(corner, WidePacketPart<Isa>{packet, first},
                                                     Isa::load(packet.reach + first), part);
      float t[Isa::kObjects];
      if (found.bits != 0) std::memcpy(t, &found.t, sizeof t);
      for (unsigned bits = found.bits; bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<std::uint32_t>(std::countr_zero(bits));
        hit(first + lane, t[lane]);
      }
    }
  }

 private:
  /// Of products of three lengths with up to eight roundings, and sums of six of them; generous.
  static constexpr float kDoubt = 64 * std::numeric_limits<float>::epsilon();

  /// Shorter lengths are taken for this, so that products of three are far above where numbers end.
  static constexpr float kShortest = 1e-10f;

  const float* leaf_;
  std::uint32_t count_;
  alignas(32) float a_[3][kWideWidth], edge_[2][3][kWideWidth], normal_[3][kWideWidth], longest_[kWideWidth];
};

}  // namespace rayshoot
