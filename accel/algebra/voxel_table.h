#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace rayshoot {

/// What stands in a voxel of the first part of a composition.
struct InVoxel {
  static constexpr std::uint32_t kNone = UINT32_MAX;

  /// The part of the list of all names that is its objects.
  std::uint32_t first = 0, count = 0;
  /// Where they are divided again.
  std::uint32_t sub_scene = kNone;

  bool divided() const { return sub_scene != kNone; }
};

/// What stands in voxels, by their keys: one look into memory for most, since a ray asks for every voxel that it meets.
class VoxelTable {
 public:
  /// For so many voxels.
  explicit VoxelTable(std::size_t voxels = 0)
      : slots_(std::bit_ceil(2 * voxels + 2)), shift_(64 - std::countr_zero(slots_.size())) {}

  void add(const void* key, const InVoxel& content) { slots_[place_of(key)] = {key, content}; }
  /// Of a voxel that was added.
  const InVoxel& operator[](const void* key) const { return slots_[place_of(key)].content; }

  std::size_t bytes() const { return slots_.size() * sizeof(Slot); }

 private:
  struct Slot {
    const void* key = nullptr;
    InVoxel content;
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
