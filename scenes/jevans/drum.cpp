// drum, a drum kit (after Jevans 1990)
//
// Purpose    Clustered polygons in a scene that is hardly larger than they are: rims, lugs, springs and stands are dense,
//            heads and floor are single polygons. A uniform grid is too coarse at the clusters; an octree need not be
//            deep, but divides in every direction where one would do.
// Idea       Five drums with their hardware, four cymbals on stands, pedal, stool and sticks, on a carpet of one polygon.
// Size       3712 size^2 + 280 polygons: 1 → 3992, 4 → 59672 (default, Jevans' number), 8 → 237848.

#include "scenes/jevans/sculptor.h"

namespace rayshoot {

namespace {

using jevans::kPi;
using jevans::Sculptor;
using jevans::Seam;

const Material kChrome{{0.75, 0.75, 0.78}, 0.5, 0.4, 60, 0, 1};
const Material kSkin{{0.95, 0.93, 0.88}, 0.9, 0, 100000, 0, 1};
const Material kLacquer{{0.7, 0.08, 0.1}, 0.75, 0.15, 40, 0, 1};
const Material kBrass{{0.85, 0.65, 0.25}, 0.6, 0.35, 30, 0, 1};
const Material kWood{{0.8, 0.6, 0.35}, 0.85, 0.05, 20, 0, 1};
const Material kBlack{{0.08, 0.08, 0.09}, 0.8, 0.1, 20, 0, 1};

/// A drum about the z axis of `frame`, centred at its origin: shell, two heads, two rims, and around them lugs with
/// tension rods.
void drum(Sculptor& sculptor, const Affine& frame, double radius, double depth, int lugs) {
  const auto together = sculptor.part();
  const double half = depth / 2;
  sculptor.material(kLacquer);
  const auto shell = jevans::revolved(frame, [=](double v) { return std::pair{radius, depth * (v - 0.5)}; });
  sculptor.sheet({10, 2}, shell);
  sculptor.material(kSkin);
  sculptor.cap({10, 2}, shell, 0);
  sculptor.cap({10, 2}, shell, 1);
  sculptor.material(kChrome);
  for (const double side : {-1.0, 1.0})
    sculptor.sheet({10, 2, Seam::both},
                   jevans::torus(compose(frame, translation({0, 0, side * half})), radius * 1.02, 0.012));
  for (int k = 0; k < lugs; ++k) {
    const Vec3d out = jevans::on_circle((k + 0.5) / lugs);
    const auto at = [&](double z) { return frame(out * (radius + 0.022) + Vec3d{0, 0, z}); };
    const Affine middle = compose(
        frame, compose(translation(out * (radius + 0.015)), rotation({0, 0, 1}, 2 * kPi * (k + 0.5) / lugs)));
    sculptor.closed_sheet({3, 2}, jevans::rounded_box(middle, {0.018, 0.016, 0.3 * depth}, 0.6));
    sculptor.closed_sheet({3, 1}, jevans::rod(at(-half - 0.02), at(half + 0.02), 0.005));
  }
}

/// A stand: a pole from the floor to `top`, three legs, and two clamps with wing nuts.
void stand(Sculptor& sculptor, const Vec3d& top) {
  const auto together = sculptor.part();
  sculptor.material(kChrome);
  const Vec3d foot{top.x, top.y, 0.12};
  sculptor.closed_sheet({3, 4}, jevans::rod(foot, top, 0.013, 0.009));
  for (int leg = 0; leg < 3; ++leg) {
    const Vec3d out = jevans::on_circle(leg / 3.0 + 0.1);
    sculptor.closed_sheet(
        {3, 3}, jevans::rod(foot + Vec3d{0, 0, 0.25}, Vec3d{top.x, top.y, 0.01} + out * 0.3, 0.009));
  }
  for (const double height : {0.45, 0.75}) {
    const Vec3d at{top.x, top.y, height * top.z};
    sculptor.closed_sheet({4, 3}, jevans::rounded_box(translation(at), {0.025, 0.02, 0.03}, 0.5));
    sculptor.closed_sheet({3, 3},
                          jevans::ellipsoid(translation(at + Vec3d{0.04, 0, 0}), {0.022, 0.006, 0.012}));
  }
}

/// A cymbal of bell and bow, tilted about y.
void cymbal(Sculptor& sculptor, const Vec3d& at, double radius, double tilt) {
  const auto together = sculptor.part();
  sculptor.material(kBrass);
  sculptor.sheet({10, 6},
                 jevans::revolved(compose(translation(at), rotation({0, 1, 0}, tilt)), [=](double v) {
                   const double r = radius * (1 - 0.97 * v);
                   const double bell = 0.1 * radius * std::max(0.0, 1 - std::pow(r / (0.2 * radius), 2));
                   return std::pair{r, bell + 0.05 * radius * v};
                 }));
}

/// The springs under the snare drum: coils side by side along x.
void snares(Sculptor& sculptor, const Vec3d& centre, double length, int strands) {
  const auto together = sculptor.part();
  sculptor.material(kChrome);
  for (int k = 0; k < strands; ++k) {
    const double y = centre.y + 0.006 * (k - 0.5 * (strands - 1));
    const auto coil = [=](double v) {
      const double turn = 2 * kPi * 12 * v;
      return Vec3d{centre.x + length * (v - 0.5), y + 0.0025 * std::cos(turn),
                   centre.z + 0.0025 * std::sin(turn)};
    };
    sculptor.sheet({3, 24}, jevans::tube(coil, {0, 0, 1}, [](double) { return 0.0008; }));
  }
}

void drums(Sculptor& sculptor) {
  const auto together = sculptor.part();
  const auto upright = [](const Vec3d& at, double tilt) {
    return compose(translation(at), rotation({1, 0, 0}, tilt));
  };
  drum(sculptor, jevans::frame_along({0, 0, 0.29}, {0, 1, 0}), 0.27, 0.42, 10);
  drum(sculptor, upright({-0.21, 0.02, 0.78}, -0.35), 0.15, 0.22, 6);
  drum(sculptor, upright({0.21, 0.02, 0.77}, -0.35), 0.165, 0.24, 6);
  drum(sculptor, upright({0.62, 0.42, 0.27}, 0), 0.2, 0.42, 8);
  drum(sculptor, upright({-0.47, 0.48, 0.6}, -0.05), 0.18, 0.14, 8);
  snares(sculptor, {-0.47, 0.48, 0.524}, 0.3, 8);
  sculptor.material(kChrome);
  for (const double side : {-1.0, 1.0})
    sculptor.box(translation({0.1 * side, 0.03, 0.65}), {0.015, 0.015, 0.1});
}

void cymbals(Sculptor& sculptor) {
  const auto together = sculptor.part();
  stand(sculptor, {-0.62, 0.0, 1.2});
  stand(sculptor, {0.72, 0.02, 1.08});
  stand(sculptor, {-0.9, 0.42, 0.98});
  stand(sculptor, {-0.47, 0.48, 0.5});
  cymbal(sculptor, {-0.62, 0.0, 1.2}, 0.23, 0.25);
  cymbal(sculptor, {0.72, 0.02, 1.08}, 0.27, -0.25);
  cymbal(sculptor, {-0.9, 0.42, 0.88}, 0.19, kPi);
  cymbal(sculptor, {-0.9, 0.42, 0.91}, 0.19, 0);
}

void furniture(Sculptor& sculptor) {
  const auto together = sculptor.part();
  // The stool.
  const Vec3d seat{0.02, 1.0, 0.5};
  sculptor.material(kBlack);
  sculptor.closed_sheet({8, 4}, jevans::rounded_box(translation(seat), {0.19, 0.17, 0.06}, 0.5));
  sculptor.material(kChrome);
  sculptor.closed_sheet({3, 2}, jevans::rod({seat.x, seat.y, 0.1}, seat, 0.02));
  for (int leg = 0; leg < 3; ++leg)
    sculptor.closed_sheet(
        {3, 1}, jevans::rod({seat.x, seat.y, 0.3},
                            Vec3d{seat.x, seat.y, 0.01} + jevans::on_circle(leg / 3.0) * 0.25, 0.012));
  // Pedals of the bass drum and the hi-hat.
  sculptor.box(translation({0, 0.38, 0.03}), {0.04, 0.13, 0.01});
  sculptor.box(translation({0, 0.53, 0.02}), {0.045, 0.03, 0.02});
  sculptor.box(translation({-0.9, 0.6, 0.03}), {0.04, 0.13, 0.01});
  sculptor.closed_sheet({3, 1}, jevans::rod({0, 0.27, 0.06}, {0, 0.25, 0.28}, 0.006));
  sculptor.material(kSkin);
  sculptor.closed_sheet({4, 2}, jevans::ellipsoid(translation({0, 0.245, 0.29}), {0.02, 0.03, 0.025}));
  // Two sticks, left lying on the snare drum and the floor tom; the carpet.
  sculptor.material(kWood);
  sculptor.closed_sheet({4, 2}, jevans::rod({-0.62, 0.4, 0.69}, {-0.3, 0.62, 0.69}, 0.004, 0.008));
  sculptor.closed_sheet({4, 2}, jevans::rod({0.5, 0.3, 0.5}, {0.75, 0.6, 0.5}, 0.004, 0.008));
  sculptor.material({{0.25, 0.2, 0.35}, 0.9, 0, 100000, 0, 1});
  sculptor.box(translation({0, 0.4, -0.015}), {1.4, 1.1, 0.015});
}

void model(Sculptor& sculptor) {
  drums(sculptor);
  cymbals(sculptor);
  furniture(sculptor);
}

void generate(const SceneOptions& options, const Arguments&, SceneBuilder& builder) {
  builder.background({0.45, 0.5, 0.6});
  builder.view(
      {.from = {-1.35, -2.75, 2.15}, .at = {-0.02, 0.28, 0.5}, .up = {0, 0, 1}, .angle = 38, .hither = 0.01});
  builder.light({3, -4, 5});
  builder.light({-4, -3, 4});
  Sculptor sculptor(options.size, &builder);
  model(sculptor);
}

double object_count(const SceneOptions& options, const Arguments&) {
  Sculptor counter(options.size);
  model(counter);
  return counter.polygons();
}

}  // namespace

const SceneGenerator& scene_drum() {
  static const SceneGenerator generator{
      .id = "drum",
      .title = "Drum kit",
      .source = jevans::kPaper,
      .default_size = 4,
      .min_size = 1,
      .purpose = "clusters of polygons in a scene hardly larger than they are; 3712 size^2 + 280 polygons",
      .parameters = {},
      .object_count = object_count,
      .generate = generate};
  return generator;
}

}  // namespace rayshoot
