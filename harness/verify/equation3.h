#pragma once

#include <string>
#include <vector>

#include "accel/core/batch.h"

namespace rayshoot {

/// Equation (3) held against a measurement: over uniformly distributed lines that hit the root volume, and
/// without stopping at hits, the mean number of tests must be what the surface areas say.
struct Equation3Check {
  /// "object_tests" or "volume_tests".
  std::string quantity;
  double predicted = 0;
  double measured = 0;
  /// 95 % confidence interval of the measured mean.
  double ci_low = 0, ci_high = 0;
  /// Lines that hit the root volume.
  std::uint64_t rays = 0;

  bool holds() const { return ci_low <= predicted && predicted <= ci_high; }
};

/// Check both quantities for an engine with a prediction, with lines from the distribution `chords`. An empty
/// scene has nothing to check. Throws InputError for an engine that predicts nothing or cannot be counted.
template <class Real>
std::vector<Equation3Check> check_equation_3(const Engine<Real>& engine, std::span<const Ray<Real>> chords,
                                             int threads);

extern template std::vector<Equation3Check> check_equation_3(const Engine<float>&,
                                                             std::span<const Ray<float>>, int);
extern template std::vector<Equation3Check> check_equation_3(const Engine<double>&,
                                                             std::span<const Ray<double>>, int);

}  // namespace rayshoot
