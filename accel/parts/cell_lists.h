#pragma once

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "accel/parts/for_each_below.h"

namespace rayshoot {

/// For every cell the objects it refers to, in increasing order, in an array of all cells: 4 bytes a cell and
/// 4 a reference. Neither this nor the next class holds more than 2^32 - 1 references. Both ask for the cells
/// of an object twice, from several threads: `for_each_cell(object, visit)` calls visit(cell) once for each.
class CellLists {
 public:
  CellLists() = default;

  template <class ForEachCell>
  CellLists(std::uint64_t cells, std::uint32_t objects, const ForEachCell& for_each_cell)
      : first_(cells + 1, 0) {
    // Count the references of every cell; their running sum says where each list ends.
    for_each_below(objects, [&](std::uint32_t object) {
      for_each_cell(object, [&](std::uint64_t cell) { shared_first(cell).fetch_add(1, kRelaxed); });
    });
    std::inclusive_scan(first_.begin(), first_.end(), first_.begin());
    references_.resize(first_.back());

    // Fill every list from its end, after which the array says where each begins.
    for_each_below(objects, [&](std::uint32_t object) {
      for_each_cell(object, [&](std::uint64_t cell) {
        references_[shared_first(cell).fetch_sub(1, kRelaxed) - 1] = object;
      });
    });

    // Sort them, since threads came as they liked.
    for_each_below(cells, [&](std::uint64_t cell) {
      std::sort(references_.data() + first_[cell], references_.data() + first_[cell + 1]);
    });
  }

  std::span<const std::uint32_t> objects(std::uint64_t cell) const {
    return {references_.data() + first_[cell], references_.data() + first_[cell + 1]};
  }

  /// Give the references other numbers: `names[i]` for i. The numbers increase.
  void renumber(std::span<const std::uint32_t> names) {
    for (std::uint32_t& reference : references_) reference = names[reference];
  }

  /// Shorten lists, from the first cell on: `shorten(cell, list)` changes the list in place, or not, and returns how many
  /// of its references remain.
  template <class Shorten>
  void shorten_lists(const Shorten& shorten) {
    std::uint32_t begin = 0, kept = 0;
    for (std::size_t cell = 0; cell + 1 < first_.size(); ++cell) {
      const std::uint32_t end = first_[cell + 1];
      const std::span<std::uint32_t> list(references_.data() + begin, references_.data() + end);
      const auto length = static_cast<std::uint32_t>(shorten(cell, list));
      std::copy_n(list.begin(), length, references_.begin() + kept);
      first_[cell] = kept;
      kept += length, begin = end;
    }
    if (!first_.empty()) first_.back() = kept;
    references_.resize(kept);
    references_.shrink_to_fit();
  }

  /// Call visit(cell, objects) for each cell that refers to something.
  template <class Visit>
  void for_each_list(const Visit& visit) const {
    for (std::uint64_t cell = 0; cell + 1 < first_.size(); ++cell)
      if (first_[cell] < first_[cell + 1]) visit(cell, objects(cell));
  }

  /// The references of all cells, one cell after the other.
  std::span<const std::uint32_t> all() const { return references_; }
  std::uint64_t references() const { return references_.size(); }
  /// Number of cells that refer to something.
  std::uint64_t occupied() const {
    std::uint64_t count = 0;
    for (std::size_t cell = 0; cell + 1 < first_.size(); ++cell) count += first_[cell] < first_[cell + 1];
    return count;
  }
  std::size_t bytes() const { return (first_.size() + references_.size()) * sizeof(std::uint32_t); }
  /// What `cells` cells with that many references occupy, also while they are built.
  static double bytes_needed(double cells, double references) { return 4 * (cells + references); }

 private:
  static constexpr auto kRelaxed = std::memory_order_relaxed;
  std::atomic_ref<std::uint32_t> shared_first(std::uint64_t cell) {
    return std::atomic_ref<std::uint32_t>(first_[cell]);
  }

  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> references_;
};

/// The same for the cells alone that refer to something, in a hash table: an empty cell costs no memory, a
/// look-up of any a probe (Glassner 1984; Cleary & Wyvill 1988).
class HashedCellLists {
 public:
  HashedCellLists() = default;

  template <class ForEachCell>
  HashedCellLists(std::uint32_t objects, const ForEachCell& for_each_cell) {
    const std::vector<Reference> sorted = sorted_references(objects, for_each_cell);
    references_.reserve(sorted.size());
    for (const Reference& reference : sorted) {
      occupied_ += references_.empty() || reference.cell != sorted[references_.size() - 1].cell;
      references_.push_back(reference.object);
    }
    if (sorted.empty()) return;

    // Enter every cell with its run of references; the table stays at most half full.
    slots_.resize(std::bit_ceil(2 * occupied_));
    shift_ = 64 - std::countr_zero(slots_.size());
    for (std::size_t first = 0, last = 0; first < sorted.size(); first = last) {
      while (last < sorted.size() && sorted[last].cell == sorted[first].cell) ++last;
      slots_[slot_of(sorted[first].cell)] = {sorted[first].cell, static_cast<std::uint32_t>(first),
                                             static_cast<std::uint32_t>(last)};
    }
  }

  std::span<const std::uint32_t> objects(std::uint64_t cell) const {
    const Slot& slot = slots_[slot_of(cell)];
    return {references_.data() + slot.first, references_.data() + slot.last};
  }

  /// Call visit(cell, objects) for each cell that refers to something.
  template <class Visit>
  void for_each_list(const Visit& visit) const {
    for (const Slot& slot : slots_)
      if (slot.first < slot.last) visit(slot.cell, objects(slot.cell));
  }

  std::uint64_t references() const { return references_.size(); }
  std::uint64_t occupied() const { return occupied_; }
  std::size_t bytes() const {
    return slots_.size() * sizeof(Slot) + references_.size() * sizeof(std::uint32_t);
  }
  /// What that many references occupy at the most while they are built.
  static double bytes_needed(double references) {
    return references * (sizeof(Reference) + sizeof(std::uint32_t) + 4 * sizeof(Slot));
  }

 private:
  /// A free slot has an empty run.
  struct Slot {
    std::uint64_t cell = 0;
    std::uint32_t first = 0, last = 0;
  };
  struct Reference {
    std::uint64_t cell;
    std::uint32_t object;
    auto operator<=>(const Reference&) const = default;
  };

  /// All references by cell, those of a cell by object.
  template <class ForEachCell>
  static std::vector<Reference> sorted_references(std::uint32_t objects, const ForEachCell& for_each_cell) {
    std::vector<std::size_t> end(objects, 0);
    for_each_below(
        objects, [&](std::uint32_t object) { for_each_cell(object, [&](std::uint64_t) { ++end[object]; }); });
    std::inclusive_scan(end.begin(), end.end(), end.begin());
    std::vector<Reference> references(objects == 0 ? 0 : end.back());
    for_each_below(objects, [&](std::uint32_t object) {
      for_each_cell(object, [&](std::uint64_t cell) { references[--end[object]] = {cell, object}; });
    });
    tbb::parallel_sort(references);
    return references;
  }

  /// The slot of a cell, or the free one in which its search ends (multiplicative hashing, linear probing).
  std::size_t slot_of(std::uint64_t cell) const {
    std::size_t slot = (cell * 0x9E3779B97F4A7C15ull) >> shift_;
    while (slots_[slot].cell != cell && slots_[slot].first < slots_[slot].last)
      slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }

  std::vector<Slot> slots_;
  std::vector<std::uint32_t> references_;
  std::uint64_t occupied_ = 0;
  int shift_ = 0;
};

}  // namespace rayshoot
