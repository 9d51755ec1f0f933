#pragma once

namespace rayshoot {

/// Keeps the compiler from turning the branch it stands in into a conditional move. Where a traversal decides
/// which child to enter, a predicted branch lets the processor fetch that child before the volume tests are
/// done.
[[gnu::always_inline]] inline void keep_branch() { asm volatile(""); }

}  // namespace rayshoot
