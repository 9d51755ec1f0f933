// stadium, a small dense object in a huge sparse box
//
// Purpose    The question that lumpy asks, with a dial: what does a technique cost when nearly all objects lie in a
//            vanishing part of the scene? A uniform grid of n cells puts the whole cup into one of them, and an octree
//            spends log2(ratio) levels on the way to it.
// Idea       A chased cup stands at the centre of a stadium whose length is `ratio` times the cup's height. The cup has
//            98 of 100 polygons; tiers, field and seats share the rest.
// Size       objects (size / 4)^2 polygons, rounded down, but not under 1000: 4 → `objects` (default), 1 → a sixteenth.
// Parameters objects   polygons at the default size (100000: the whole cup in one cell of a grid of as many cells)
//            ratio     length of the stadium over height of the cup (1000: "a teapot in a stadium")

#include "scenes/jevans/sculptor.h"

namespace rayshoot {

namespace {

using jevans::kPi;

constexpr int kSectors = 48, kTiers = 4;
/// Bowl, field, and five lines on it.
constexpr double kFixedPolygons = kSectors * kTiers + 1 + 5;

double object_count(const SceneOptions& options, const Arguments& arguments) {
  const double scale = options.size / 4.0;
  return std::max(1000.0, std::floor(static_cast<double>(arguments.integer("objects")) * scale * scale));
}

/// How the polygons are shared out.
struct Shares {
  int around, along;
  long long seats;
};

Shares share_out(double polygons) {
  const double cells = 0.98 * (polygons - kFixedPolygons) / 2;
  const double around = std::floor(std::sqrt(cells / 2)), along = std::floor(cells / around);
  return {static_cast<int>(around), static_cast<int>(along),
          static_cast<long long>(polygons - kFixedPolygons - 2 * around * along)};
}

/// A point of the bowl of a stadium of length 1: v from 0 at the field to 1 at the top.
Vec3d bowl(double u, double v) {
  const Vec3d c = jevans::on_circle(u);
  return {0.25 * (1 + v) * c.x, 0.17 * (1 + v) * c.y, 0.13 * std::pow(v, 1.4)};
}

/// Number i of a sequence that covers the unit square evenly (Roberts 2018).
std::array<double, 2> spread(double i) {
  constexpr double kRatio = 1.32471795724474602596;
  const double a = i / kRatio, b = i / (kRatio * kRatio);
  return {a - std::floor(a), b - std::floor(b)};
}

void seat(SceneBuilder& builder, double number, double scale) {
  const auto [u, s] = spread(number);
  const double tier = std::floor(s * kTiers), v = (tier + 0.15 + 0.6 * (s * kTiers - tier)) / kTiers;
  const Vec3d corner = bowl(u, v), width = bowl(u + 0.006, v) - corner;
  const Vec3d height{0, 0, 0.006};
  builder.polygon(std::array{corner * scale, (corner + width) * scale, (corner + width + height) * scale,
                             (corner + height) * scale});
}

void stands(SceneBuilder& builder, double scale, long long seats) {
  const auto together = builder.group();
  builder.material({{0.65, 0.65, 0.68}, 0.9, 0, 100000, 0, 1});
  for (int tier = 0; tier < kTiers; ++tier)
    for (int sector = 0; sector < kSectors; ++sector) {
      const double u0 = static_cast<double>(sector) / kSectors;
      const double u1 = static_cast<double>((sector + 1) % kSectors) / kSectors;
      const double v0 = static_cast<double>(tier) / kTiers, v1 = (tier + 1.0) / kTiers;
      builder.polygon(
          std::array{bowl(u1, v0) * scale, bowl(u0, v0) * scale, bowl(u0, v1) * scale, bowl(u1, v1) * scale});
    }
  builder.material({{0.75, 0.1, 0.1}, 0.9, 0, 100000, 0, 1});
  for (long long k = 0; k < seats; ++k) {
    if (k == seats / 2) builder.material({{0.1, 0.2, 0.7}, 0.9, 0, 100000, 0, 1});
    seat(builder, static_cast<double>(k), scale);
  }
}

void field(SceneBuilder& builder, double scale) {
  const auto together = builder.group();
  const auto lie = [&](double x, double y, double half_x, double half_y, double z) {
    builder.polygon(
        std::array{Vec3d{x - half_x, y - half_y, z} * scale, Vec3d{x + half_x, y - half_y, z} * scale,
                   Vec3d{x + half_x, y + half_y, z} * scale, Vec3d{x - half_x, y + half_y, z} * scale});
  };
  builder.material({{0.2, 0.5, 0.15}, 0.9, 0, 100000, 0, 1});
  lie(0, 0, 0.25, 0.17, 0);
  builder.material({{0.95, 0.95, 0.95}, 0.9, 0, 100000, 0, 1});
  for (const double side : {-1.0, 1.0}) {
    lie(0, 0.11 * side, 0.17, 0.0012, 0.0001);
    lie(0.17 * side, 0, 0.0012, 0.11, 0.0001);
  }
  lie(0.05, 0, 0.0012, 0.11, 0.0001);
}

/// Radius and height of the cup's outline, which runs up the outside and down the inside.
std::pair<double, double> outline(double v) {
  constexpr std::array<std::pair<double, double>, 16> kPoints = {{{0.2, 0},
                                                                  {0.21, 0.03},
                                                                  {0.19, 0.06},
                                                                  {0.08, 0.1},
                                                                  {0.045, 0.17},
                                                                  {0.045, 0.24},
                                                                  {0.085, 0.28},
                                                                  {0.045, 0.32},
                                                                  {0.06, 0.37},
                                                                  {0.2, 0.45},
                                                                  {0.28, 0.6},
                                                                  {0.29, 0.8},
                                                                  {0.33, 1.0},
                                                                  {0.3, 0.97},
                                                                  {0.25, 0.6},
                                                                  {0.02, 0.45}}};
  const double position = v * (kPoints.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(position), kPoints.size() - 2);
  const double t = position - static_cast<double>(i), smooth = t * t * (3 - 2 * t);
  const auto& [r0, z0] = kPoints[i];
  const auto& [r1, z1] = kPoints[i + 1];
  return {r0 + (r1 - r0) * (0.5 * t + 0.5 * smooth), z0 + (z1 - z0) * (0.5 * t + 0.5 * smooth)};
}

Vec3d cup(double u, double v) {
  const auto [radius, height] = outline(v);
  // Chase the bowl with bosses, and flute the foot.
  const double bowl_weight = v > 0.6 && v < 0.78 ? std::sin(kPi * (v - 0.6) / 0.18) : 0;
  const double bosses = 0.02 * bowl_weight * std::sin(2 * kPi * 24 * u) * std::sin(kPi * (v - 0.6) / 0.03);
  const double flutes = v < 0.25 ? 0.01 * std::cos(2 * kPi * 18 * u) * std::sin(kPi * v / 0.25) : 0;
  return jevans::on_circle(u) * (radius + bosses + flutes) + Vec3d{0, 0, height};
}

void generate(const SceneOptions& options, const Arguments& arguments, SceneBuilder& builder) {
  const double ratio = arguments.real("ratio");
  const Shares shares = share_out(object_count(options, arguments));
  builder.background({0.55, 0.72, 0.95});
  builder.view({.from = {0.5, -2.1, 0.9}, .at = {0, 0, 0.72}, .up = {0, 0, 1}, .angle = 55, .hither = 0.01});
  builder.light({-0.2 * ratio, -0.4 * ratio, 0.5 * ratio});
  builder.light({0.3 * ratio, -0.1 * ratio, 0.4 * ratio});
  field(builder, ratio);
  stands(builder, ratio, shares.seats);
  builder.material({{0.95, 0.75, 0.25}, 0.6, 0.3, 40, 0, 1});
  jevans::Sculptor sculptor(1, &builder);
  sculptor.sheet({shares.around, shares.along}, cup);
}

}  // namespace

const SceneGenerator& scene_stadium() {
  static const SceneGenerator generator{
      .id = "stadium",
      .title = "Cup in a stadium",
      .source =
          "The dense object in a huge sparse box that uniform grids are warned of (Jevans 1990 and others)",
      .default_size = 4,
      .min_size = 1,
      .purpose = "98 of 100 polygons in a vanishing part of the scene; objects (size / 4)^2 polygons",
      .parameters = {integer_parameter("objects", 100'000, 1000, 1e9, "polygons at the default size"),
                     real_parameter("ratio", 1000, 10, 1e6, "length of the stadium over height of the cup")},
      .object_count = object_count,
      .generate = generate};
  return generator;
}

}  // namespace rayshoot
