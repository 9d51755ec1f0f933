#pragma once

#include <functional>
#include <vector>

namespace rayshoot {

/// Something to time, again and again.
struct TimedPass {
  std::function<void()> pass;
  /// Called after each pass, off the clock.
  std::function<void()> tidy_up;
  int repetitions = 1;
  /// Passes shorter than this are repeated within a repetition, of which the mean is taken, and warmed up
  /// before; 0 times single passes as they come.
  double min_seconds = 0;
};

/// Time all of them by Google Benchmark, their repetitions interleaved at random. Returns nanoseconds a pass,
/// one entry a repetition, for each of `passes`. Once `stopped` returns true, remaining repetitions are left
/// out.
std::vector<std::vector<double>> time_interleaved(const std::vector<TimedPass>& passes,
                                                  const std::function<bool()>& stopped);

}  // namespace rayshoot
