#pragma once

#include <tbb/parallel_for.h>

namespace rayshoot {

/// Call visit(i) for all i below `count`, by several threads where that pays.
template <class Index, class Visit>
void for_each_below(Index count, const Visit& visit) {
  constexpr Index worth_sharing = 1024;
  if (count >= worth_sharing) return tbb::parallel_for(Index{0}, count, visit);
  for (Index i = 0; i < count; ++i) visit(i);
}

}  // namespace rayshoot
