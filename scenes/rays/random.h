#pragma once

#include <cstdint>

namespace rayshoot {

/// Uniform random numbers addressed by (seed, index, dimension): no state, so that ray number i is the same
/// whichever thread makes it and however many rays there are. SplitMix64's finalizer (Steele et al. 2014) is
/// applied to each coordinate of the address in turn.
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : key_(scramble(seed)) {}

  std::uint64_t bits(std::uint64_t index, std::uint64_t dimension) const {
    return scramble(scramble(key_ ^ index) ^ dimension);
  }
  /// A number in [0, 1), a multiple of 2^-53.
  double uniform(std::uint64_t index, std::uint64_t dimension) const {
    return static_cast<double>(bits(index, dimension) >> 11) * 0x1p-53;
  }

 private:
  static std::uint64_t scramble(std::uint64_t x) {
    x += 0x9E3779B97F4A7C15ull;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
    return x ^ (x >> 31);
  }

  std::uint64_t key_;
};

}  // namespace rayshoot
