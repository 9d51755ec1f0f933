#pragma once

#include "accel/parts/wide_kernels.h"
#include "accel/parts/wide_triangle_test.h"
#include "accel/parts/wide_walk.h"

// Read where code for a kind of processor begins: all that is not included is a template over its instructions.

namespace rayshoot {

/// The searches of WideKernels.
template <class Isa>
struct WideSearch {
  static void closest_of_all(const WideScene& scene, std::span<const Ray<float>> rays,
                             std::span<Hit<float>> hits) {
    suited(scene, rays, [&](auto others, const auto& manner) {
      for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = closest<others>(scene, manner, rays[i]);
    });
  }
  static void any_of_all(const WideScene& scene, std::span<const Ray<float>> rays,
                         std::span<std::uint8_t> blocked) {
    suited(scene, rays, [&](auto others, const auto& manner) {
      for (std::size_t i = 0; i < rays.size(); ++i) blocked[i] = any<others>(scene, manner, rays[i]);
    });
  }

 private:
  /// Call `search` with whether the scene has others than triangles, and in the manner that suits the rays.
  template <class Search>
  static void suited(const WideScene& scene, std::span<const Ray<float>> rays, const Search& search) {
    const auto with_manner = [&](auto others) {
      if (are_coherent(rays)) return search(others, WideCoherent<Isa>{});
      search(others, WideIncoherent<Isa, float>{scene.tree.nodes.data(), scene.triangles.begin(),
                                                WideTriangles::kBytes});
    };
    if (scene.triangles.has_others())
      with_manner(std::true_type{});
    else
      with_manner(std::false_type{});
  }

  /// Whether successive rays take much the same way: looked at in 64 places, the directions of most neighbours differ
  /// by less than a tenth of their length.
  static bool are_coherent(std::span<const Ray<float>> rays) {
    const std::size_t stride = std::max<std::size_t>(rays.size() / 64, 1);
    std::size_t pairs = 0, alike = 0;
    for (std::size_t i = 1; i < rays.size(); i += stride, ++pairs) {
      const Vec3<float>&a = rays[i - 1].direction, &b = rays[i].direction;
      alike += 100 * dot(a - b, a - b) < dot(a, a);
    }
    return 4 * alike > 3 * pairs;
  }

  template <bool kOthers, class Manner>
  [[gnu::flatten, gnu::noinline]] static Hit<float> closest(const WideScene& scene, const Manner& manner,
                                                            const Ray<float>& given) {
    Hit<float> hit;
    const WideRay<Isa> prepared(given);
    const Ray<float>& ray = prepared.begun;
    if (scene.tree.empty() || !prepared.can_hit) return hit;
    const WideCrossings<Isa, float> crossings(prepared);
    const WideTriangleTest<Isa> test(prepared);
    float reach = ray.t_max;
    const auto keep = [&](float t, std::uint32_t object) {
      if (t > reach || (t == hit.t && object > hit.object)) return;
      hit = {t, object}, reach = t;
    };
    walk_wide<Isa>(
        scene.tree, crossings, NoCount{}, [&] { return reach; }, manner,
        [&](WideChild leaf) {
          const std::uint32_t count = leaf.count();
          const float* const rows = scene.triangles.leaf(leaf);
          for (std::uint32_t first = 0; first < count; first += Isa::kObjects) {
            unsigned no_triangles = 0;
            if constexpr (kOthers) no_triangles = others(rows, count, first);
            if (kOthers && no_triangles == in_use(count, first)) [[unlikely]] {
              for (unsigned bits = no_triangles; bits != 0; bits &= bits - 1) {
                const std::uint32_t object =
                    leaf.first() + first + static_cast<std::uint32_t>(std::countr_zero(bits));
                const float t = other_hit_distance(scene, object, ray, reach);
                if (t <= reach) keep(t, scene.order[object]);
              }
              continue;
            }
            const auto found = test(rows, count, first, reach);
            for (unsigned bits = found.bits; bits != 0; bits &= bits - 1) {
              const auto lane = static_cast<std::uint32_t>(std::countr_zero(bits));
              float t[Isa::kObjects];
              std::memcpy(t, &found.t, sizeof t);
              keep(t[lane], std::bit_cast<std::uint32_t>(rows[9 * count + first + lane]));
            }
            if constexpr (kOthers)
              for (unsigned bits = no_triangles; bits != 0; bits &= bits - 1) {
                const std::uint32_t object =
                    leaf.first() + first + static_cast<std::uint32_t>(std::countr_zero(bits));
                const float t = other_hit_distance(scene, object, ray, reach);
                if (t <= reach) keep(t, scene.order[object]);
              }
          }
          return false;
        });
    return hit;
  }

  template <bool kOthers, class Manner>
  [[gnu::flatten, gnu::noinline]] static bool any(const WideScene& scene, const Manner& manner,
                                                  const Ray<float>& given) {
    bool blocked = false;
    const WideRay<Isa> prepared(given);
    const Ray<float>& ray = prepared.begun;
    if (scene.tree.empty() || !prepared.can_hit) return blocked;
    const WideCrossings<Isa, float> crossings(prepared);
    const WideTriangleTest<Isa> test(prepared);
    walk_wide_unordered<Isa>(scene.tree, crossings, NoCount{}, ray.t_max, manner, [&](WideChild leaf) {
      const std::uint32_t count = leaf.count();
      const float* const rows = scene.triangles.leaf(leaf);
      for (std::uint32_t first = 0; first < count; first += Isa::kObjects) {
        unsigned no_triangles = 0;
        if constexpr (kOthers) no_triangles = others(rows, count, first);
        if (!(kOthers && no_triangles == in_use(count, first)))
          if (test(rows, count, first, ray.t_max).bits != 0) return blocked = true;
        if constexpr (kOthers)
          for (unsigned bits = no_triangles; bits != 0; bits &= bits - 1) {
            const std::uint32_t object =
                leaf.first() + first + static_cast<std::uint32_t>(std::countr_zero(bits));
            if (other_hit_distance(scene, object, ray, ray.t_max) <= ray.t_max) return blocked = true;
          }
      }
      return false;
    });
    return blocked;
  }

  static unsigned in_use(std::uint32_t count, std::uint32_t first) {
    const std::uint32_t left = count - first;
    return left < Isa::kObjects ? (1u << left) - 1 : (1u << Isa::kObjects) - 1;
  }
  /// One bit for each object from number `first` on among the `count` of a leaf that is no triangle.
  static unsigned others(const float* leaf, std::uint32_t count, std::uint32_t first) {
    const std::uint32_t left = count - first;
    return Isa::no_numbers(Isa::load(leaf + first)) &
           (left < Isa::kObjects ? (1u << left) - 1 : (1u << Isa::kObjects) - 1);
  }
};

}  // namespace rayshoot
