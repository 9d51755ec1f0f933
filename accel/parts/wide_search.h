#pragma once

#include "accel/parts/wide_kernels.h"
#include "accel/parts/wide_triangle_test.h"
#include "accel/parts/wide_walk.h"

// Read where code for a kind of processor begins: all that is not included is a template over its instructions.

namespace rayshoot {

/// The searches of WideKernels.
template <class Isa>
struct WideSearch {
  static void closest_of_all(const WideScene& scene, std::span<const Ray<float>> rays, std::span<Hit<float>> hits) {
    if (scene.triangles.has_others())
      for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = closest<true>(scene, rays[i]);
    else
      for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = closest<false>(scene, rays[i]);
  }
  static void any_of_all(const WideScene& scene, std::span<const Ray<float>> rays, std::span<std::uint8_t> blocked) {
    if (scene.triangles.has_others())
      for (std::size_t i = 0; i < rays.size(); ++i) blocked[i] = any<true>(scene, rays[i]);
    else
      for (std::size_t i = 0; i < rays.size(); ++i) blocked[i] = any<false>(scene, rays[i]);
  }

 private:
  /// The ray as `begun` makes it, without a call.
  static Ray<float> started(Ray<float> ray) {
    ray.t_min = ray.t_min > 0 ? ray.t_min : 0;
    return ray;
  }

  template <bool kOthers>
  [[gnu::flatten, gnu::noinline]] static Hit<float> closest(const WideScene& scene, const Ray<float>& given) {
    const Ray<float> ray = started(given);
    Hit<float> hit;
    if (scene.tree.empty() || !can_hit(ray)) return hit;
    const Crossings<float> prepared(ray);
    const WideCrossings<Isa, float> crossings(ray, prepared);
    const WideTriangleTest<Isa> test(ray, prepared);
    float reach = ray.t_max;
    const auto keep = [&](float t, std::uint32_t object) {
      if (t > reach || (t == hit.t && object > hit.object)) return;
      hit = {t, object}, reach = t;
    };
    walk_wide<Isa>(
        scene.tree, crossings, NoCount{}, [&] { return reach; },
        [&](WideChild leaf) {
          const std::uint32_t count = leaf.count();
          const float* const rows = scene.triangles.leaf(leaf);
          for (std::uint32_t first = 0; first < count; first += Isa::kObjects) {
            const auto found = test(rows, count, first, reach);
            for (unsigned bits = found.bits; bits != 0; bits &= bits - 1) {
              const auto lane = static_cast<std::uint32_t>(std::countr_zero(bits));
              float t[Isa::kObjects];
              std::memcpy(t, &found.t, sizeof t);
              keep(t[lane], std::bit_cast<std::uint32_t>(rows[9 * count + first + lane]));
            }
            if constexpr (kOthers)
              for (unsigned bits = others(rows, count, first); bits != 0; bits &= bits - 1) {
                const std::uint32_t object = leaf.first() + first + static_cast<std::uint32_t>(std::countr_zero(bits));
                const float t = other_hit_distance(scene, object, ray, reach);
                if (t <= reach) keep(t, scene.order[object]);
              }
          }
          return false;
        });
    return hit;
  }

  template <bool kOthers>
  [[gnu::flatten, gnu::noinline]] static bool any(const WideScene& scene, const Ray<float>& given) {
    const Ray<float> ray = started(given);
    bool blocked = false;
    if (scene.tree.empty() || !can_hit(ray)) return blocked;
    const Crossings<float> prepared(ray);
    const WideCrossings<Isa, float> crossings(ray, prepared);
    const WideTriangleTest<Isa> test(ray, prepared);
    walk_wide_unordered<Isa>(
        scene.tree, crossings, NoCount{}, ray.t_max,
        [&](WideChild leaf) {
          const std::uint32_t count = leaf.count();
          const float* const rows = scene.triangles.leaf(leaf);
          for (std::uint32_t first = 0; first < count; first += Isa::kObjects) {
            if (test(rows, count, first, ray.t_max).bits != 0) return blocked = true;
            if constexpr (kOthers)
              for (unsigned bits = others(rows, count, first); bits != 0; bits &= bits - 1) {
                const std::uint32_t object = leaf.first() + first + static_cast<std::uint32_t>(std::countr_zero(bits));
                if (other_hit_distance(scene, object, ray, ray.t_max) <= ray.t_max) return blocked = true;
              }
          }
          return false;
        });
    return blocked;
  }

  /// One bit for each object from number `first` on among the `count` of a leaf that is no triangle.
  static unsigned others(const float* leaf, std::uint32_t count, std::uint32_t first) {
    const std::uint32_t left = count - first;
    return Isa::no_numbers(Isa::load(leaf + first)) & (left < Isa::kObjects ? (1u << left) - 1 : (1u << Isa::kObjects) - 1);
  }
};

}  // namespace rayshoot
