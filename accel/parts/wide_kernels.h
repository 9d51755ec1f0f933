#pragma once

#include <immintrin.h>

#include <bit>

#include "accel/core/counters.h"
#include "accel/parts/pair_tree.h"
#include "accel/parts/wide_triangles.h"

namespace rayshoot {

/// What a kernel searches.
struct WideScene {
  const WideTree<float>& tree;
  const WideTriangles& triangles;
  /// For the tests of what is no triangle; and the objects in the order of the tree.
  const Geometry<float>& geometry;
  std::span<const std::uint32_t> order;
};

/// The queries of bvh_wide for triangles and `Intersector::fast`, in the instructions of one kind of processor.
struct WideKernels {
  const char* instructions;
  void (*closest)(const WideScene& scene, std::span<const Ray<float>> rays, std::span<Hit<float>> hits);
  void (*any)(const WideScene& scene, std::span<const Ray<float>> rays, std::span<std::uint8_t> blocked);
};

/// `hit_distance` of an object that is no triangle, by its place in the order: not to be mixed into the searches.
float other_hit_distance(const WideScene& scene, std::uint32_t place, Ray<float> ray, float reach);

extern const WideKernels kWideKernelsAvx2;
extern const WideKernels kWideKernelsAvx512;
/// Whether this processor has what `kWideKernelsAvx512` needs.
bool has_avx512();

}  // namespace rayshoot
