// replay, STIFF 28: cases that broke other libraries
//
// Construction  Ray 0 is the one reported, where its bits are public: VK-GL-CTS #446, the triangle of
//               pbrt-v4's test BadCases, tinybvh #283, madmann91 bvh #20. Further rays of these settings are
//               neighbours of it. Labels that begin with `like` are in the manner of a report whose bits are
//               not public or belong to a large mesh: embree #174, #181, #387, #423, libigl #2232, #2270,
//               madmann91 bvh #51; every ray of theirs is drawn from the situation described.
// Property      A hit on shared edges and vertices; otherwise graded by the oracle.
// Metric        Pass or fail for each setting.
// Size          The same settings at every size.
// Anchor        Each was a wrong answer of a library in use when it was reported.

#include <array>
#include <numbers>

#include "scenes/stiff/parts/scenes.h"
#include "scenes/stiff/parts/solids.h"
#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

namespace {

using namespace stiff;

using Number = std::uint64_t;

/// The floats of three bit patterns.
Vec3d bits(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return {float_of(x), float_of(y), float_of(z)};
}

// ---------------------------------------------------------------- to the bit

/// Two triangles that fold over their common edge, which the ray meets; further rays meet it elsewhere.
void vk_cts_446(SceneBuilder& builder) {
  const Vec3d a = bits(0x3f800000, 0, 0xbf800000), b = bits(0, 0x3f800000, 0xbf800000);
  builder.triangle(a, b, bits(0x3ec83ac8, 0x3f1be29d, 0xbed79c23));
  builder.triangle(b, a, bits(0x3e8f7a0c, 0x3f353a70, 0xbf4fab47));
}
Ray<double> ray_of_vk_cts_446(const RandomNumbers& random, Number number) {
  const double pixel = number == 0 ? 240 : pick(random, number, 0, 0, 255);
  const double x = (pixel + 0.5) / 256;
  return {.origin = {x, 1 - x, 0}, .direction = {0, 0, -1}};
}

/// Three points in one line: no triangle to hit.
void pbrt_bad_cases(SceneBuilder& builder) {
  builder.triangle(rounded(Vec3d{-1113.45459, -79.049614, -56.2431908}),
                   rounded(Vec3d{-1113.45459, -87.0922699, -56.2431908}),
                   rounded(Vec3d{-1113.45459, -79.2090149, -56.2431908}));
}
Ray<double> ray_of_pbrt_bad_cases(const RandomNumbers& random, Number number) {
  Ray<double> ray{.origin = rounded(Vec3d{-1081.47925, 99.9999542, 87.7701111}),
                  .direction = rounded(Vec3d{-32.1072998, -183.355865, -144.607635}),
                  .t_max = 0.9999f};
  for (int axis = 0; axis < 3 && number > 0; ++axis)
    ray.direction[axis] =
        floats_above(ray.direction[axis], pick(random, number, static_cast<Number>(axis), -4, 4));
  return ray;
}

/// A triangle of 0.2 mm in a scene measured in metres.
constexpr double kSmall = 2e-4f;
void tinybvh_283(SceneBuilder& builder) { builder.triangle({0, 0, 0}, {kSmall, 0, 0}, {0, kSmall, 0}); }
Ray<double> ray_of_tinybvh_283(const RandomNumbers& random, Number number) {
  const auto share = [&](Number dimension) {
    return number == 0 ? 1.0 / 3 : 0.01 + 0.48 * random.uniform(number, dimension);
  };
  return {.origin = rounded(Vec3d{share(0) * kSmall, share(1) * kSmall, -1}), .direction = {0, 0, 1}};
}

/// A direction with a negative zero, at two triangles behind one another.
void madmann_20(SceneBuilder& builder) {
  for (const double z : {1.0, static_cast<double>(2.1f)}) builder.triangle({1, -1, z}, {1, 1, z}, {-1, 1, z});
}
Ray<double> ray_of_madmann_20(const RandomNumbers& random, Number number) {
  const auto place = [&](Number dimension) {
    return number == 0 ? 0.25 : pick(random, number, dimension, 0, 255) / 256.0;
  };
  return {.origin = {place(0), place(1), 0}, .direction = {0, -0.0, 1}, .t_max = 100};
}

// ---------------------------------------------------------------- in the manner of

/// Half of a sphere, its pole and its rings of vertices; rays to vertices off the rim, from the middle.
constexpr int kSectors = 24, kRings = 12;
Vec3d on_globe(int sector, int latitude) {
  const double u = 2 * std::numbers::pi * (sector % kSectors) / kSectors,
               v = std::numbers::pi * latitude / kRings;
  const double across = latitude == 0 || latitude == kRings ? 0 : std::sin(v);
  return snapped(Vec3d{across * std::cos(u), across * std::sin(u), std::cos(v)}, kStep);
}
void add_globe(SceneBuilder& builder, int last_latitude) {
  for (int latitude = 0; latitude < last_latitude; ++latitude)
    for (int sector = 0; sector < kSectors; ++sector) {
      const Vec3d a = on_globe(sector, latitude), b = on_globe(sector + 1, latitude);
      const Vec3d c = on_globe(sector + 1, latitude + 1), d = on_globe(sector, latitude + 1);
      if (latitude > 0) builder.triangle(a, d, b);
      if (latitude + 1 < kRings) builder.triangle(b, d, c);
    }
}
void embree_174(SceneBuilder& builder) { add_globe(builder, kRings / 2); }
Ray<double> ray_of_embree_174(const RandomNumbers& random, Number number) {
  const Vec3d origin = snapped(point_in_cube(random, number, 0) * 0.125, kStep) + Vec3d{0, 0, 0.25};
  const int sector = pick(random, number, 3, 0, kSectors - 1),
            latitude = pick(random, number, 4, 0, kRings / 2 - 1);
  return ray_to(origin, on_globe(sector, latitude));
}

/// Ten tubes in one another, and an eleventh around; rays from between two of them to a vertex of the outer one.
constexpr int kTubes = 10, kFacets = 32, kStoreys = 4;
Vec3d on_tube(int tube, int facet, int storey) {
  const double angle = 2 * std::numbers::pi * (facet % kFacets) / kFacets, radius = 0.08 * tube;
  return snapped(Vec3d{radius * std::cos(angle), radius * std::sin(angle), 0.25 * storey}, kStep);
}
void embree_181(SceneBuilder& builder) {
  for (int tube = 1; tube <= kTubes + 1; ++tube)
    for (int storey = 0; storey < kStoreys; ++storey)
      for (int facet = 0; facet < kFacets; ++facet) {
        const Vec3d a = on_tube(tube, facet, storey), c = on_tube(tube, facet + 1, storey + 1);
        builder.triangle(a, on_tube(tube, facet + 1, storey), c);
        builder.triangle(a, c, on_tube(tube, facet, storey + 1));
      }
}
Ray<double> ray_of_embree_181(const RandomNumbers& random, Number number) {
  const int facet = pick(random, number, 0, 0, kFacets - 1),
            storey = pick(random, number, 1, 1, kStoreys - 1);
  const int tube = pick(random, number, 2, 1, kTubes - 1);
  const Vec3d inner = on_tube(tube, facet, storey), outer = on_tube(tube + 1, facet, storey);
  return ray_to(snapped(inner * 0.25 + outer * 0.75, kStep), outer);
}

/// A skinny triangle (edges of 11.2, 9.7 and 1.4) met at half a degree from up to 600 away.
constexpr double kSkinnyHeight = 0.57;
void embree_387(SceneBuilder& builder) {
  builder.triangle({-5.5, 0, 300}, rounded(Vec3d{5.7, 0.1, 300.4}),
                   rounded(Vec3d{4.2, kSkinnyHeight, 300.2}));
}
Ray<double> ray_of_embree_387(const RandomNumbers& random, Number number) {
  const double angle = 2 * std::numbers::pi * random.uniform(number, 0), slope = 0.0091;
  const double distance = 100 + 500 * random.uniform(number, 1);
  const Vec3d target = Vec3d{0, 0, 300.2} + point_in_cube(random, number, 2) * 2;
  const Vec3d way{std::cos(angle), std::sin(angle), slope};
  const Vec3d origin = rounded(target - way * distance);
  return {.origin = origin, .direction = rounded(normalized(way))};
}

/// Edges of one mesh as segments against a triangle of another that lies nearly in one plane with them, apart.
void embree_423(SceneBuilder& builder) {
  builder.triangle(rounded(Vec3d{0.23, 1.35, -0.41}), rounded(Vec3d{0.27, 1.38, -0.4}),
                   rounded(Vec3d{0.31, 1.33, -0.42}));
}
Ray<double> ray_of_embree_423(const RandomNumbers& random, Number number) {
  const Vec3d a{0.23, 1.35, -0.41}, ab{0.04, 0.03, 0.01}, ac{0.08, -0.02, -0.01};
  const auto in_plane = [&](Number dimension) {
    return a + ab * (20 * random.uniform(number, dimension) + 2) +
           ac * (20 * random.uniform(number, dimension + 1) + 2);
  };
  Ray<double> segment = ray_to(in_plane(0), in_plane(2));
  segment.t_max = 1;
  return segment;
}

/// Four triangles of a kite; rays with zeros in their directions from points above its vertices, in planes of its box.
constexpr std::array kKite = {Vec3d{-1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{1, 0, 0}, Vec3d{0, -1, 0},
                              Vec3d{0, 0, 0}};
void libigl_2232(SceneBuilder& builder) {
  for (std::size_t i = 0; i < 4; ++i) builder.triangle(kKite[i], kKite[(i + 1) % 4], kKite[4]);
}
Ray<double> ray_of_libigl_2232(const RandomNumbers& random, Number number) {
  const Vec3d target = kKite[random.bits(number, 0) % kKite.size()];
  return {.origin = target + Vec3d{0, 0, 1.0 * pick(random, number, 1, 1, 8)}, .direction = {0, 0, -1}};
}

/// Triangles whose vertices are corners of their boxes; rays that touch such a box in the corner alone, obliquely.
void libigl_2270(SceneBuilder& builder) {
  for (int i = 0; i < 27; ++i) {
    const Vec3d lo = snapped(Vec3d{i % 3 * 0.6 - 0.9, i / 3 % 3 * 0.6 - 0.9, i / 9 * 0.6 - 0.9}, kStep);
    const Vec3d size = snapped(Vec3d{0.31, 0.23, 0.17}, kStep);
    builder.triangle(lo, lo + Vec3d{size.x, size.y, 0}, lo + Vec3d{0, size.y, size.z});
  }
}

/// A globe before a camera whose pixels have whole coordinates, so that many lie on its edges.
void madmann_51(SceneBuilder& builder) { add_globe(builder, kRings); }
Ray<double> ray_of_madmann_51(const RandomNumbers& random, Number number) {
  const double x = pick(random, number, 0, -64, 64), y = pick(random, number, 1, -64, 64);
  return {.origin = {0, 0, 4}, .direction = {x, y, -240}};
}

std::vector<StiffSetting> settings(int, std::uint64_t) {
  std::vector<StiffSetting> result;
  const auto add = [&](const std::string& label, void (*build)(SceneBuilder&), const RayMaker& ray,
                       Property property) {
    SceneBuilder builder;
    build(builder);
    result.push_back({.label = label,
                      .scene = share(std::move(builder), "replay(" + label + ")"),
                      .rays = ray_by_ray(ray),
                      .property = property,
                      .stiffness_parameter = static_cast<double>(result.size()),
                      .default_rays = 500});
  };
  add("case=vk_cts_446", vk_cts_446, ray_of_vk_cts_446, Property::always_hit);
  add("case=pbrt_bad_cases", pbrt_bad_cases, ray_of_pbrt_bad_cases, Property::never_hit);
  add("case=tinybvh_283", tinybvh_283, ray_of_tinybvh_283, Property::always_hit);
  add("case=madmann_20", madmann_20, ray_of_madmann_20, Property::as_oracle);
  add("like=embree_174", embree_174, ray_of_embree_174, Property::always_hit);
  add("like=embree_181", embree_181, ray_of_embree_181, Property::always_hit);
  add("like=embree_387", embree_387, ray_of_embree_387, Property::as_oracle);
  add("like=embree_423", embree_423, ray_of_embree_423, Property::never_hit);
  add("like=libigl_2232", libigl_2232, ray_of_libigl_2232, Property::always_hit);
  SceneBuilder corners;
  libigl_2270(corners);
  add(
      "like=libigl_2270", libigl_2270,
      [scene = std::move(corners).finish()](const auto& random, Number number) {
        return lattice_ray(scene, random, 2 * number, kStep, 0.5);
      },
      Property::always_hit);
  add("like=madmann_51", madmann_51, ray_of_madmann_51, Property::as_oracle);
  return result;
}

}  // namespace

const StiffCase& stiff_replay() {
  static const StiffCase entry{
      .id = "replay",
      .number = 28,
      .title = "Cases that broke other libraries",
      .construction =
          "scenes and rays of reports about other ray tracers, to the bit where they are published",
      .property = "as the exact oracle says",
      .metric = "pass or fail for each",
      .settings = settings};
  return entry;
}

}  // namespace rayshoot
