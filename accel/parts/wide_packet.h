#pragma once

#include "accel/parts/wide_kernels.h"
#include "accel/parts/wide_triangle_test.h"
#include "accel/parts/wide_walk.h"

// Read where code for a kind of processor begins: all that is not included is a template over its instructions.

namespace rayshoot {

/// Rays that go much the same way, in lanes, with how far each of them looks and what it has met.
template <class Isa>
class WidePacket {
 public:
  static constexpr std::uint32_t kRays = Isa::kRays;
  static constexpr unsigned kAll = (1u << kRays) - 1;
  using Lanes = typename Isa::Lanes;
  using Row = float[kRays];

  explicit WidePacket(const Ray<float>* rays) {
    for (std::uint32_t lane = 0; lane < kRays; ++lane) {
      const Ray<float>& ray = rays[lane];
      for (int axis = 0; axis < 3; ++axis) {
        origin[axis][lane] = ray.origin[axis];
        direction[axis][lane] = ray.direction[axis];
      }
      t_min[lane] = ray.t_min > 0 ? ray.t_min : 0, reach[lane] = ray.t_max;
      object[lane] = kNoObject;
    }
    const Lanes limit = Isa::all(std::numeric_limits<float>::max() / 2);
    for (int axis = 0; axis < 3; ++axis) {
      const Lanes unlimited = Isa::all(1) / Isa::lanes(direction[axis]);
      const Lanes inverse = Isa::smaller(Isa::larger(unlimited, -limit), limit);
      Isa::store(inverse * (1 - kCrossingError<float>), earliest[axis]);
      Isa::store(inverse * (1 + kCrossingError<float>), latest[axis]);
    }
  }

  /// Whether all rays can hit something, and no two of them go to different sides along any axis.
  bool goes_one_way() const {
    unsigned fit = Isa::below(Isa::lanes(t_min), Isa::lanes(reach));
    for (int axis = 0; axis < 3; ++axis) {
      const Lanes zero = (Isa::lanes(origin[axis]) - Isa::lanes(origin[axis])) +
                         (Isa::lanes(direction[axis]) - Isa::lanes(direction[axis]));
      fit &= Isa::not_above(zero, Isa::all(0));
      const unsigned negative = Isa::negative(Isa::lanes(earliest[axis]));
      if (negative != 0 && negative != kAll) return false;
    }
    return fit == kAll;
  }
  bool is_negative(int axis) const { return std::signbit(earliest[axis][0]); }
  Hit<float> hit(std::uint32_t lane) const {
    return object[lane] == kNoObject ? Hit<float>{} : Hit<float>{reach[lane], object[lane]};
  }
  float farthest() const { return Isa::largest(Isa::lanes(reach)); }

  alignas(64) Row origin[3], direction[3], earliest[3], latest[3], t_min, reach;
  std::uint32_t object[kRays];
};

/// One ray of a packet as the tests want it.
template <class Isa>
struct WidePacketRay {
  const WidePacket<Isa>& packet;
  std::uint32_t lane;

  float origin(int axis) const { return packet.origin[axis][lane]; }
  float direction(int axis) const { return packet.direction[axis][lane]; }
  float earliest(int axis) const { return packet.earliest[axis][lane]; }
  float latest(int axis) const { return packet.latest[axis][lane]; }
  float t_min() const { return packet.t_min[lane]; }
  __m128 origin_lanes() const { return _mm_setr_ps(origin(0), origin(1), origin(2), 0); }
  __m128 earliest_lanes() const { return _mm_setr_ps(earliest(0), earliest(1), earliest(2), 0); }
  Ray<float> begun() const {
    const WidePacket<Isa>& p = packet;
    return {.origin = {origin(0), origin(1), origin(2)},
            .t_min = t_min(),
            .direction = {direction(0), direction(1), direction(2)},
            .t_max = p.reach[lane]};
  }
};

/// A packet prepared for testing boxes: whether any of its rays can meet them, for all boxes of a node at once, and
/// which of its rays do, for one box.
template <class Isa>
class WidePacketCrossings {
 public:
  using Lanes = typename Isa::Lanes;

  explicit WidePacketCrossings(const WidePacket<Isa>& packet) : packet_(packet) {
    const auto least = [](const float* row) { return _mm256_set1_ps(Isa::least(Isa::lanes(row))); };
    const auto largest = [](const float* row) { return _mm256_set1_ps(Isa::largest(Isa::lanes(row))); };
    for (int axis = 0; axis < 3; ++axis) {
      near_[axis] = packet.is_negative(axis);
      near_origin_[axis] = near_[axis] ? least(packet.origin[axis]) : largest(packet.origin[axis]);
      far_origin_[axis] = near_[axis] ? largest(packet.origin[axis]) : least(packet.origin[axis]);
      earliest_[axis][0] = least(packet.earliest[axis]), earliest_[axis][1] = largest(packet.earliest[axis]);
      latest_[axis][0] = least(packet.latest[axis]), latest_[axis][1] = largest(packet.latest[axis]);
    }
    start_ = least(packet.t_min);
  }

  /// The children of a node that some ray may meet before `farthest`.
  MetChildren<Isa> met(const WideNode<float>& node, float farthest) const {
    __m256 enter = start_, exit = _mm256_set1_ps(farthest);
    for (int axis = 0; axis < 3; ++axis) {
      const __m256 near = _mm256_load_ps(node.planes[axis][near_[axis]]) - near_origin_[axis];
      const __m256 far = _mm256_load_ps(node.planes[axis][near_[axis] ^ 1]) - far_origin_[axis];
      enter = _mm256_max_ps(enter, _mm256_min_ps(near * earliest_[axis][0], near * earliest_[axis][1]));
      exit = _mm256_min_ps(exit, _mm256_max_ps(far * latest_[axis][0], far * latest_[axis][1]));
    }
    return MetChildren<Isa>::of(Isa::not_above(enter, exit), enter);
  }

  /// One bit for each ray that meets a child of a node.
  unsigned meeting(const WideNode<float>& node, unsigned which) const {
    Lanes enter = Isa::lanes(packet_.t_min), exit = Isa::lanes(packet_.reach);
    for (int axis = 0; axis < 3; ++axis) {
      const Lanes origin = Isa::lanes(packet_.origin[axis]);
      const Lanes near = Isa::all(node.planes[axis][near_[axis]][which]) - origin;
      const Lanes far = Isa::all(node.planes[axis][near_[axis] ^ 1][which]) - origin;
      enter = Isa::larger(enter, near * Isa::lanes(packet_.earliest[axis]));
      exit = Isa::smaller(exit, far * Isa::lanes(packet_.latest[axis]));
    }
    return Isa::not_above(enter, exit);
  }

 private:
  const WidePacket<Isa>& packet_;
  __m256 near_origin_[3], far_origin_[3], earliest_[3][2], latest_[3][2], start_;
  std::size_t near_[3];
};

/// The leaves that rays of a packet meet, those that begin nearest first.
///   visit(leaf, rays)   is called with a leaf and one bit for each ray that meets it; it shortens their `reach`
///   alone(child, ray)   is called for the rays that are left where few meet a child
template <class Isa, class Visit, class Alone>
void walk_packet(const WideTree<float>& tree, const WidePacket<Isa>& packet, const Visit& visit,
                 const Alone& alone) {
  // So few rays are faster one by one.
  constexpr int kFew = 6;
  struct Waiting {
    int key;
    WideChild child;
    unsigned rays;
  };
  const WidePacketCrossings<Isa> crossings(packet);
  Waiting stack[kMaxSahDepth * (kWideWidth - 1) + kWideWidth];
  Waiting* top = stack;
  *top++ = {0, WideChild::interior(0), packet.kAll};
  while (top != stack) {
    // Leave out the rays that have met something nearer by now.
    const Waiting now = *--top;
    const float begins = std::bit_cast<float>(now.key & ~MetChildren<Isa>::kChildBits);
    unsigned rays = now.rays & Isa::not_above(Isa::all(begins), Isa::lanes(packet.reach));
    if (std::popcount(rays) <= kFew) {
      for (; rays != 0; rays &= rays - 1)
        alone(now.child, static_cast<std::uint32_t>(std::countr_zero(rays)));
      continue;
    }
    if (now.child.is_leaf()) {
      visit(now.child, rays);
      continue;
    }

    // Find the children that any ray may meet, then the rays that meet each of them.
    const WideNode<float>& node = tree.nodes[now.child.node()];
    const MetChildren<Isa> met = crossings.met(node, packet.farthest());
    alignas(32) int keys[kWideWidth];
    _mm256_store_si256(reinterpret_cast<__m256i*>(keys), met.keys);
    Waiting* const first = top;
    for (unsigned bits = met.bits; bits != 0; bits &= bits - 1) {
      const auto which = static_cast<unsigned>(std::countr_zero(bits));
      const unsigned meeting = rays & crossings.meeting(node, which);
      if (meeting == 0) continue;
      Waiting* place = top++;
      for (; place != first && place[-1].key < keys[which]; --place) *place = place[-1];
      *place = {keys[which], node.child[which], meeting};
    }
  }
}

}  // namespace rayshoot
