#pragma once

#include "accel/parts/wide_kernels.h"
#include "accel/parts/wide_packet_test.h"
#include "accel/parts/wide_quad_test.h"
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
      batch.for_each([&](std::size_t i) { blocked[i] = any<Kind>(scene, manner, batch.rays[i]); });
    });
  }

 private:
  using Packet = WidePacket<Isa>;

  /// Whether a scene has others than triangles, and slivers that were cut.
  template <bool kHasOthers, bool kHasCut>
  struct KindOf {
    static constexpr bool kOthers = kHasOthers, kCut = kHasCut;
  };

  /// Call `search` with the kind of the scene, and in the manner that suits the rays.
  template <class Search>
  static void suited(const WideScene& scene, const WideBatch& batch, const Search& search) {
    const auto with_manner = [&](auto kind) {
      if (batch.coherent) return search(kind, WideCoherent<Isa>{});
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
      nearest = nearest_in_leaf<Kind>(scene, leaf, ray, nearest);
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
    const auto visit = [&](WideChild leaf) { return blocked = any_in_leaf<Kind>(scene, leaf, ray, reach); };
    const auto crossings = crossings_of<Kind>(scene, ray);
    walk_wide_unordered<Isa>(scene.tree, start, crossings, NoCount{}, reach, manner, visit);
    return blocked;
  }

  /// The nearest of a hit and those in a leaf.
  template <class Kind, class OneRay>
  static Nearest nearest_in_leaf(const WideScene& scene, WideChild leaf, const OneRay& ray, Nearest nearest) {
    const float* const rows = scene.triangles.leaf(leaf);
    unsigned others = 0;
    for (std::uint32_t first = 0; first < leaf.count(); first += Isa::kObjects)
      keep(hits_among<Kind>(leaf, first, rows, ray, nearest.reach, others), rows + 9 * leaf.count() + first,
           nearest);
    return others == 0 ? nearest : nearest_of_others(scene, leaf, others, ray, nearest);
  }

  template <class Kind, class OneRay>
  static bool any_in_leaf(const WideScene& scene, WideChild leaf, const OneRay& ray, float reach) {
    unsigned others = 0;
    for (std::uint32_t first = 0; first < leaf.count(); first += Isa::kObjects)
      if (hits_among<Kind>(leaf, first, scene.triangles.leaf(leaf), ray, reach, others).bits != 0)
        return true;
    return others != 0 && nearest_of_others(scene, leaf, others, ray, Nearest{reach}).object != kNoObject;
  }

  /// The hits with the triangles from number `first` on in a leaf. Sets one bit for each of the `others` there.
  template <class Kind, class OneRay>
  static WideDistances<Isa> hits_among(WideChild leaf, std::uint32_t first, const float* rows,
                                       const OneRay& ray, float reach, unsigned& others) {
    if constexpr (Kind::kOthers) {
      const unsigned in_use = wide_objects_in_use<Isa>(leaf.count(), first);
      const unsigned no_triangles = Isa::no_numbers(Isa::load(rows + first)) & in_use;
      others |= no_triangles << first;
      if (no_triangles == in_use) return WideDistances<Isa>{};
    }
    return hits_in_leaf<Isa>(ray, rows, leaf.count(), first, reach);
  }

  /// Keep the nearest of the hits with objects that are called so.
  static void keep(const WideDistances<Isa>& hits, const float* names, Nearest& nearest) {
    if (hits.bits == 0) return;
    float t[Isa::kObjects];
    std::memcpy(t, &hits.t, sizeof t);
    for (unsigned bits = hits.bits; bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(bits));
      nearest.keep(t[lane], WideOthers::as_number(names[lane]));
    }
  }

  /// The nearest of a hit and those with what a leaf holds beside triangles, one bit for each.
  template <class OneRay>
  static Nearest nearest_of_others(const WideScene& scene, WideChild leaf, unsigned others, const OneRay& ray,
                                   Nearest nearest) {
    if (const WideOthers::Leaf* some = scene.triangles.others(leaf, others)) {
      nearest = nearest_of_quads(scene.triangles.quads(*some), ray, nearest);
      others = some->loose;
    }
    for (unsigned bits = others; bits != 0; bits &= bits - 1) {
      const std::uint32_t place = leaf.first() + static_cast<std::uint32_t>(std::countr_zero(bits));
      const float t = other_hit_distance(scene, place, ray.begun(), nearest.reach);
      if (t <= nearest.reach) nearest.keep(t, scene.order[place]);
    }
    return nearest;
  }

  template <class OneRay>
  [[gnu::flatten, gnu::noinline]] static Nearest nearest_of_quads(const WideQuads& quads, const OneRay& ray,
                                                                  Nearest nearest) {
    const WideQuadTest<Isa, OneRay> test(ray, quads);
    for (std::uint32_t first = 0; first < quads.count; first += Isa::kObjects)
      keep(test.hits(first, nearest.reach), quads.names() + first, nearest);
    return nearest;
  }

  template <class Kind>
  [[gnu::flatten, gnu::noinline]] static void closest_of_packet(const WideScene& scene, Packet& packet) {
    const auto visit = [&](WideChild leaf, unsigned rays) { visit_leaf<Kind>(scene, packet, leaf, rays); };
    const auto alone = [&](WideChild child, std::uint32_t lane) {
      Nearest nearest = nearest_of(packet, lane);
      closest_below<Kind>(scene, WideCoherent<Isa>{}, child, WidePacketRay<Isa>{packet, lane}, nearest);
      set_nearest(packet, lane, nearest);
    };
    walk_packet<Isa>(scene.tree, packet, visit, alone);
  }

  static Nearest nearest_of(const Packet& packet, std::uint32_t lane) {
    return {packet.reach[lane], packet.object[lane]};
  }
  static void set_nearest(Packet& packet, std::uint32_t lane, const Nearest& nearest) {
    packet.reach[lane] = nearest.reach, packet.object[lane] = nearest.object;
  }

  /// Keep what rays of a packet hit in a leaf.
  template <class Kind>
  static void visit_leaf(const WideScene& scene, Packet& packet, WideChild leaf, unsigned rays) {
    const std::uint32_t count = leaf.count();
    const float* const rows = scene.triangles.leaf(leaf);
    const WidePacketTest<Isa> test(rows, count);
    unsigned others = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (Kind::kOthers && std::isnan(rows[i])) {
        others |= 1u << i;
        continue;
      }
      const unsigned possible = rays & test.may_hit(packet, i);
      if (possible == 0) continue;
      test.hits(packet, i, possible, [&](std::uint32_t lane, float t) {
        Nearest nearest = nearest_of(packet, lane);
        nearest.keep(t, WideOthers::as_number(rows[9 * count + i]));
        set_nearest(packet, lane, nearest);
      });
    }
    for (; others != 0 && rays != 0; rays &= rays - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(rays));
      set_nearest(
          packet, lane,
          nearest_of_others(scene, leaf, others, WidePacketRay<Isa>{packet, lane}, nearest_of(packet, lane)));
    }
  }
};

}  // namespace rayshoot
