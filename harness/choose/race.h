#pragma once

#include <functional>
#include <vector>

#include "harness/verify/answers.h"

namespace rayshoot {

/// Time engines on the rays of a sample, in turns. Nanoseconds a ray, one entry a round, for each of them.
template <class Real>
std::vector<std::vector<double>> race(const std::vector<const Engine<Real>*>& engines,
                                      const Batch<Real>& sample, int threads,
                                      const std::function<bool()>& stopped);

}  // namespace rayshoot
