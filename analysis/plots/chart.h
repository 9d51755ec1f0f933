#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/plots/axis.h"
#include "analysis/plots/svg.h"

namespace rayshoot::analysis {

/// Width of a plot, in which its text is 12 high: so narrow that a telephone shows it in a readable size.
inline constexpr double kPlotWidth = 460;

/// Factors of error that bands around a line of equality show.
inline constexpr double kNear = 1.2, kFar = 2;

/// "Shaded: within 1.2 times (12 of 30) and within 2 times (28 of 30)." of pairs of values.
std::string bands_in_words(const std::vector<Point>& values);

/// A frame with two axes, grid lines and what is drawn into it.
class Chart {
 public:
  Chart(Axis x, Axis y, double height = 330);

  Point at(double x, double y) const;
  bool contains(double x, double y) const { return x_.contains(x) && y_.contains(y); }
  const Axis& x() const { return x_; }
  const Axis& y() const { return y_; }
  Svg& svg() { return svg_; }

  /// A marker, where the chart has a place for it.
  void point(Point value, MarkerStyle style, const std::string& tip);
  /// The line of equality, where it lies within both axes.
  void equality();
  /// The line, and around it what is off by at most `kNear` and `kFar` times, either way.
  void equality_with_bands();
  /// Steps through the points that no other lies left of and below, which must be sorted by x.
  void frontier(const std::vector<Point>& values, const std::string& style = "frontier");
  /// A name beside a point, where there is room for it: points and names so far are kept clear of. Whether there was.
  bool name(Point value, const std::string& text);
  void keep_clear(Point value);
  /// Names and markers in columns below the chart.
  void legend(const std::vector<std::pair<std::string, MarkerStyle>>& series);

 private:
  struct Box {
    double left, top, right, bottom;
    bool meets(const Box& other) const;
  };
  bool is_free(const Box& box) const;
  void draw_frame();
  void band(double factor);

  Axis x_, y_;
  Box area_;
  Svg svg_;
  std::vector<Box> taken_;
};

}  // namespace rayshoot::analysis
