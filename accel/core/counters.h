#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace rayshoot {

/// A technique may count up to so many kinds of events of its own.
inline constexpr std::size_t kMostEventKinds = 8;

/// What one query did, or many summed. All counts are exact and deterministic.
struct Work {
  std::uint64_t rays = 0;
  std::uint64_t object_tests = 0;      ///< ray-object tests, repeated ones included
  std::uint64_t distinct_objects = 0;  ///< objects tested at least once, summed over rays: Card(A(r, s))
  std::uint64_t volume_tests = 0;      ///< ray-bounding-volume tests
  std::uint64_t steps = 0;             ///< traversal steps from one cell or node to another
  std::uint64_t cells = 0;             ///< leaf cells visited
  std::uint64_t empty_cells = 0;       ///< of these, cells without objects
  std::uint64_t mailbox_hits = 0;      ///< tests avoided because the ray had met the object before
  /// Events that only this technique knows, by position in `TechniqueInfo::events`.
  std::array<std::uint64_t, kMostEventKinds> events{};

  Work& operator+=(const Work& other);
  friend bool operator==(const Work&, const Work&) = default;
};

inline Work& Work::operator+=(const Work& other) {
  rays += other.rays, object_tests += other.object_tests, distinct_objects += other.distinct_objects;
  volume_tests += other.volume_tests, steps += other.steps, cells += other.cells;
  empty_cells += other.empty_cells, mailbox_hits += other.mailbox_hits;
  for (std::size_t kind = 0; kind < kMostEventKinds; ++kind) events[kind] += other.events[kind];
  return *this;
}

/// Counting policy of a counted traversal. Object tests are counted where they are made, in the queries.
class Count {
 public:
  explicit Count(Work& work) : work_(work) {}
  void volume_tests(std::uint64_t count = 1) const { work_.volume_tests += count; }
  void step() const { ++work_.steps; }
  void cell(bool empty) const { ++work_.cells, work_.empty_cells += empty; }
  void mailbox_hit() const { ++work_.mailbox_hits; }
  /// An event of the kind that stands at that position of `TechniqueInfo::events`.
  void event(std::size_t kind, std::uint64_t count = 1) const { work_.events[kind] += count; }
  /// What another traversal did within this one, but for its events.
  void traversal(const Work& work) const {
    work_.volume_tests += work.volume_tests, work_.steps += work.steps, work_.cells += work.cells;
    work_.empty_cells += work.empty_cells, work_.mailbox_hits += work.mailbox_hits;
  }

 private:
  Work& work_;
};

/// Counting policy of a timed traversal: not one instruction.
struct NoCount {
  static constexpr void volume_tests(std::uint64_t = 1) {}
  static constexpr void step() {}
  static constexpr void cell(bool) {}
  static constexpr void mailbox_hit() {}
  static constexpr void event(std::size_t, std::uint64_t = 1) {}
};

}  // namespace rayshoot
