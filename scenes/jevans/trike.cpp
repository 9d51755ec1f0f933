// trike, a child's tricycle (after Jevans 1990)
//
// Purpose    Dense places of irregular extents in a scene that is not large: wheels are broad and thin, spokes and
//            streamers long and finer still, the saddle compact. A uniform grid drowns in them; Jevans' one-dimensional
//            grids gain because every part asks for cells of another shape.
// Idea       Three wire wheels with treaded tyres, a frame of bent tubes, saddle, wire basket, ribbed grips with
//            streamers, bell and pedals, on a paved yard.
// Size       8146 size^2 + 62 polygons: 1 → 8208, 4 → 130398 (default, Jevans' number), 8 → 521406.

#include "scenes/jevans/sculptor.h"

namespace rayshoot {

namespace {

using jevans::kPi;
using jevans::on_circle;
using jevans::Sculptor;
using jevans::Seam;

const Material kRed{{0.8, 0.05, 0.05}, 0.75, 0.15, 40, 0, 1};
const Material kChrome{{0.78, 0.78, 0.8}, 0.5, 0.4, 60, 0, 1};
const Material kRubber{{0.12, 0.12, 0.13}, 0.9, 0, 100000, 0, 1};
const Material kWhite{{0.93, 0.93, 0.9}, 0.85, 0.05, 30, 0, 1};
const Material kBlue{{0.1, 0.25, 0.7}, 0.8, 0.1, 30, 0, 1};

/// A wheel about the y axis through `centre`: a tyre with two dozen knobs, a rim, a hub, and crossed spokes.
void wheel(Sculptor& sculptor, const Vec3d& centre, double radius, int segments, int spokes) {
  const auto together = sculptor.part();
  const Affine frame = jevans::frame_along(centre, {0, 1, 0});
  const double tyre = 0.11 * radius, rim = radius - 2 * tyre;
  sculptor.material(kRubber);
  sculptor.sheet({segments, 8, Seam::both}, [=](double u, double v) {
    const double outward = std::max(0.0, -std::cos(2 * kPi * v));
    const double thickness = tyre * (1 + 0.12 * outward * std::cos(2 * kPi * segments * u));
    const double r = radius - tyre - thickness * std::cos(2 * kPi * v);
    return frame(on_circle(u) * r + Vec3d{0, 0, -thickness * std::sin(2 * kPi * v)});
  });
  sculptor.material(kChrome);
  sculptor.sheet({segments, 3, Seam::both}, jevans::torus(frame, rim, 0.35 * tyre));
  sculptor.closed_sheet({6, 3}, jevans::revolved(frame, [=](double v) {
                          const double z = 2 * v - 1;
                          return std::pair{radius * (0.05 + 0.06 * std::pow(z, 4)), 0.045 * z};
                        }));
  for (int k = 0; k < spokes; ++k) {
    const double side = k % 2 ? 1 : -1, lean = k / 2 % 2 ? 0.12 : -0.12;
    const Vec3d inner = on_circle(static_cast<double>(k) / spokes + lean) * (0.09 * radius);
    const Vec3d outer = on_circle(static_cast<double>(k) / spokes) * rim;
    sculptor.sheet({3, 4}, jevans::rod(frame(inner + Vec3d{0, 0, 0.035 * side}), frame(outer), 0.002));
  }
}

void frame_and_fork(Sculptor& sculptor) {
  const auto together = sculptor.part();
  sculptor.material(kRed);
  // The main tube falls from the head in an S and runs to the rear axle.
  const auto backbone = [](double v) {
    const double drop = 0.5 - 0.5 * std::cos(kPi * std::clamp(v, 0.0, 1.0));
    return Vec3d{0.34 - 0.72 * v, 0, 0.58 - 0.36 * drop};
  };
  sculptor.closed_sheet({8, 20}, jevans::tube(backbone, {0, 1, 0}, [](double) { return 0.024; }));
  sculptor.closed_sheet({6, 4}, jevans::rod({0.35, 0, 0.53}, {0.315, 0, 0.66}, 0.03));
  sculptor.closed_sheet({6, 6}, jevans::rounded_box(translation({0.36, 0, 0.53}), {0.035, 0.075, 0.02}, 0.5));
  for (const double side : {-1.0, 1.0})
    sculptor.closed_sheet({6, 8},
                          jevans::rod({0.365, 0.06 * side, 0.53}, {0.45, 0.06 * side, 0.25}, 0.014, 0.01));
  sculptor.closed_sheet({4, 7}, jevans::rod({-0.38, -0.3, 0.17}, {-0.38, 0.3, 0.17}, 0.012));
  sculptor.closed_sheet({12, 8}, jevans::rounded_box(translation({-0.4, 0, 0.215}), {0.1, 0.2, 0.012}, 0.3));
  sculptor.closed_sheet({4, 2}, jevans::rod({-0.12, 0, 0.33}, {-0.13, 0, 0.45}, 0.015));
  // A mudguard around a third of the front wheel.
  sculptor.sheet({20, 8, Seam::none}, [](double u, double v) {
    const double angle = kPi * (0.18 + 0.62 * u), across = kPi * (v - 0.5);
    const double r = 0.262 + 0.018 * std::cos(across);
    return Vec3d{0.45 + r * std::cos(angle), 0.04 * std::sin(across), 0.25 + r * std::sin(angle)};
  });
  for (const double side : {-1.0, 1.0})
    sculptor.box(translation({-0.505, 0.12 * side, 0.22}), {0.006, 0.02, 0.02});
}

void saddle(Sculptor& sculptor) {
  const auto together = sculptor.part();
  sculptor.material(kBlue);
  const auto cushion = jevans::rounded_box({}, {0.15, 0.11, 0.035}, 0.8);
  sculptor.closed_sheet({16, 13}, [=](double u, double v) {
    const Vec3d p = cushion(u, v);
    // The rim bends up; the flat poles stay flat.
    const double bend = std::max(0.0, 0.5 * p.x * p.x + 0.6 * p.y * p.y - 0.0005);
    const double front = std::clamp(0.5 + p.x / 0.3, 0.0, 1.0);
    return Vec3d{p.x, p.y * (1 - 0.65 * front), p.z + bend} + Vec3d{-0.14, 0, 0.47};
  });
}

/// The handlebar from its left end to its right: up from the stem, out, and back.
Vec3d handlebar(double v) {
  const double s = 2 * v - 1;
  return {0.31 - 0.14 * std::pow(std::abs(s), 3), 0.29 * s, 0.72 + 0.1 * (1 - std::pow(1 - std::abs(s), 3))};
}

void steering(Sculptor& sculptor) {
  const auto together = sculptor.part();
  sculptor.material(kChrome);
  sculptor.closed_sheet({5, 3}, jevans::rod({0.318, 0, 0.64}, {0.31, 0, 0.73}, 0.016));
  sculptor.closed_sheet({6, 36}, jevans::tube(handlebar, {0, 0, 1}, [](double) { return 0.011; }));
  sculptor.closed_sheet({10, 8}, jevans::revolved(translation({0.235, 0.16, 0.815}), [](double v) {
                          return std::pair{0.032 * std::cos(0.49 * kPi * v), 0.03 * std::sin(0.49 * kPi * v)};
                        }));
  sculptor.box(translation({0.21, 0.2, 0.82}), {0.012, 0.01, 0.004});
  for (const double side : {0.0, 1.0}) {
    sculptor.material(kWhite);
    const auto grip = [=](double v) {
      return handlebar(side == 0 ? 0.12 * (1 - v) - 0.005 : 0.885 + 0.12 * v);
    };
    sculptor.closed_sheet({8, 12}, jevans::tube(grip, {0, 0, 1}, [](double v) {
                            return 0.016 + 0.002 * std::cos(2 * kPi * 10 * v);
                          }));
    // Ten streamers fan out from the end of the grip.
    const Vec3d end = grip(1);
    for (int k = 0; k < 10; ++k) {
      sculptor.material(k % 2 ? kRed : kWhite);
      const Vec3d fan = on_circle(k / 10.0);
      const auto streamer = [=](double v) {
        const double spread = 0.012 + 0.07 * v;
        return end + Vec3d{-0.1 * v + spread * fan.x, (2 * side - 1) * 0.05 * v + spread * fan.y,
                           -0.25 * v * v + 0.01 * std::sin(9 * v + k) - 0.002 * k * v};
      };
      sculptor.sheet({3, 12}, jevans::tube(streamer, {0.3, 1, 0.2}, [](double) { return 0.003; }));
    }
  }
}

void pedals(Sculptor& sculptor) {
  const auto together = sculptor.part();
  for (const double side : {-1.0, 1.0}) {
    const Vec3d hub{0.45, 0.075 * side, 0.25}, end{0.45 + 0.085 * side, 0.085 * side, 0.25 - 0.06 * side};
    sculptor.material(kChrome);
    sculptor.closed_sheet({4, 2}, jevans::rod(hub, end, 0.009));
    sculptor.material(kRubber);
    sculptor.closed_sheet({6, 5}, jevans::rounded_box(translation(end + Vec3d{0, 0.045 * side, 0}),
                                                      {0.035, 0.045, 0.014}, 0.3));
  }
}

/// A basket of wire in front of the handlebar: four hoops that widen upwards, and sixteen wires.
void basket(Sculptor& sculptor) {
  const auto together = sculptor.part();
  sculptor.material(kChrome);
  const auto hoop_radius = [](double h) { return 0.085 + 0.03 * h; };
  const Affine base = translation({0.47, 0, 0.62});
  for (int hoop = 0; hoop < 4; ++hoop)
    sculptor.sheet({16, 3, Seam::both}, jevans::torus(compose(base, translation({0, 0, 0.045 * hoop})),
                                                      hoop_radius(hoop / 3.0), 0.0035));
  for (int wire = 0; wire < 16; ++wire) {
    const Vec3d out = on_circle(wire / 16.0);
    sculptor.sheet({3, 4}, jevans::rod(base(out * hoop_radius(0)),
                                       base(out * hoop_radius(1) + Vec3d{0, 0, 0.135}), 0.0022));
  }
}

void yard(Sculptor& sculptor) {
  const auto together = sculptor.part();
  const auto square = [](double half, double z) {
    return std::array{Vec3d{-half, -half, z}, Vec3d{half, -half, z}, Vec3d{half, half, z},
                      Vec3d{-half, half, z}};
  };
  sculptor.material({{0.7, 0.68, 0.64}, 0.9, 0, 100000, 0, 1});
  sculptor.polygon(square(0.9, 0));
  sculptor.material({{0.3, 0.6, 0.25}, 0.9, 0, 100000, 0, 1});
  sculptor.polygon(square(1.5, -0.02));
}

void model(Sculptor& sculptor) {
  wheel(sculptor, {0.45, 0, 0.25}, 0.25, 24, 28);
  for (const double side : {-1.0, 1.0}) wheel(sculptor, {-0.38, 0.27 * side, 0.17}, 0.17, 20, 20);
  frame_and_fork(sculptor);
  saddle(sculptor);
  steering(sculptor);
  pedals(sculptor);
  basket(sculptor);
  yard(sculptor);
}

void generate(const SceneOptions& options, const Arguments&, SceneBuilder& builder) {
  builder.background({0.6, 0.75, 0.9});
  builder.view(
      {.from = {1.55, -1.75, 1.15}, .at = {0.03, 0, 0.38}, .up = {0, 0, 1}, .angle = 32, .hither = 0.01});
  builder.light({2, -4, 5});
  builder.light({-4, -2, 4});
  Sculptor sculptor(options.size, &builder);
  model(sculptor);
}

double object_count(const SceneOptions& options, const Arguments&) {
  Sculptor counter(options.size);
  model(counter);
  return counter.polygons();
}

}  // namespace

const SceneGenerator& scene_trike() {
  static const SceneGenerator generator{
      .id = "trike",
      .title = "Tricycle",
      .source = jevans::kPaper,
      .default_size = 4,
      .min_size = 1,
      .purpose = "dense places of irregular extents in a scene that is not large; 8146 size^2 + 62 polygons",
      .parameters = {},
      .object_count = object_count,
      .generate = generate};
  return generator;
}

}  // namespace rayshoot
