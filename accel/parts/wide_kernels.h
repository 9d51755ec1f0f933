#pragma once

#include <immintrin.h>

#include <bit>
#include <optional>

#include "accel/core/counters.h"
#include "accel/parts/pair_tree.h"
#include "accel/parts/surface_margin.h"
#include "accel/parts/wide_triangles.h"

namespace rayshoot {

/// What boxes must grow by for a ray, as a number that leaves boxes without objects empty.
template <class Real>
Real box_margin(const SurfaceMargin<Real>& margin, const Ray<Real>& ray) {
  return std::min(margin.of_ray(ray), std::numeric_limits<Real>::max() / 4);
}

/// What a kernel searches.
struct WideScene {
  const WideTree<float>& tree;
  const WideTriangles& triangles;
  /// For the tests of what is no triangle; and the objects in the order of the tree.
  const Geometry<float>& geometry;
  std::span<const std::uint32_t> order;
  /// By how much boxes must grow for some rays, where slivers were cut.
  const std::optional<SurfaceMargin<float>>& margin;

  template <class OneRay>
  float margin_of(const OneRay& ray) const {
    return margin ? box_margin(*margin, ray.begun()) : 0;
  }
};

/// Whether successive rays take much the same way: looked at in 64 places, the directions of most neighbours differ by less than
/// a tenth of their length.
bool are_coherent(std::span<const Ray<float>> rays);

/// Rays, the order in which they are traced (none to trace them as they stand), whether those that follow one another so are
/// alike, and whether neighbours are searched together for their nearest hits, which is for coherent rays as they stand.
struct WideBatch {
  std::span<const Ray<float>> rays;
  std::span<const std::uint32_t> order{};
  bool coherent = false;
  bool in_packets = false;

  /// Call trace(ray) with the number of each ray in turn.
  template <class Trace>
  void for_each(const Trace& trace) const {
    if (order.empty())
      for (std::size_t ray = 0; ray < rays.size(); ++ray) trace(ray);
    for (std::size_t i = 0; i < order.size(); ++i) {
      __builtin_prefetch(&rays[order[std::min(i + 8, order.size() - 1)]]);
      trace(order[i]);
    }
  }
};

/// The queries of bvh_wide for triangles and `Intersector::fast`, in the instructions of one kind of processor.
struct WideKernels {
  const char* instructions;
  void (*closest)(const WideScene& scene, const WideBatch& batch, std::span<Hit<float>> hits);
  void (*any)(const WideScene& scene, const WideBatch& batch, std::span<std::uint8_t> blocked);
};

/// `hit_distance` of an object that is no triangle, by its place in the order: not to be mixed into the searches.
float other_hit_distance(const WideScene& scene, std::uint32_t place, Ray<float> ray, float reach);

extern const WideKernels kWideKernelsAvx2;
extern const WideKernels kWideKernelsAvx512;
/// Whether this processor has what `kWideKernelsAvx512` needs.
bool has_avx512();

}  // namespace rayshoot
