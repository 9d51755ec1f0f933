#pragma once

#include <unistd.h>

namespace rayshoot {

/// The memory of this machine in bytes, to refuse what cannot fit before it is begun.
inline double physical_memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

}  // namespace rayshoot
