#include "analysis/plots/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace rayshoot::analysis {

namespace {

constexpr double kMarker = 4.2, kLargeMarker = 5.5;
constexpr std::array kAnchors = {"start", "middle", "end"};

/// A coordinate to a tenth of a unit, in as few characters as say it.
std::string coordinate(double value) {
  const double rounded = std::round(10 * value) / 10;
  return fmt::format("{}", rounded == 0 ? 0 : rounded);
}

std::string path_of(const std::vector<Point>& points, bool closed) {
  std::string path;
  for (const Point& point : points)
    path += fmt::format("{}{} {}", path.empty() ? "M" : "L", coordinate(point.x), coordinate(point.y));
  return closed ? path + "Z" : path;
}

/// The corners of a regular polygon, the first one at an angle, in turns clockwise from the right.
std::vector<Point> polygon(Point center, double radius, int corners, double turn) {
  std::vector<Point> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * (turn + static_cast<double>(i) / corners);
    points.push_back({center.x + radius * std::cos(angle), center.y + radius * std::sin(angle)});
  }
  return points;
}

/// Two strokes across each other.
std::string cross(Point center, double radius, double turn) {
  const std::vector<Point> ends = polygon(center, radius, 4, turn);
  return path_of({ends[0], ends[2]}, false) + path_of({ends[1], ends[3]}, false);
}

std::string shape_of(std::size_t shape, Point center, double radius) {
  switch (shape) {
    case 1:
      return path_of(polygon(center, 1.2 * radius, 4, 0.125), true);  // square
    case 2:
      return path_of(polygon(center, 1.25 * radius, 3, -0.25), true);  // triangle
    case 3:
      return path_of(polygon(center, 1.25 * radius, 4, 0), true);  // diamond
    case 4:
      return path_of(polygon(center, 1.25 * radius, 3, 0.25), true);  // triangle on its head
    case 5:
      return cross(center, 1.2 * radius, 0);
    default:
      return cross(center, 1.3 * radius, 0.125);
  }
}

std::string tip_of(const std::string& tip) {
  return tip.empty() ? "" : fmt::format("<title>{}</title>", xml_escaped(tip));
}

std::string class_of(const std::string& style) {
  return style.empty() ? "" : fmt::format(" class=\"{}\"", style);
}

}  // namespace

std::string xml_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (c == '\'')
      result += "&#39;";
    else if (byte < 0x20 || byte == 0x7f)
      result += ' ';
    else
      result += c;
  }
  return result;
}

const char* plot_style() {
  return R"(
svg.plot{--ink:#1b1f24;--faint:#6b7280;--grid:#e3e6ea;--ground:#fff;
--c0:#0072b2;--c1:#d55e00;--c2:#009e73;--c3:#cc79a7;--c4:#e69f00;--c5:#56b4e9;--c6:#4b5563;
font:12.5px system-ui,sans-serif;color:var(--ink)}
@media (prefers-color-scheme:dark){svg.plot{--ink:#e6e8eb;--faint:#9aa3af;--grid:#2e343c;--ground:#14171b;
--c0:#4aa8e0;--c1:#ee7733;--c2:#2cc498;--c3:#dd99bd;--c4:#f0b030;--c5:#8fd0f5;--c6:#b4bcc6}}
@media print{svg.plot{--ink:#000;--faint:#444;--grid:#ddd;--ground:#fff;
--c0:#0072b2;--c1:#d55e00;--c2:#009e73;--c3:#cc79a7;--c4:#e69f00;--c5:#56b4e9;--c6:#4b5563}}
svg.plot text{fill:var(--ink)}svg.plot .small{font-size:11.5px}svg.plot .tiny{font-size:9px}svg.plot .faint{fill:var(--faint)}
svg.plot .ground{fill:var(--ground)}
svg.plot .grid{stroke:var(--grid);fill:none}svg.plot .axis{stroke:var(--faint);fill:none}
svg.plot .reference{stroke:var(--ink);stroke-dasharray:5 4;fill:none}
svg.plot .band{fill:var(--faint);fill-opacity:.13}
svg.plot .frontier{stroke:var(--ink);stroke-width:1.2;fill:none}
svg.plot .m0,svg.plot .m1,svg.plot .m2,svg.plot .m3,svg.plot .m4,svg.plot .m5,svg.plot .m6{stroke-width:1.6;fill-opacity:.55}
svg.plot .m0{stroke:var(--c0);fill:var(--c0)}svg.plot .m1{stroke:var(--c1);fill:var(--c1)}
svg.plot .m2{stroke:var(--c2);fill:var(--c2)}svg.plot .m3{stroke:var(--c3);fill:var(--c3)}
svg.plot .m4{stroke:var(--c4);fill:var(--c4)}svg.plot .m5{stroke:var(--c5);fill:var(--c5)}
svg.plot .m6{stroke:var(--c6);fill:var(--c6)}
svg.plot .b0{fill:var(--c0)}svg.plot .b1{fill:var(--c4)}svg.plot .b2{fill:var(--c2)}
svg.plot .l0{stroke:var(--c0)}svg.plot .l1{stroke:var(--c1)}svg.plot .l2{stroke:var(--c2)}svg.plot .l3{stroke:var(--c3)}
svg.plot .l4{stroke:var(--c4)}svg.plot .l5{stroke:var(--c5)}svg.plot .l6{stroke:var(--c6)}
svg.plot .fit{fill:none;stroke-width:1.4}
)";
}

void Svg::line(Point from, Point to, const std::string& style) {
  body_ += fmt::format("<path{} d=\"{}\"/>\n", class_of(style), path_of({from, to}, false));
}

void Svg::polyline(const std::vector<Point>& points, const std::string& style) {
  if (!points.empty()) body_ += fmt::format("<path{} d=\"{}\"/>\n", class_of(style), path_of(points, false));
}

void Svg::polygon(const std::vector<Point>& corners, const std::string& style) {
  if (!corners.empty()) body_ += fmt::format("<path{} d=\"{}\"/>\n", class_of(style), path_of(corners, true));
}

void Svg::rectangle(Point corner, double width, double height, const std::string& style,
                    const std::string& tip) {
  body_ += fmt::format("<rect{} x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\">{}</rect>\n", class_of(style),
                       coordinate(corner.x), coordinate(corner.y), coordinate(width), coordinate(height),
                       tip_of(tip));
}

void Svg::tiles(Point corner, double tile_width, double tile_height, std::size_t columns,
                const std::vector<Colour>& colours) {
  // One path a colour, in units of tiles; neighbours of one colour are one piece.
  std::map<Colour, std::string> paths;
  for (std::size_t first = 0, next; first < colours.size(); first = next) {
    const std::size_t end_of_row = std::min((first / columns + 1) * columns, colours.size());
    for (next = first; next < end_of_row && colours[next] == colours[first];) ++next;
    paths[colours[first]] +=
        fmt::format("M{} {}h{}v1h-{}z", first % columns, first / columns, next - first, next - first);
  }
  body_ +=
      fmt::format("<g transform=\"translate({} {}) scale({:.6g} {:.6g})\" shape-rendering=\"crispEdges\">\n",
                  coordinate(corner.x), coordinate(corner.y), tile_width, tile_height);
  for (const auto& [colour, path] : paths)
    body_ +=
        fmt::format("<path fill=\"#{:02x}{:02x}{:02x}\" d=\"{}\"/>\n", colour[0], colour[1], colour[2], path);
  body_ += "</g>\n";
}

void Svg::marker(Point center, MarkerStyle style, const std::string& tip, bool large) {
  const double radius = large ? kLargeMarker : kMarker;
  if (style.shape == 0)
    body_ += fmt::format("<circle class=\"m{}\" cx=\"{}\" cy=\"{}\" r=\"{}\">{}</circle>\n", style.colour,
                         coordinate(center.x), coordinate(center.y), coordinate(radius), tip_of(tip));
  else
    body_ += fmt::format("<path class=\"m{}\" d=\"{}\">{}</path>\n", style.colour,
                         shape_of(style.shape, center, radius), tip_of(tip));
}

void Svg::text(Point at, const std::string& text, Anchor anchor, const std::string& style) {
  body_ += fmt::format("<text{} x=\"{}\" y=\"{}\" text-anchor=\"{}\">{}</text>\n", class_of(style),
                       coordinate(at.x), coordinate(at.y), kAnchors[static_cast<std::size_t>(anchor)],
                       xml_escaped(text));
}

void Svg::upright_text(Point at, const std::string& text, const std::string& style) {
  body_ +=
      fmt::format("<text{} transform=\"translate({} {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                  class_of(style), coordinate(at.x), coordinate(at.y), xml_escaped(text));
}

std::string Svg::element(const std::string& title) const {
  return fmt::format(
      "<svg class=\"plot\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" role=\"img\" "
      "aria-label=\"{}\">\n{}</svg>\n",
      coordinate(width_), coordinate(height_), xml_escaped(title), body_);
}

std::string svg_file(const std::string& element) {
  const std::size_t end_of_tag = element.find('>') + 1;
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{}<style>{}</style>\n"
      "<rect class=\"ground\" width=\"100%\" height=\"100%\"/>{}",
      element.substr(0, end_of_tag), plot_style(), element.substr(end_of_tag));
}

}  // namespace rayshoot::analysis
