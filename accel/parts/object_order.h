#pragma once

#include <cstdint>
#include <vector>

#include "scenes/core/huge_pages.h"

namespace rayshoot {

/// Objects in the order of the lists that name them: an object stands once for every list that names it, so that those of
/// a list lie in memory side by side and a list is a range of positions. Objects that no list names stand at last.
inline HugeVector<std::uint32_t> side_by_side(HugeVector<std::uint32_t> references, std::uint32_t objects) {
  std::vector<bool> listed(objects);
  for (const std::uint32_t object : references) listed[object] = true;
  for (std::uint32_t object = 0; object < objects; ++object)
    if (!listed[object]) references.push_back(object);
  return references;
}

}  // namespace rayshoot
