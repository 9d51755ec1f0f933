#pragma once

#include <span>
#include <vector>

#include "scenes/geometry/ray.h"

namespace rayshoot {

/// An order of rays in which neighbours start near one another and go much the same way, so that what one has fetched the
/// next finds in the cache. Keeps its memory from batch to batch.
class RayOrder {
 public:
  /// The numbers of the rays, sorted by the cell of `bounds` that they start in or come into, along a Morton curve, and there by
  /// the direction that they take; behind them those that miss the bounds. Rays may be anything, also no numbers.
  std::span<const std::uint32_t> sorted(std::span<const Ray<float>> rays, const Box<float>& bounds);

 private:
  struct Keyed {
    std::uint32_t key, ray;
  };
  void sort_by(int first_bit);

  std::vector<Keyed> keyed_, other_;
  std::vector<std::uint32_t> order_;
};

}  // namespace rayshoot
