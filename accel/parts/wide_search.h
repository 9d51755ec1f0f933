#pragma once

#include "accel/parts/wide_kernels.h"
#include "accel/parts/wide_packet_test.h"
#include "accel/parts/wide_walk.h"

// Read where code for a kind of processor begins: all that is not included is a template over its instructions.

namespace rayshoot {

/// The searches of WideKernels.
template <class Isa>
struct WideSearch {
  static void closest_of_all(const WideScene& scene, const WideBatch& batch, std::span<Hit<float>> hits) {
    suited(scene, batch, [&]<class Kind>(Kind, const auto& manner) {
      const auto one = [&](std::size_t i) { hits[i] = closest<Kind>(scene, manner, batch.rays[i]); };
      const auto packet = [&](Packet& rays, std::size_t first) {
        closest_of_packet<Kind>(scene, rays);
        for (std::uint32_t lane = 0; lane < Packet::kRays; ++lane) hits[first + lane] = rays.hit(lane);
      };
      for_each(batch, one, packet);
    });
  }
  static void any_of_all(const WideScene& scene, const WideBatch& batch, std::span<std::uint8_t> blocked) {
    suited(scene, batch, [&]<class Kind>(Kind, const auto& manner) {
      const auto one = [&](std::size_t i) { blocked[i] = any<Kind>(scene, manner, batch.rays[i]); };
      const auto packet = [&](Packet& rays, std::size_t first) {
        any_of_packet<Kind>(scene, rays);
        for (std::uint32_t lane = 0; lane < Packet::kRays; ++lane)
          blocked[first + lane] = rays.reach[lane] == kBlocked;
      };
      for_each(batch, one, packet);
    });
  }

 private:
  using Packet = WidePacket<Isa>;
  /// Where a ray looks no farther, since it is blocked.
  static constexpr float kBlocked = -1;

  /// Whether a scene has others than triangles, and slivers that were cut.
  template <bool kHasOthers, bool kHasCut>
  struct KindOf {
    static constexpr bool kOthers = kHasOthers, kCut = kHasCut;
  };

  /// Call `search` with the kind of the scene, and in the manner that suits the rays.
  template <class Search>
  static void suited(const WideScene& scene, const WideBatch& batch, const Search& search) {
    const auto with_manner = [&](auto kind) {
      if (batch.is_sorted() || batch.is_coherent()) return search(kind, WideCoherent<Isa>{});
      search(kind, WideIncoherent<Isa, float>{scene.tree.nodes.data(), scene.triangles.begin(),
                                              WideTriangles::kBytes});
    };
    const bool others = scene.triangles.has_others();
    if (scene.margin) return others ? with_manner(KindOf<true, true>{}) : with_manner(KindOf<false, true>{});
    return others ? with_manner(KindOf<true, false>{}) : with_manner(KindOf<false, false>{});
  }

  /// Call packet(rays, first) for as many rays at once as go together, and one(ray) for the others.
  template <class One, class PacketOf>
  static void for_each(const WideBatch& batch, const One& one, const PacketOf& packet) {
    const std::size_t count = batch.rays.size();
    if (!batch.in_packets) return batch.for_each(one);
    std::size_t first = 0;
    for (; first + Packet::kRays <= count; first += Packet::kRays) {
      Packet rays(&batch.rays[first]);
      if (rays.goes_one_way())
        packet(rays, first);
      else
        for (std::uint32_t lane = 0; lane < Packet::kRays; ++lane) one(first + lane);
    }
    for (; first < count; ++first) one(first);
  }

  template <class Kind, class Manner>
  [[gnu::flatten, gnu::noinline]] static Hit<float> closest(const WideScene& scene, const Manner& manner,
                                                            const Ray<float>& given) {
    const WideRay<Isa> ray(given);
    if (scene.tree.empty() || !ray.can_hit) return {};
    Nearest nearest{ray.begun().t_max};
    closest_below<Kind>(scene, manner, WideChild::interior(0), ray, nearest);
    return nearest.hit();
  }
  template <class Kind, class Manner>
  [[gnu::flatten, gnu::noinline]] static bool any(const WideScene& scene, const Manner& manner,
                                                  const Ray<float>& given) {
    const WideRay<Isa> ray(given);
    if (scene.tree.empty() || !ray.can_hit) return false;
    return any_below<Kind>(scene, manner, WideChild::interior(0), ray, ray.begun().t_max);
  }

  /// The nearest hit so far, of equal distances the lowest object.
  struct Nearest {
    float reach;
    std::uint32_t object = kNoObject;

    void keep(float t, std::uint32_t which) {
      if (t > reach || (t == reach && which > object)) return;
      reach = t, object = which;
    }
    Hit<float> hit() const { return object == kNoObject ? Hit<float>{} : Hit<float>{reach, object}; }
  };

  template <class Kind, class OneRay>
  static WideCrossings<Isa, float> crossings_of(const WideScene& scene, const OneRay& ray) {
    if constexpr (Kind::kCut)
      return WideCrossings<Isa, float>(ray, scene.margin_of(ray));
    else
      return WideCrossings<Isa, float>(ray);
  }

  template <class Kind, class Manner, class OneRay>
  static void closest_below(const WideScene& scene, const Manner& manner, WideChild start, const OneRay& ray,
                            Nearest& given) {
    // A copy of its own stays in registers.
    Nearest nearest = given;
    const auto visit = [&](WideChild leaf) {
      const std::uint32_t count = leaf.count();
      const float* const rows = scene.triangles.leaf(leaf);
      for (std::uint32_t first = 0; first < count; first += Isa::kObjects) {
        // Test the triangles of the leaf at once, then one by one what else is in it.
        const unsigned others = Kind::kOthers ? no_triangles(rows, count, first) : 0;
        if (others != in_use(count, first)) {
          const auto found = hits_in_leaf<Isa>(ray, rows, count, first, nearest.reach);
          float t[Isa::kObjects];
          if (found.bits != 0) std::memcpy(t, &found.t, sizeof t);
          for (unsigned bits = found.bits; bits != 0; bits &= bits - 1) {
            const auto lane = static_cast<std::uint32_t>(std::countr_zero(bits));
            nearest.keep(t[lane], number_of(rows, count, first + lane));
          }
        }
        for (unsigned bits = others; bits != 0; bits &= bits - 1) {
          const std::uint32_t place = place_of(leaf, first, bits);
          const float t = other_hit_distance(scene, place, ray.begun(), nearest.reach);
          if (t <= nearest.reach) nearest.keep(t, scene.order[place]);
        }
      }
      return false;
    };
    const auto crossings = crossings_of<Kind>(scene, ray);
    walk_wide<Isa>(
        scene.tree, start, crossings, NoCount{}, [&] { return nearest.reach; }, manner, visit);
    given = nearest;
  }

  template <class Kind, class Manner, class OneRay>
  static bool any_below(const WideScene& scene, const Manner& manner, WideChild start, const OneRay& ray,
                        float reach) {
    bool blocked = false;
    const auto visit = [&](WideChild leaf) {
      const std::uint32_t count = leaf.count();
      const float* const rows = scene.triangles.leaf(leaf);
      for (std::uint32_t first = 0; first < count; first += Isa::kObjects) {
        const unsigned others = Kind::kOthers ? no_triangles(rows, count, first) : 0;
        if (others != in_use(count, first) && hits_in_leaf<Isa>(ray, rows, count, first, reach).bits != 0)
          return blocked = true;
        for (unsigned bits = others; bits != 0; bits &= bits - 1)
          if (other_hit_distance(scene, place_of(leaf, first, bits), ray.begun(), reach) <= reach)
            return blocked = true;
      }
      return false;
    };
    const auto crossings = crossings_of<Kind>(scene, ray);
    walk_wide_unordered<Isa>(scene.tree, start, crossings, NoCount{}, reach, manner, visit);
    return blocked;
  }

  template <class Kind>
  [[gnu::flatten, gnu::noinline]] static void closest_of_packet(const WideScene& scene, Packet& packet) {
    const auto keep = [&](std::uint32_t lane, float t, std::uint32_t object) {
      Nearest nearest{packet.reach[lane], packet.object[lane]};
      nearest.keep(t, object);
      packet.reach[lane] = nearest.reach, packet.object[lane] = nearest.object;
    };
    const auto visit = [&](WideChild leaf, unsigned rays) {
      visit_leaf<Kind>(scene, packet, leaf, rays, keep);
    };
    const auto alone = [&](WideChild child, std::uint32_t lane) {
      Nearest nearest{packet.reach[lane], packet.object[lane]};
      closest_below<Kind>(scene, WideCoherent<Isa>{}, child, WidePacketRay<Isa>{packet, lane}, nearest);
      packet.reach[lane] = nearest.reach, packet.object[lane] = nearest.object;
    };
    walk_packet<Isa>(scene.tree, packet, visit, alone);
  }

  template <class Kind>
  [[gnu::flatten, gnu::noinline]] static void any_of_packet(const WideScene& scene, Packet& packet) {
    const auto block = [&](std::uint32_t lane, float, std::uint32_t) { packet.reach[lane] = kBlocked; };
    const auto visit = [&](WideChild leaf, unsigned rays) {
      visit_leaf<Kind>(scene, packet, leaf, rays, block);
    };
    const auto alone = [&](WideChild child, std::uint32_t lane) {
      if (any_below<Kind>(scene, WideCoherent<Isa>{}, child, WidePacketRay<Isa>{packet, lane},
                          packet.reach[lane]))
        packet.reach[lane] = kBlocked;
    };
    walk_packet<Isa>(scene.tree, packet, visit, alone);
  }

  /// Call found(lane, t, object) for what rays of a packet hit in a leaf.
  template <class Kind, class Found>
  static void visit_leaf(const WideScene& scene, const Packet& packet, WideChild leaf, unsigned rays,
                         const Found& found) {
    const std::uint32_t count = leaf.count();
    const float* const rows = scene.triangles.leaf(leaf);
    const WidePacketTest<Isa> test(rows, count);
    for (std::uint32_t i = 0; i < count; ++i) {
      if (Kind::kOthers && std::isnan(rows[i])) {
        for (unsigned bits = rays; bits != 0; bits &= bits - 1) {
          const auto lane = static_cast<std::uint32_t>(std::countr_zero(bits));
          const WidePacketRay<Isa> ray{packet, lane};
          const float t = other_hit_distance(scene, leaf.first() + i, ray.begun(), packet.reach[lane]);
          if (t <= packet.reach[lane]) found(lane, t, scene.order[leaf.first() + i]);
        }
        continue;
      }
      const unsigned possible = rays & test.may_hit(packet, i);
      if (possible != 0)
        test.hits(packet, i, possible,
                  [&](std::uint32_t lane, float t) { found(lane, t, number_of(rows, count, i)); });
    }
  }

  // One bit for each object from number `first` on among the `count` of a leaf: for all, and for what is no triangle.
  static unsigned in_use(std::uint32_t count, std::uint32_t first) {
    const std::uint32_t left = count - first;
    return left < Isa::kObjects ? (1u << left) - 1 : (1u << Isa::kObjects) - 1;
  }
  static unsigned no_triangles(const float* leaf, std::uint32_t count, std::uint32_t first) {
    return Isa::no_numbers(Isa::load(leaf + first)) & in_use(count, first);
  }
  /// The place in the order of the object that the lowest of the bits stands for.
  static std::uint32_t place_of(WideChild leaf, std::uint32_t first, unsigned bits) {
    return leaf.first() + first + static_cast<std::uint32_t>(std::countr_zero(bits));
  }
  /// What an object of a leaf is called.
  static std::uint32_t number_of(const float* leaf, std::uint32_t count, std::uint32_t which) {
    return std::bit_cast<std::uint32_t>(leaf[9 * count + which]);
  }
};

}  // namespace rayshoot
