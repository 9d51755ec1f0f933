#pragma once

#include <sys/mman.h>

#include <cstdlib>
#include <new>
#include <utility>
#include <vector>

namespace rayshoot {

/// Allocates large arrays in huge pages where the system has them to give: a traversal that jumps through a hundred
/// megabytes waits for the translation of addresses otherwise. Elements begin on cache lines.
template <class T>
struct HugePages {
  using value_type = T;

  HugePages() = default;
  template <class Other>
  HugePages(const HugePages<Other>&) {}

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T), alignment = bytes >= kPage ? kPage : kCacheLine;
    void* const memory = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    if (!memory) throw std::bad_alloc();
    // A refusal costs nothing but time.
    if (alignment == kPage) madvise(memory, bytes, MADV_HUGEPAGE);
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) { std::free(memory); }
  /// Elements that nothing is said of hold what they initialise themselves: what is filled by all threads is not filled by one
  /// before.
  template <class Element, class... Given>
  void construct(Element* place, Given&&... given) {
    if constexpr (sizeof...(Given) == 0)
      ::new (static_cast<void*>(place)) Element;
    else
      ::new (static_cast<void*>(place)) Element(std::forward<Given>(given)...);
  }

  friend bool operator==(const HugePages&, const HugePages&) { return true; }

 private:
  static constexpr std::size_t kPage = std::size_t{1} << 21, kCacheLine = 64;
};

template <class T>
using HugeVector = std::vector<T, HugePages<T>>;

}  // namespace rayshoot
