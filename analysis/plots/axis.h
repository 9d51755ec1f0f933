#pragma once

#include <span>
#include <string>
#include <vector>

namespace rayshoot::analysis {

enum class Scale { linear, logarithmic };

/// A range of values and where they lie on a line.
class Axis {
 public:
  /// Covers the values with some room around them, to whole decades or steps where those are near. Logarithmic axes
  /// leave values of 0 or less out, and linear ones begin at 0.
  Axis(Scale scale, std::span<const double> values, std::string title);

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
  Scale scale_;
  double low_ = 0, high_ = 1;
  std::string title_;
};

}  // namespace rayshoot::analysis
