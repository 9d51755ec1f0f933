#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace rayshoot {

/// Which sub-scene stands in a voxel, by the voxel's key: one look into memory for most.
class VoxelTable {
 public:
  /// For so many voxels.
  explicit VoxelTable(std::size_t voxels = 0)
      : slots_(std::bit_ceil(2 * voxels + 2)), shift_(64 - std::countr_zero(slots_.size())) {}

  void add(const void* key, std::uint32_t sub_scene) { slots_[place_of(key)] = {key, sub_scene}; }
  /// Of a voxel that was added.
  std::uint32_t operator[](const void* key) const { return slots_[place_of(key)].sub_scene; }

  std::size_t bytes() const { return slots_.size() * sizeof(Slot); }

 private:
  struct Slot {
    const void* key = nullptr;
    std::uint32_t sub_scene = 0;
  };

  /// Where the key stands, or the free place where it would.
  std::size_t place_of(const void* key) const {
    // Fibonacci hashing (Knuth, vol. 3, §6.4), then the next places.
    std::size_t place = reinterpret_cast<std::uintptr_t>(key) * 0x9E3779B97F4A7C15ull >> shift_;
    while (slots_[place].key && slots_[place].key != key) place = (place + 1) & (slots_.size() - 1);
    return place;
  }

  std::vector<Slot> slots_;
  int shift_;
};

}  // namespace rayshoot
