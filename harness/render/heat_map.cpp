#include "harness/render/heat_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/plots/heat_scale.h"

namespace rayshoot {

namespace {

constexpr Rgb kPaper = {24, 24, 24}, kInk = {235, 235, 235};
constexpr int kTextHeight = 10;  // of the font and the space below it, at scale 1

void draw_legend(Image& image, const HeatMap& map, int top, int scale, double end) {
  const int margin = 4 * scale, line = kTextHeight * scale, left = margin, right = map.width - margin;
  const double sum = std::accumulate(map.values.begin(), map.values.end(), 0.0);
  const double mean = sum / static_cast<double>(map.values.size());
  const double largest = *std::max_element(map.values.begin(), map.values.end());
  const std::string summary = fmt::format("mean {:.4g}, largest {:.6g}", mean, largest);
  int y = top + margin;
  for (const std::string& text : {map.title, map.subject, summary}) {
    image.write(left, y, text, scale, kInk);
    y += line;
  }

  // The bar, and below it a tick with its number for every quarter, or for the ends where there is no room.
  const int bar = y + margin, below = bar + line;
  const int ticks = map.width > 5 * text_width("0000000", scale) ? 5 : 2;
  for (int x = left; x < right; ++x)
    image.fill(x, bar, x + 1, below, analysis::heat_colour((x - left) / (right - left - 1.0)));
  for (int tick = 0; tick < ticks; ++tick) {
    const double share = tick / (ticks - 1.0);
    const int x = left + static_cast<int>(std::lround(share * (right - left - 1)));
    image.fill(x, below, x + 1, below + margin, kInk);
    const bool open_end = tick == ticks - 1 && largest > end;
    const std::string number = fmt::format("{}{:.6g}", open_end ? ">= " : "", share * end);
    const int width = text_width(number, scale);
    const int start = std::clamp(x - width / 2, left, std::max(left, right - width));
    image.write(start, below + margin + scale, number, scale, kInk);
  }
}

}  // namespace

Image heat_picture(const HeatMap& map) {
  const int widest = std::max(text_width(map.title, 2), text_width(map.subject, 2));
  const int scale = map.width > widest + 16 ? 2 : 1;
  const int legend = scale * (5 * kTextHeight + 14);
  const double end = analysis::end_of_scale(map.values);
  Image image(map.width, map.height + legend, kPaper);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      image.at(x, y) = analysis::heat_colour(map.values[static_cast<std::size_t>(y) * map.width + x] / end);
  draw_legend(image, map, map.height, scale, end);
  return image;
}

}  // namespace rayshoot
