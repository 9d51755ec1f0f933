#pragma once

#include <array>
#include <span>
#include <utility>
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
  static constexpr int kDigitBits = 8, kDigits = 3;
  static std::uint32_t digit(std::uint32_t key, int which) {
    return key >> which * kDigitBits & ((1u << kDigitBits) - 1);
  }

  void add(std::size_t place, const Keyed& ray) {
    keyed_[place] = ray;
    for (int which = 0; which < kDigits; ++which) ++counts_[which][digit(ray.key, which)];
  }
  /// Call put(place, ray) with the place of each ray by one digit.
  template <class Put>
  void sort_by(int which, const Keyed* rays, std::size_t count, const Put& put) {
    std::array<std::uint32_t, 1 << kDigitBits>& places = counts_[which];
    std::uint32_t before = 0;
    for (std::uint32_t& place : places) before += std::exchange(place, before);
    for (std::size_t i = 0; i < count; ++i) put(places[digit(rays[i].key, which)]++, rays[i]);
  }

  std::vector<Keyed> keyed_, other_;
  std::vector<std::uint32_t> order_;
  std::array<std::array<std::uint32_t, 1 << kDigitBits>, kDigits> counts_;
};

}  // namespace rayshoot
