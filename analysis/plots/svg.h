#pragma once

#include <string>
#include <vector>

#include "analysis/plots/heat_scale.h"

/// A small writer of SVG. Colours are classes, which plot_style() gives a meaning to in light and in dark.
namespace rayshoot::analysis {

struct Point {
  double x = 0, y = 0;
};

/// Text that stands between tags or in an attribute: nothing in it is markup, and no character in it is forbidden.
std::string xml_escaped(const std::string& text);

/// The style sheet of all plots: colours that the colour-blind tell apart (Okabe & Ito 2008), light or dark as the reader
/// prefers.
const char* plot_style();

/// How the points of a series look: a colour and a shape, which together are different for 49 of them.
struct MarkerStyle {
  std::size_t colour = 0, shape = 0;
  explicit MarkerStyle(std::size_t series = 0) : colour(series % 7), shape(series / 7 % 7) {}
};

class Svg {
 public:
  Svg(double width, double height) : width_(width), height_(height) {}

  void line(Point from, Point to, const std::string& style);
  void polyline(const std::vector<Point>& points, const std::string& style);
  void polygon(const std::vector<Point>& corners, const std::string& style);
  /// `tip` is shown by browsers where the mouse rests; none when empty.
  void rectangle(Point corner, double width, double height, const std::string& style,
                 const std::string& tip = "");
  void marker(Point center, MarkerStyle style, const std::string& tip = "", bool large = false);
  /// Tiles in rows of so many, each of a colour that is the same in light and in dark.
  void tiles(Point corner, double tile_width, double tile_height, std::size_t columns,
             const std::vector<Colour>& colours);
  enum class Anchor { start, middle, end };
  void text(Point at, const std::string& text, Anchor anchor = Anchor::start, const std::string& style = "");
  /// Text that is read from below.
  void upright_text(Point at, const std::string& text, const std::string& style = "");

  double width() const { return width_; }
  double height() const { return height_; }
  void set_height(double height) { height_ = height; }

  /// An element for a page that has the style sheet. `title` is for those who do not see it.
  std::string element(const std::string& title) const;

 private:
  double width_, height_;
  std::string body_;
};

/// A file of its own, made of an element.
std::string svg_file(const std::string& element);

}  // namespace rayshoot::analysis
