#include "analysis/plots/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/tables/page.h"

namespace rayshoot::analysis {

namespace {

constexpr double kLeft = 66, kRight = 14, kTop = 12, kBottom = 46;
constexpr double kLineHeight = 16;
/// Width of a character of small text, rather too much than too little.
constexpr double kSmallCharacter = 6.3;

}  // namespace

std::string bands_in_words(const std::vector<Point>& values) {
  const auto within = [&](double factor) {
    return std::count_if(values.begin(), values.end(), [&](const Point& value) {
      return value.y <= factor * value.x && value.x <= factor * value.y;
    });
  };
  return fmt::format("Shaded: off by at most {:g} times ({} of {}) and {:g} times ({} of {}).", kNear,
                     within(kNear), values.size(), kFar, within(kFar), values.size());
}

bool Chart::Box::meets(const Box& other) const {
  return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
}

Chart::Chart(Axis x, Axis y, double height)
    : x_(std::move(x)),
      y_(std::move(y)),
      area_{kLeft, kTop, kPlotWidth - kRight, kTop + height},
      svg_(kPlotWidth, kTop + height + kBottom) {
  draw_frame();
}

void Chart::draw_frame() {
  for (const Axis::Tick& tick : x_.ticks()) {
    const double position = at(tick.value, y_.low()).x;
    svg_.line({position, area_.top}, {position, area_.bottom}, "grid");
    svg_.text({position, area_.bottom + 16}, tick.label, Svg::Anchor::middle, "small");
  }
  for (const Axis::Tick& tick : y_.ticks()) {
    const double position = at(x_.low(), tick.value).y;
    svg_.line({area_.left, position}, {area_.right, position}, "grid");
    svg_.text({area_.left - 6, position + 4}, tick.label, Svg::Anchor::end, "small");
  }
  svg_.polyline({{area_.left, area_.top}, {area_.left, area_.bottom}, {area_.right, area_.bottom}}, "axis");
  svg_.text({(area_.left + area_.right) / 2, area_.bottom + 36}, x_.title(), Svg::Anchor::middle);
  svg_.upright_text({14, (area_.top + area_.bottom) / 2}, y_.title());
}

Point Chart::at(double x, double y) const {
  return {area_.left + x_.position(x) * (area_.right - area_.left),
          area_.bottom - y_.position(y) * (area_.bottom - area_.top)};
}

void Chart::point(Point value, MarkerStyle style, const std::string& tip) {
  if (contains(value.x, value.y)) svg_.marker(at(value.x, value.y), style, tip);
}

void Chart::equality() {
  const double low = std::max(x_.low(), y_.low()), high = std::min(x_.high(), y_.high());
  if (low < high) svg_.line(at(low, low), at(high, high), "reference");
}

void Chart::band(double factor) {
  const double low = std::max(x_.low(), y_.low()), high = std::min(x_.high(), y_.high());
  if (low * factor >= high) return;
  svg_.polygon({at(low, low), at(low, low * factor), at(high / factor, high), at(high, high),
                at(high, high / factor), at(low * factor, low)},
               "band");
}

void Chart::equality_with_bands() {
  band(kFar);
  band(kNear);
  equality();
}

void Chart::frontier(const std::vector<Point>& values, const std::string& style) {
  std::vector<Point> corners;
  for (const Point& value : values) {
    if (!contains(value.x, value.y)) continue;
    if (!corners.empty()) corners.push_back({at(value.x, value.y).x, corners.back().y});
    corners.push_back(at(value.x, value.y));
  }
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const auto [left, right] = std::minmax(corners[i - 1].x, corners[i].x);
    const auto [top, bottom] = std::minmax(corners[i - 1].y, corners[i].y);
    taken_.push_back({left - 1, top - 1, right + 1, bottom + 1});
  }
  svg_.polyline(corners, style);
}

bool Chart::is_free(const Box& box) const {
  return box.left >= area_.left && box.right <= area_.right + kRight && box.top >= area_.top &&
         box.bottom <= area_.bottom &&
         std::none_of(taken_.begin(), taken_.end(), [&](const Box& other) { return box.meets(other); });
}

void Chart::keep_clear(Point value) {
  constexpr double radius = 4;
  if (!contains(value.x, value.y)) return;
  const Point center = at(value.x, value.y);
  taken_.push_back({center.x - radius, center.y - radius, center.x + radius, center.y + radius});
}

bool Chart::name(Point value, const std::string& text) {
  if (!contains(value.x, value.y)) return false;
  const Point center = at(value.x, value.y);
  const double width = kSmallCharacter * static_cast<double>(display_width(text)), height = 11;
  // Right, left, above and below, then at the corners.
  const std::array<Point, 8> corners{
      Point{center.x + 8, center.y - height / 2},         Point{center.x - 8 - width, center.y - height / 2},
      Point{center.x - width / 2, center.y - 7 - height}, Point{center.x - width / 2, center.y + 7},
      Point{center.x + 5, center.y - 5 - height},         Point{center.x + 5, center.y + 5},
      Point{center.x - 5 - width, center.y - 5 - height}, Point{center.x - 5 - width, center.y + 5}};
  for (const Point& corner : corners) {
    const Box box{corner.x, corner.y, corner.x + width, corner.y + height};
    if (!is_free(box)) continue;
    taken_.push_back(box);
    svg_.text({corner.x, corner.y + height - 2}, text, Svg::Anchor::start, "small");
    return true;
  }
  return false;
}

void Chart::legend(const std::vector<std::pair<std::string, MarkerStyle>>& series) {
  double widest = 0;
  for (const auto& [text, style] : series)
    widest = std::max(widest, kSmallCharacter * static_cast<double>(display_width(text)) + 30);
  const auto columns =
      static_cast<std::size_t>(std::max(1.0, std::floor((kPlotWidth - 10) / std::max(widest, 1.0))));
  const std::size_t rows = (series.size() + columns - 1) / columns;
  const double top = svg_.height() + 4, column_width = (kPlotWidth - 10) / static_cast<double>(columns);
  for (std::size_t i = 0; i < series.size(); ++i) {
    const std::size_t column = i / rows, row = i % rows;
    const Point at{10 + column_width * static_cast<double>(column),
                   top + kLineHeight * static_cast<double>(row)};
    svg_.marker({at.x + 5, at.y}, series[i].second);
    svg_.text({at.x + 16, at.y + 4}, series[i].first, Svg::Anchor::start, "small");
  }
  svg_.set_height(top + kLineHeight * static_cast<double>(rows));
}

}  // namespace rayshoot::analysis
