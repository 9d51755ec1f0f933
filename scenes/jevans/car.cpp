// car, a saloon with all that is under its skin (after Jevans 1990)
//
// Purpose    One complex object of regular extents at the middle of a scene hardly twice as long as it is. A uniform grid
//            is too coarse for it; of the others none has an advantage, because neither the scene nor the object favours
//            an axis. Paint, chrome and glass spread many secondary rays.
// Idea       A body drawn through cross-sections, with wheel arches and an open cabin under a glass house; seats, wheels
//            with discs and springs, an engine of eight cylinders with its pipes, grille, lamps and bumpers.
// Size       12368 size^2 + 113 polygons: 1 → 12481, 4 → 198001 (default, Jevans' number), 8 → 791665.

#include "scenes/jevans/sculptor.h"

namespace rayshoot {

namespace {

using jevans::ellipsoid;
using jevans::kPi;
using jevans::on_circle;
using jevans::rod;
using jevans::rounded_box;
using jevans::Sculptor;
using jevans::Seam;
using jevans::torus;
using jevans::tube;

const Material kPaint{{0.05, 0.2, 0.65}, 0.7, 0.2, 60, 0, 1};
const Material kChrome{{0.8, 0.8, 0.82}, 0.45, 0.45, 80, 0, 1};
const Material kGlass{{0.7, 0.85, 0.85}, 0.1, 0.15, 200, 0.75, 1};
const Material kRubber{{0.1, 0.1, 0.1}, 0.9, 0, 100000, 0, 1};
const Material kLeather{{0.6, 0.35, 0.2}, 0.85, 0.03, 20, 0, 1};
const Material kIron{{0.35, 0.35, 0.38}, 0.8, 0.1, 20, 0, 1};
const Material kLamp{{0.95, 0.95, 0.85}, 0.8, 0.2, 100, 0, 1};
const Material kTailLamp{{0.8, 0.05, 0.02}, 0.8, 0.1, 60, 0, 1};

constexpr double kHalfLength = 2.15;
constexpr double kAxle = 1.3, kTrack = 0.72, kWheel = 0.32;

double power(double x, double exponent) { return std::copysign(std::pow(std::abs(x), exponent), x); }
double step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}
auto thick(double radius) {
  return [=](double) { return radius; };
}

/// Height of the waistline: bonnet, cabin, boot.
double waist(double x) { return 0.78 + 0.16 * step(1.9, 0.7, x) - 0.1 * step(-1.2, -2.1, x); }

/// The body at a fraction u around the cross-section at v, from tail to nose.
Vec3d body(double u, double v) {
  const double x = kHalfLength * power(2 * v - 1, 0.9);
  const double taper = std::pow(1 - std::pow(std::abs(x) / (kHalfLength + 0.01), 7), 0.4);
  const double low = 0.2 + 0.12 * (1 - taper), high = low + (waist(x) - low) * (0.55 + 0.45 * taper);
  const Vec3d c = on_circle(u);
  const double y = 0.84 * (0.8 + 0.2 * taper) * power(c.x, 0.35) * (1 - 0.05 * c.y);
  double z = 0.5 * (low + high) + 0.5 * (high - low) * power(c.y, 0.45);
  // Leave room for the wheels from below and for the cabin from above.
  const double along = std::abs(std::abs(x) - kAxle), arch = 1.2 * kWheel;
  if (along < arch && std::abs(y) > 0.45) z = std::max(z, kWheel + std::sqrt(arch * arch - along * along));
  if (x > -1.05 && x < 0.62 && std::abs(y) < 0.68) z = std::min(z, 0.42);
  return {x, y, z};
}

/// The glass house, from the waist (v = 0) to the edge of the roof (v = 1) and on to the top of the roof (v = 2).
Vec3d house(double u, double v) {
  const double up = std::min(v, 1.0), in = std::max(0.0, v - 1);
  const Vec3d c = on_circle(u);
  const double front = 0.82 - 0.62 * up, back = -1.4 + 0.45 * up;
  const double shrink = 1 - std::pow(in, 1.6) * 0.97;
  const double half_length = 0.5 * (front - back) * shrink, half_width = (0.76 - 0.14 * up) * shrink;
  return {0.5 * (front + back) + half_length * power(c.x, 0.4), half_width * power(c.y, 0.4),
          0.9 + 0.38 * up + 0.07 * std::sqrt(1 - shrink * shrink)};
}

void shell(Sculptor& sculptor) {
  const auto together = sculptor.part();
  sculptor.material(kPaint);
  sculptor.closed_sheet({24, 40}, body);
  const auto roof = [](double u, double v) { return house(u, 1 + v); };
  sculptor.sheet({20, 7}, roof);
  sculptor.cap({20, 7}, roof, 1);
  for (const double corner : {0.09, 0.25, 0.41, 0.59, 0.75, 0.91})
    sculptor.sheet({4, 8}, tube([=](double v) { return house(corner, v); }, {0.2, 1, 0.1}, thick(0.022)));
  sculptor.material(kGlass);
  sculptor.sheet({20, 8}, house);
}

void trim(Sculptor& sculptor) {
  const auto together = sculptor.part();
  sculptor.material(kChrome);
  for (const double end : {-1.0, 1.0}) {
    const auto bumper = [=](double v) {
      const double s = 1 - 2 * v;
      return Vec3d{end * (2.2 - 0.3 * std::pow(std::abs(s), 4)), end * 0.84 * s, 0.29};
    };
    sculptor.closed_sheet({8, 18}, tube(bumper, {0, 0, 1}, thick(0.05)));
  }
  for (int bar = 0; bar < 12; ++bar) {
    const double y = -0.38 + 0.76 * bar / 11;
    const auto slat = [=](double v) { return Vec3d{2.16, y, 0.38 + 0.19 * v}; };
    sculptor.sheet({3, 8}, tube(slat, {0, 1, 0}, thick(0.012)));
  }
  for (const double side : {-1.0, 1.0}) {
    for (const double x : {-0.75, 0.1}) {
      const auto handle = [=](double v) {
        return Vec3d{x + 0.16 * v, side * (0.845 + 0.03 * std::sin(kPi * v)), 0.76};
      };
      sculptor.closed_sheet({4, 6}, tube(handle, {0, 0, 1}, thick(0.01)));
    }
    sculptor.closed_sheet({6, 5},
                          rounded_box(translation({0.62, 0.89 * side, 0.97}), {0.05, 0.1, 0.06}, 0.6));
    const Affine lamp = jevans::frame_along({2.16, 0.54 * side, 0.48}, {1, 0, 0.1});
    sculptor.sheet({12, 3, Seam::both}, torus(lamp, 0.1, 0.02));
    sculptor.material(kLamp);
    sculptor.closed_sheet({10, 4}, ellipsoid(lamp, {0.095, 0.095, 0.05}));
    sculptor.material(kTailLamp);
    sculptor.closed_sheet({6, 4},
                          rounded_box(translation({-2.15, 0.5 * side, 0.52}), {0.04, 0.14, 0.06}, 0.4));
    sculptor.material(kChrome);
    const auto exhaust = [=](double v) {
      return Vec3d{-0.9 - 1.4 * v, 0.35 * side, 0.2 + 0.04 * std::sin(4 * v)};
    };
    sculptor.sheet({6, 12}, tube(exhaust, {0, 0, 1}, thick(0.03)));
    const auto wiper = [=](double v) {
      return house(0.03 * side, 0.05 + 0.6 * v) + Vec3d{0.02, 0.25 * v, 0.02};
    };
    sculptor.sheet({3, 6}, tube(wiper, {0, 1, 0}, thick(0.006)));
  }
  for (const double end : {-1.0, 1.0}) sculptor.box(translation({2.25 * end, 0, 0.31}), {0.01, 0.25, 0.055});
  sculptor.closed_sheet({3, 4}, rod({-1.7, 0.6, 0.85}, {-1.85, 0.6, 1.5}, 0.005, 0.002));
}

void wheel(Sculptor& sculptor, double x, double side) {
  const auto together = sculptor.part();
  const Affine frame = jevans::frame_along({x, kTrack * side, kWheel}, {0, side, 0});
  sculptor.material(kRubber);
  sculptor.sheet({24, 8, Seam::both}, [=](double u, double v) {
    const double outward = std::max(0.0, -std::cos(2 * kPi * v));
    const double thickness = 0.075 * (1 + 0.06 * outward * std::cos(2 * kPi * 24 * u));
    return frame(on_circle(u) * (kWheel - 0.08 - thickness * std::cos(2 * kPi * v)) +
                 Vec3d{0, 0, -1.25 * thickness * power(std::sin(2 * kPi * v), 0.7)});
  });
  sculptor.material(kChrome);
  sculptor.sheet({20, 4}, jevans::revolved(frame, [](double v) {
                   return std::pair{0.185 - 0.03 * std::sin(kPi * v), 0.16 * (v - 0.5)};
                 }));
  for (int spoke = 0; spoke < 10; ++spoke) {
    const int pair = spoke / 2, twin = spoke % 2;
    const Vec3d inner = on_circle((pair + 0.12 * twin) / 5.0) * 0.04;
    const Vec3d outer = on_circle((pair + 0.3 * twin) / 5.0) * 0.175;
    sculptor.sheet({3, 3},
                   rod(frame(inner + Vec3d{0, 0, 0.05}), frame(outer + Vec3d{0, 0, 0.03}), 0.018, 0.012));
  }
  sculptor.closed_sheet({8, 3}, ellipsoid(compose(frame, translation({0, 0, 0.055})), {0.055, 0.055, 0.025}));
  for (int nut = 0; nut < 5; ++nut) {
    const Vec3d at = on_circle(nut / 5.0) * 0.038;
    sculptor.closed_sheet({3, 1}, rod(frame(at + Vec3d{0, 0, 0.06}), frame(at + Vec3d{0, 0, 0.09}), 0.008));
  }
  sculptor.material(kIron);
  sculptor.sheet({12, 1}, jevans::revolved(frame, [](double v) {
                   return std::pair{0.15 - 0.11 * v, -0.03};
                 }));
  const auto spring = [=](double v) {
    const double turn = 2 * kPi * 5 * v;
    return Vec3d{x + 0.05 * std::cos(turn), 0.52 * side + 0.05 * std::sin(turn), 0.36 + 0.3 * v};
  };
  sculptor.sheet({3, 24}, tube(spring, {0, 0, 1}, thick(0.01)));
}

void engine(Sculptor& sculptor) {
  const auto together = sculptor.part();
  const Vec3d centre{1.35, 0, 0.5};
  sculptor.material(kIron);
  sculptor.closed_sheet({8, 6}, rounded_box(translation(centre), {0.35, 0.2, 0.13}, 0.3));
  for (int k = 0; k < 8; ++k) {
    const int row = k / 2;
    const double side = k % 2 ? 1 : -1;
    const Vec3d head = centre + Vec3d{0.17 * row - 0.26, 0.12 * side, 0.08};
    const Vec3d top = head + Vec3d{0, 0.09 * side, 0.12};
    sculptor.material(kIron);
    sculptor.sheet({6, 3}, rod(head, top, 0.06, 0.05));
    sculptor.material(kChrome);
    const auto intake = [=](double v) {
      return top + (Vec3d{centre.x, 0, 0.74} - top) * v + Vec3d{0, 0, 0.06 * std::sin(kPi * v)};
    };
    sculptor.sheet({4, 5}, tube(intake, {1, 0.1, 0.1}, thick(0.016)));
    const auto exhaust = [=](double v) {
      return top + Vec3d{(0.75 - top.x) * v * v, side * 0.07 * std::sin(kPi * v), -0.3 * v};
    };
    sculptor.sheet({4, 6}, tube(exhaust, {0.1, 1, 0.1}, thick(0.016)));
  }
  sculptor.sheet({16, 4, Seam::both}, torus(translation({centre.x, 0, 0.77}), 0.1, 0.03));
  sculptor.material(kRubber);
  const Affine front = jevans::frame_along(centre + Vec3d{0.42, 0, 0}, {1, 0, 0});
  sculptor.sheet({12, 3, Seam::both}, torus(front, 0.09, 0.012));
  sculptor.sheet({12, 3, Seam::both}, torus(front, 0.19, 0.008));
  for (int blade = 0; blade < 7; ++blade)
    sculptor.sheet({2, 4, Seam::none}, [=](double u, double v) {
      return front(on_circle((blade + 0.5 * u) / 7.0) * (0.03 + 0.14 * v) + Vec3d{0, 0, 0.06 * (u - 0.5)});
    });
}

void cabin(Sculptor& sculptor) {
  const auto together = sculptor.part();
  sculptor.material(kLeather);
  const auto upright = [](const Vec3d& at) { return compose(translation(at), rotation({0, 1, 0}, -0.25)); };
  for (const double side : {-1.0, 1.0}) {
    sculptor.closed_sheet({10, 8},
                          rounded_box(translation({-0.02, 0.34 * side, 0.52}), {0.25, 0.24, 0.09}, 0.5));
    sculptor.closed_sheet({10, 10}, rounded_box(upright({-0.3, 0.34 * side, 0.78}), {0.08, 0.23, 0.3}, 0.5));
    sculptor.closed_sheet({6, 5}, rounded_box(upright({-0.38, 0.34 * side, 1.12}), {0.05, 0.13, 0.08}, 0.6));
  }
  sculptor.closed_sheet({16, 8}, rounded_box(translation({-0.72, 0, 0.53}), {0.22, 0.6, 0.09}, 0.4));
  sculptor.closed_sheet({16, 10}, rounded_box(upright({-0.98, 0, 0.8}), {0.08, 0.58, 0.27}, 0.4));
  sculptor.material(kRubber);
  sculptor.closed_sheet({16, 8}, rounded_box(translation({0.6, 0, 0.83}), {0.14, 0.66, 0.09}, 0.4));
  const Affine steering = jevans::frame_along({0.28, 0.34, 0.88}, {-1, 0, 0.45});
  sculptor.sheet({16, 4, Seam::both}, torus(steering, 0.18, 0.015));
  for (int spoke = 0; spoke < 3; ++spoke)
    sculptor.sheet({3, 1},
                   rod(steering({0, 0, -0.02}), steering(on_circle(spoke / 3.0 + 0.25) * 0.18), 0.012));
  sculptor.sheet({4, 2}, rod({0.3, 0, 0.42}, {0.2, 0, 0.72}, 0.012, 0.02));
  sculptor.sheet({5, 3}, rod(steering({0, 0, -0.35}), steering({0, 0, 0}), 0.025));
}

void road(Sculptor& sculptor) {
  const auto together = sculptor.part();
  const auto lie = [&](double x, double y, double half_length, double half_width, double z) {
    sculptor.polygon(
        std::array{Vec3d{x - half_length, y - half_width, z}, Vec3d{x + half_length, y - half_width, z},
                   Vec3d{x + half_length, y + half_width, z}, Vec3d{x - half_length, y + half_width, z}});
  };
  sculptor.material({{0.5, 0.5, 0.5}, 0.9, 0, 100000, 0, 1});
  lie(0, 0, 4, 3, 0);
  sculptor.material({{0.95, 0.95, 0.9}, 0.9, 0, 100000, 0, 1});
  for (const double x : {-2.7, 0.0, 2.7}) lie(x, -1.9, 0.6, 0.07, 0.002);
}

void model(Sculptor& sculptor) {
  shell(sculptor);
  trim(sculptor);
  for (const double x : {-kAxle, kAxle})
    for (const double side : {-1.0, 1.0}) wheel(sculptor, x, side);
  engine(sculptor);
  cabin(sculptor);
  road(sculptor);
}

void generate(const SceneOptions& options, const Arguments&, SceneBuilder& builder) {
  builder.background({0.6, 0.75, 0.9});
  builder.view(
      {.from = {5.2, -4.6, 2.3}, .at = {0.35, 0, 0.45}, .up = {0, 0, 1}, .angle = 38, .hither = 0.01});
  builder.light({5, -8, 9});
  builder.light({-6, -7, 8});
  Sculptor sculptor(options.size, &builder);
  model(sculptor);
}

double object_count(const SceneOptions& options, const Arguments&) {
  Sculptor counter(options.size);
  model(counter);
  return counter.polygons();
}

}  // namespace

const SceneGenerator& scene_car() {
  static const SceneGenerator generator{
      .id = "car",
      .title = "Car",
      .source = jevans::kPaper,
      .default_size = 4,
      .min_size = 1,
      .purpose =
          "one complex object of regular extents, with paint, chrome and glass; 12368 size^2 + 113 polygons",
      .parameters = {},
      .object_count = object_count,
      .generate = generate};
  return generator;
}

}  // namespace rayshoot
