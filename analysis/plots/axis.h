#pragma once

#include <span>
#include <string>
#include <vector>

namespace rayshoot::analysis {

/// A range of values above 0 and where their logarithms lie on a line.
class Axis {
 public:
  /// Covers the values with some room around them, as far as they lie between 10^-100 and 10^100: what does not has no
  /// place on paper.
  Axis(std::span<const double> values, std::string title);

  /// 0 at the low end, 1 at the high one.
  double position(double value) const;
  double low() const { return low_; }
  double high() const { return high_; }
  bool contains(double value) const { return value >= low_ && value <= high_; }
  const std::string& title() const { return title_; }

  struct Tick {
    double value;
    std::string label;
  };
  std::vector<Tick> ticks() const;

 private:
  double low_, high_;
  std::string title_;
};

}  // namespace rayshoot::analysis
