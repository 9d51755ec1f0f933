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
    const WideRay<Isa> ray(given);
    if (scene.tree.empty() || !ray.can_hit) return hit;
    float reach = ray.begun.t_max;
    const auto keep = [&](float t, std::uint32_t object) {
      if (t > reach || (t == hit.t && object > hit.object)) return;
      hit = {t, object}, reach = t;
    };

    const WideTriangleTest<Isa> test(ray);
    const auto visit = [&](WideChild leaf) {
      const std::uint32_t count = leaf.count();
      const float* const rows = scene.triangles.leaf(leaf);
      for (std::uint32_t first = 0; first < count; first += Isa::kObjects) {
        // Test the triangles of the leaf at once, then one by one what else is in it.
        const unsigned others = kOthers ? no_triangles(rows, count, first) : 0;
        if (others != in_use(count, first)) {
          const auto found = test(rows, count, first, reach);
          float t[Isa::kObjects];
          if (found.bits != 0) std::memcpy(t, &found.t, sizeof t);
          for (unsigned bits = found.bits; bits != 0; bits &= bits - 1) {
            const auto lane = static_cast<std::uint32_t>(std::countr_zero(bits));
            keep(t[lane], std::bit_cast<std::uint32_t>(rows[9 * count + first + lane]));
          }
        }
        for (unsigned bits = others; bits != 0; bits &= bits - 1) {
          const std::uint32_t place = place_of(leaf, first, bits);
          const float t = other_hit_distance(scene, place, ray.begun, reach);
          if (t <= reach) keep(t, scene.order[place]);
        }
      }
      return false;
    };
    const WideCrossings<Isa, float> crossings(ray);
    walk_wide<Isa>(
        scene.tree, crossings, NoCount{}, [&] { return reach; }, manner, visit);
    return hit;
  }

  template <bool kOthers, class Manner>
  [[gnu::flatten, gnu::noinline]] static bool any(const WideScene& scene, const Manner& manner,
                                                  const Ray<float>& given) {
    bool blocked = false;
    const WideRay<Isa> ray(given);
    if (scene.tree.empty() || !ray.can_hit) return blocked;
    const float reach = ray.begun.t_max;

    const WideTriangleTest<Isa> test(ray);
    const auto visit = [&](WideChild leaf) {
      const std::uint32_t count = leaf.count();
      const float* const rows = scene.triangles.leaf(leaf);
      for (std::uint32_t first = 0; first < count; first += Isa::kObjects) {
        const unsigned others = kOthers ? no_triangles(rows, count, first) : 0;
        if (others != in_use(count, first) && test(rows, count, first, reach).bits != 0)
          return blocked = true;
        for (unsigned bits = others; bits != 0; bits &= bits - 1)
          if (other_hit_distance(scene, place_of(leaf, first, bits), ray.begun, reach) <= reach)
            return blocked = true;
      }
      return false;
    };
    const WideCrossings<Isa, float> crossings(ray);
    walk_wide_unordered<Isa>(scene.tree, crossings, NoCount{}, reach, manner, visit);
    return blocked;
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
};

}  // namespace rayshoot
