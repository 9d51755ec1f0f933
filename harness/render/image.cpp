#include "harness/render/image.h"

#include <stb/stb_easy_font.h>
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

#include <algorithm>
#include <cmath>

#include "scenes/io/output_file.h"

namespace rayshoot {

void Image::fill(int left, int top, int right, int bottom, const Rgb& colour) {
  for (int y = std::max(top, 0); y < std::min(bottom, height_); ++y)
    for (int x = std::max(left, 0); x < std::min(right, width_); ++x) at(x, y) = colour;
}

void Image::write(int left, int top, const std::string& text, int scale, const Rgb& colour) {
  // The font comes as rectangles, four corners each.
  struct Corner {
    float x, y, z;
    unsigned char colour[4];
  };
  std::vector<Corner> corners(64 * text.size());
  std::string copy = text;  // the library takes a pointer to non-const
  const std::size_t rectangles = stb_easy_font_print(0, 0, copy.data(), nullptr, corners.data(),
                                                     static_cast<int>(corners.size() * sizeof(Corner)));
  const auto pixel = [&](float position) { return static_cast<int>(std::lround(position)) * scale; };
  for (std::size_t i = 0; i < rectangles; ++i) {
    const Corner &first = corners[4 * i], &opposite = corners[4 * i + 2];
    fill(left + pixel(first.x), top + pixel(first.y), left + pixel(opposite.x), top + pixel(opposite.y),
         colour);
  }
}

int text_width(const std::string& text, int scale) {
  std::string copy = text;
  return stb_easy_font_width(copy.data()) * scale;
}

void write_png(const Image& image, const std::string& path) {
  OutputFile file(path);
  const auto append = [](void* stream, void* data, int bytes) {
    static_cast<std::ostream*>(stream)->write(static_cast<const char*>(data), bytes);
  };
  stbi_write_png_to_func(append, &file.stream(), image.width(), image.height(), 3, image.at(0, 0).data(),
                         3 * image.width());
  file.commit();
}

}  // namespace rayshoot
