#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rayshoot {

/// A colour as it is stored: red, green, blue.
using Rgb = std::array<std::uint8_t, 3>;

/// A picture, row by row from the upper left.
class Image {
 public:
  Image(int width, int height, const Rgb& fill = {0, 0, 0})
      : width_(width), height_(height), pixels_(static_cast<std::size_t>(width) * height, fill) {}

  int width() const { return width_; }
  int height() const { return height_; }
  const Rgb& at(int x, int y) const { return pixels_[static_cast<std::size_t>(y) * width_ + x]; }
  Rgb& at(int x, int y) { return pixels_[static_cast<std::size_t>(y) * width_ + x]; }

  /// Fill the part of a rectangle that lies inside the picture; its right and lower end are outside of it.
  void fill(int left, int top, int right, int bottom, const Rgb& colour);
  /// Write a line of ASCII, each of the font's dots `scale` pixels wide, from its upper left corner.
  void write(int left, int top, const std::string& text, int scale, const Rgb& colour);

 private:
  int width_, height_;
  std::vector<Rgb> pixels_;
};

/// Width of a line that `Image::write` writes, in pixels.
int text_width(const std::string& text, int scale);

/// Write a PNG file, which appears only when it is complete. Throws InputError when that fails.
void write_png(const Image& image, const std::string& path);

}  // namespace rayshoot
