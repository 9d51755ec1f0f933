// mount, a fractal mountain with four glass balls (Haines 1987)
//
// Purpose    A height field: triangles of similar size, connected, all near one surface; with glass above
//            them.
// Size       2·4^size triangles and 4 spheres: 4 → 516, 6 → 8196 (default), 8 → 131076.
// Terrain    Midpoint displacement whose random heights come from a deliberately poor hash of the grid
//            position; the hash depends on the size, so mountains of different sizes are different mountains.

#include <cmath>
#include <cstdint>

#include "scenes/spd/database.h"

namespace rayshoot {

namespace {

/// One Gaussian deviate from a seed: the polar method over a linear congruential generator.
double gaussian(std::uint32_t seed) {
  constexpr double modulus = 134456;
  const auto next = [](std::uint32_t value) { return (28411 + 8121 * value) % 134456; };
  std::uint32_t y = seed;
  while (true) {
    const std::uint32_t x = next(y);
    y = next(x);
    const double a = 2 * x / modulus - 1, b = 2 * y / modulus - 1;
    const double q = a * a + b * b;
    if (q < 1) return a * std::sqrt(-2 * std::log(q) / q);
  }
}

/// Midpoint displacement over [-1,1]², from 2^size cells a side.
class Mountain {
 public:
  Mountain(int size, SceneBuilder& builder)
      : size_(size), cells_(std::int64_t{1} << size), builder_(builder) {}

  struct Heights {
    double lower_left, lower_right, upper_right, upper_left;
  };

  /// Displace the middles of a cell's edges and of the cell, then divide it; a cell of width 1 is two
  /// triangles.
  void divide(std::int64_t x, std::int64_t y, std::int64_t width, const Heights& z) {
    const auto quadrant = builder_.group();
    if (width == 1) return emit(x, y, z);
    const std::int64_t h = width / 2;
    const double spread = 2.0 * static_cast<double>(h) / static_cast<double>(cells_) * roughness_;
    const double lower = (z.lower_left + z.lower_right) / 2 + spread * random_height(x + h, y);
    const double right = (z.lower_right + z.upper_right) / 2 + spread * random_height(x + width, y + h);
    const double upper = (z.upper_right + z.upper_left) / 2 + spread * random_height(x + h, y + width);
    const double left = (z.upper_left + z.lower_left) / 2 + spread * random_height(x, y + h);
    const double middle = (z.lower_left + z.lower_right + z.upper_right + z.upper_left) / 4 +
                          1.4142136 * spread * random_height(x + h, y + h);
    divide(x, y, h, {z.lower_left, lower, middle, left});
    divide(x + h, y, h, {lower, z.lower_right, right, middle});
    divide(x + h, y + h, h, {middle, right, z.upper_right, upper});
    divide(x, y + h, h, {left, middle, upper, z.upper_left});
  }

 private:
  /// The hash, modulo 2^16; a term whose shift would be negative is dropped, as it is in the original on x86.
  double random_height(std::int64_t x, std::int64_t y) const {
    const auto term = [](std::int64_t value, int shift) { return shift < 0 ? 0 : value << shift; };
    const std::int64_t hash = term(x, 23 - size_) + term(y, 15 - size_) + term(x, 7 - size_);
    return gaussian(21 + static_cast<std::uint32_t>(hash & 0xFFFF));
  }

  Vec3d point(std::int64_t x, std::int64_t y, double z) const {
    const auto coordinate = [&](std::int64_t i) {
      return -1 + 2 * static_cast<double>(i) / static_cast<double>(cells_);
    };
    return {coordinate(x), coordinate(y), z};
  }

  void emit(std::int64_t x, std::int64_t y, const Heights& z) {
    const Vec3d lower_left = point(x, y, z.lower_left), upper_right = point(x + 1, y + 1, z.upper_right);
    builder_.triangle(lower_left, point(x + 1, y, z.lower_right), upper_right);
    builder_.triangle(upper_right, point(x, y + 1, z.upper_left), lower_left);
  }

  const int size_;
  const std::int64_t cells_;
  const double roughness_ = std::sqrt(std::pow(2 / std::exp(std::numbers::ln2 / 1.2), 2) - 1);
  SceneBuilder& builder_;
};

/// Four balls that touch one another, at the corners of a tetrahedron standing on its face.
void balls(SceneBuilder& builder) {
  constexpr double radius = 0.17;
  const auto all_four = builder.group();
  const Vec3d centre{-0.8, 0.8, 1};
  const Vec3d up{0, 0, radius * std::sqrt(1.5)};
  const Vec3d down = rotation(Vec3d{1, 1, 0} * (1 / std::numbers::sqrt2), std::acos(-1.0 / 3)).direction(up);
  builder.sphere(centre + up, radius);
  for (int k = 0; k < 3; ++k)
    builder.sphere(centre + rotation({0, 0, 1}, k * 2 * spd::kPi / 3).direction(down), radius);
}

void generate(const SceneOptions& options, const Arguments&, SceneBuilder& builder) {
  spd::open(builder,
            {.from = {-1.6, 1.6, 1.7}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle = 45, .hither = 0.01},
            {{-100, -100, 100}});
  builder.material({{1, 1, 1}, 0.1, 0.1, shine_from_highlight_angle(6.7), 0.9, 1.5});
  balls(builder);
  builder.material({{0.5, 0.45, 0.35}, 1, 0, spd::kNoHighlight, 0, 0});
  Mountain(options.size, builder).divide(0, 0, std::int64_t{1} << options.size, {0, 0, 0, 0});
}

double object_count(const SceneOptions& options, const Arguments&) {
  return 2 * std::pow(4, options.size) + 4 * patches_of_sphere(options);
}

}  // namespace

const SceneGenerator& scene_mount() {
  static const SceneGenerator generator{.id = "mount",
                                        .title = "Fractal mountain",
                                        .source = spd::kPaper,
                                        .default_size = 6,
                                        .min_size = 1,
                                        .purpose =
                                            "a height field of connected triangles below four glass balls; "
                                            "2*4^size triangles, 4 spheres",
                                        .parameters = {},
                                        .object_count = object_count,
                                        .generate = generate};
  return generator;
}

}  // namespace rayshoot
