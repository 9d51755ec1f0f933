// hair, slivers that radiate from a ball
//
// Purpose    Boxes that are nearly empty. A sliver is some 450 times as long as wide and lies in any direction, so that a
//            ray meets the boxes of hundreds for one that it hits. No hierarchy of boxes tells them apart, and cells
//            repeat them.
// Idea       Roots are spread evenly over the unit sphere, in locks of ten. A hair is one triangle, which stands on its
//            root and leans as it likes. All numbers come from one stream of random numbers.
// Size       500 size^2 triangles: 1 → 500, 20 → 200,000 (default), 45 → 1,012,500. Lengths are 0.2 to 0.7.
// Parameters width     mean width of a sliver at its root (0.001: under half a pixel of a picture of 512)

#include <cmath>
#include <numbers>

#include "scenes/core/registry.h"
#include "scenes/rays/random.h"

namespace rayshoot {

namespace {

/// Bands of locks from pole to pole, locks around a band, both at size 1; slivers in a lock.
constexpr int kBands = 5, kLocks = 10, kSlivers = 10;
constexpr double kShortest = 0.2, kLongest = 0.7, kLean = 0.4;
constexpr std::uint64_t kSeed = 1;

double object_count(const SceneOptions& options, const Arguments&) {
  return static_cast<double>(kBands) * kLocks * kSlivers * options.size * options.size;
}

/// The numbers of one sliver, each uniform between two limits.
class Uniform {
 public:
  explicit Uniform(std::uint64_t sliver) : sliver_(sliver) {}
  double operator()(double lo, double hi) { return lo + (hi - lo) * random_.uniform(sliver_, dimension_++); }

 private:
  RandomNumbers random_{kSeed};
  std::uint64_t sliver_, dimension_ = 0;
};

Vec3d in_cube(Uniform& uniform) {
  const double x = uniform(-1, 1), y = uniform(-1, 1);
  return {x, y, uniform(-1, 1)};
}

/// A sliver whose root lies in one of `bands` by `locks` cells, which are of equal area since slices of a sphere of equal
/// height are (Archimedes).
void sliver(SceneBuilder& builder, Uniform uniform, int band, int bands, int lock, int locks, double width) {
  const double z = uniform(2.0 * band / bands - 1, 2.0 * (band + 1) / bands - 1);
  const double angle = 2 * std::numbers::pi * uniform(lock, lock + 1) / locks;
  const double radius = std::sqrt(1 - z * z);
  const Vec3d root{radius * std::cos(angle), radius * std::sin(angle), z};
  const Vec3d along = normalized(root + in_cube(uniform) * kLean);
  const Vec3d side = normalized(cross(along, in_cube(uniform)));
  const Vec3d half = side * (width * uniform(0.375, 0.625));
  builder.triangle(root - half, root + half, root + along * uniform(kShortest, kLongest));
}

void generate(const SceneOptions& options, const Arguments& arguments, SceneBuilder& builder) {
  const double width = arguments.real("width");
  const int bands = kBands * options.size, locks = kLocks * options.size;
  builder.background({0.3, 0.4, 0.55});
  builder.view({.from = {0, -4.2, 1.2}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle = 45});
  builder.light({-3, -6, 5});
  builder.material({{0.75, 0.5, 0.2}, 0.9, 0, 1, 0, 1});
  std::uint64_t number = 0;
  for (int band = 0; band < bands; ++band) {
    const auto whole_band = builder.group();
    for (int lock = 0; lock < locks; ++lock) {
      const auto whole_lock = builder.group();
      for (int i = 0; i < kSlivers; ++i) sliver(builder, Uniform(number++), band, bands, lock, locks, width);
    }
  }
}

}  // namespace

const SceneGenerator& scene_hair() {
  static const SceneGenerator generator{
      .id = "hair",
      .title = "Hair on a ball",
      .source =
          "the weak case of hierarchies of boxes (Woop et al., Exploiting local orientation similarity for "
          "efficient ray traversal of hair and fur, 2014)",
      .default_size = 20,
      .min_size = 1,
      .purpose = "slivers whose boxes are nearly empty and overlap by the hundred; 500 size^2 triangles",
      .parameters = {real_parameter("width", 0.001, 1e-6, 0.1, "mean width of a sliver at its root")},
      .object_count = object_count,
      .generate = generate};
  return generator;
}

}  // namespace rayshoot
