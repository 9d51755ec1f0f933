#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "harness/verify/exact_oracle.h"

namespace rayshoot {

/// How often which error occurred, in bins a sixteenth of an octave wide; the first bin is that of no error. Of fixed
/// size, so that it can be shared between processes.
class ErrorHistogram {
 public:
  void add(double error) {
    ++bins_[bin(error)];
    ++count_;
    max_ = std::max(max_, error);
  }

  std::uint64_t count() const { return count_; }
  double max() const { return max_; }

  /// The error that a fraction of all does not exceed, rounded up to the edge of its bin: at most 4.5 % too large.
  double quantile(double fraction) const {
    std::uint64_t below = 0;
    for (int i = 0; i < kBins; ++i) {
      below += bins_[i];
      if (static_cast<double>(below) >= fraction * static_cast<double>(count_))
        return std::min(upper_edge(i), max_);
    }
    return max_;
  }

 private:
  static constexpr int kBinsAnOctave = 16, kOctavesBelowOne = 10, kBins = 1 + kBinsAnOctave * 80;

  static int bin(double error) {
    if (!(error > 0)) return 0;
    const double octaves = std::log2(error) + kOctavesBelowOne;
    return 1 + static_cast<int>(std::clamp(octaves * kBinsAnOctave, 0.0, kBins - 2.0));
  }
  static double upper_edge(int bin) {
    return bin == 0 ? 0 : std::exp2(static_cast<double>(bin) / kBinsAnOctave - kOctavesBelowOne);
  }

  std::array<std::uint64_t, kBins> bins_{};
  std::uint64_t count_ = 0;
  double max_ = 0;
};

/// Grades of many answers. Of fixed size and without pointers.
struct Grades {
  std::uint64_t graded = 0;
  std::array<std::uint64_t, kAnswerClassNames.size()> answers{};
  /// Of the answers that are hits.
  ErrorHistogram ulps_of_t, ulps_of_point;

  void add(const Grade& grade, bool hit) {
    ++graded;
    ++(*this)[grade.answer];
    if (!hit) return;
    ulps_of_t.add(grade.ulps_of_t);
    ulps_of_point.add(grade.ulps_of_point);
  }
  std::uint64_t& operator[](AnswerClass answer) { return answers[static_cast<std::size_t>(answer)]; }
};

}  // namespace rayshoot
