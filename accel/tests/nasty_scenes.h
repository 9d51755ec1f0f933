#pragma once

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "scenes/core/geometry.h"
#include "scenes/core/scene_builder.h"

/// Small scenes and rays on which acceleration techniques go wrong: what is named here stays here for ever.
namespace rayshoot::nasty {

struct NamedScene {
  std::string name;
  Scene scene;
};

using Random = std::mt19937_64;

inline double uniform(Random& random, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(random);
}
inline Vec3d uniform_point(Random& random, double lo, double hi) {
  return {uniform(random, lo, hi), uniform(random, lo, hi), uniform(random, lo, hi)};
}
/// A point with integer coordinates, where planes of grids and of boxes meet.
inline Vec3d lattice_point(Random& random, int lo, int hi) {
  const auto pick = [&] { return static_cast<double>(std::uniform_int_distribution<int>(lo, hi)(random)); };
  return {pick(), pick(), pick()};
}

inline void square(SceneBuilder& builder, const Vec3d& corner, const Vec3d& u, const Vec3d& v) {
  builder.polygon(std::array{corner, corner + u, corner + u + v, corner + v});
}

/// A bit of everything: all kinds of objects at random.
inline void soup(SceneBuilder& builder, Random& random, int count) {
  for (int i = 0; i < count; ++i) {
    const Vec3d p = uniform_point(random, -4, 4), q = p + uniform_point(random, -1, 1);
    switch (i % 4) {
      case 0:
        builder.triangle(p, q, p + uniform_point(random, -1, 1));
        break;
      case 1:
        builder.sphere(p, uniform(random, 0.05, 0.6));
        break;
      case 2:
        builder.cone(p, uniform(random, 0, 0.4), q, uniform(random, 0.01, 0.4));
        break;
      default:
        square(builder, p, q - p, cross(q - p, uniform_point(random, -1, 1)));
    }
  }
}

/// A mesh on integer coordinates: triangles share every vertex and edge, and lie in the planes of cells.
inline void lattice_mesh(SceneBuilder& builder) {
  for (int x = -4; x < 4; ++x)
    for (int y = -4; y < 4; ++y) {
      const Vec3d a{double(x), double(y), double((x + y) % 2)}, b = a + Vec3d{1, 0, 0},
                                                                c = a + Vec3d{1, 1, 0};
      builder.triangle(a, b, c);
      builder.triangle(c, a + Vec3d{0, 1, 0}, a);
    }
}

inline std::vector<NamedScene> scenes() {
  constexpr double inf = Box<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  const auto made = [](const std::function<void(SceneBuilder&, Random&)>& build) {
    SceneBuilder builder;
    Random random(7);
    build(builder, random);
    return std::move(builder).finish();
  };
  std::vector<NamedScene> all;
  const auto add = [&](const std::string& name, const std::function<void(SceneBuilder&, Random&)>& build) {
    all.push_back({name, made(build)});
  };

  add("empty", [](auto&, auto&) {});
  add("one triangle", [](auto& b, auto&) { b.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}); });
  add("one sphere", [](auto& b, auto&) { b.sphere({0, 0, 0}, 1); });
  add("one cone", [](auto& b, auto&) { b.cone({0, 0, -1}, 1, {0, 0, 1}, 0.25); });
  add("two objects", [](auto& b, auto&) { b.sphere({-1, 0, 0}, 1), b.sphere({1, 0, 0}, 1); });
  add("duplicates", [](auto& b, auto&) {
    for (int i = 0; i < 40; ++i) b.triangle({-1, -1, 0}, {2, -1, 0}, {-1, 2, 0}), b.sphere({0, 0, 1}, 0.5);
  });
  add("coplanar tiles", [](auto& b, auto&) {
    for (int i = 0; i < 30; ++i) square(b, {-3 + 0.15 * i, -2, 1}, {1, 0, 0}, {0, 4, 0});
  });
  add("flat scene", [](auto& b, auto&) {
    for (int i = -4; i < 4; ++i)
      for (int j = -4; j < 4; ++j) square(b, {double(i), double(j), 0}, {1, 0, 0}, {0, 1, 0});
  });
  add("lattice mesh", [](auto& b, auto&) { lattice_mesh(b); });
  add("soup", [](auto& b, auto& random) { soup(b, random, 120); });
  add("polygons that are not planar", [](auto& b, auto& random) {
    for (int i = 0; i < 60; ++i)
      b.polygon(std::array{lattice_point(random, -4, 4), uniform_point(random, -4, 4), uniform_point(random, -4, 4),
                           lattice_point(random, -4, 4)});
  });
  add("garbage among good objects", [=](auto& b, auto& random) {
    soup(b, random, 40);
    b.triangle({nan, 0, 0}, {1, 0, 0}, {0, 1, 0});
    b.triangle({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
    b.sphere({0, 0, inf}, 1), b.sphere({0, 0, 0}, nan), b.sphere({1, 1, 1}, 0);
    b.cone({0, 0, 0}, 1, {0, 0, 0}, 1), b.cone({0, 0, 0}, 0, {0, 0, 1}, 0);
    b.triangle({1e300, 0, 0}, {0, 1e300, 0}, {0, 0, 1e300});
    soup(b, random, 40);
  });
  add("needles", [](auto& b, auto& random) {
    for (int i = 0; i < 60; ++i) {
      const Vec3d p = uniform_point(random, -4, 4);
      b.triangle(p, -p, p + uniform_point(random, -1e-4, 1e-4));
    }
  });
  add("nested spheres", [](auto& b, auto&) {
    for (int i = 0; i < 40; ++i) b.sphere({0, 0, 0}, std::ldexp(4, -i / 2));
  });
  add("one large among many small", [](auto& b, auto& random) {
    b.sphere({0, 0, 0}, 1000);
    for (int i = 0; i < 100; ++i) b.sphere(uniform_point(random, 0, 1e-2), 1e-4);
  });
  add("far from the origin", [](auto& b, auto& random) {
    for (int i = 0; i < 80; ++i) b.sphere(Vec3d{1e4, -2e4, 5e3} + uniform_point(random, -4, 4), 0.3);
  });
  return all;
}

/// Every scene is also tried this much larger.
inline constexpr double kScales[] = {1.0, 1e-6, 1e6};

inline Scene scaled(Scene scene, double factor) {
  for (auto& t : scene.triangles) t.a *= factor, t.b *= factor, t.c *= factor;
  for (auto& v : scene.polygon_vertices) v *= factor;
  for (auto& s : scene.spheres) s.centre *= factor, s.radius *= factor;
  for (auto& c : scene.cones)
    c.base *= factor, c.apex *= factor, c.base_radius *= factor, c.apex_radius *= factor;
  return scene;
}

/// Rays that meet a geometry in every awkward way: along axes and diagonals through lattice points, towards
/// corners of bounds, from points on surfaces, from inside, from afar, with empty and short intervals, and
/// plain nonsense.
template <class Real>
std::vector<Ray<Real>> rays(const Geometry<Real>& geometry, double scale, int count) {
  Random random(11);
  std::vector<Ray<Real>> rays;
  const auto add = [&](const Vec3d& from, const Vec3d& along) {
    rays.push_back({.origin = Vec3<Real>(from), .direction = Vec3<Real>(along)});
  };
  const Box<double> box{Vec3d(geometry.bounds().lo), Vec3d(geometry.bounds().hi)};
  const bool empty = geometry.size() == 0;
  const auto inside = [&] {
    if (empty) return uniform_point(random, -1, 1);
    const Vec3d u = uniform_point(random, 0, 1), e = box.extent();
    return box.lo + Vec3d{u.x * e.x, u.y * e.y, u.z * e.z};
  };
  for (int i = 0; i < count; ++i) {
    // Random lines, axis-parallel and diagonal ones through lattice points, with both signs of zero.
    add(uniform_point(random, -9, 9) * scale, inside() - uniform_point(random, -9, 9) * scale);
    const Vec3d axis = lattice_point(random, -1, 1);
    add(lattice_point(random, -5, 5) * scale - axis * (8 * scale), axis);
    add(lattice_point(random, -5, 5) * scale, Vec3d{-0.0, axis.y, -0.0});
    add(inside(), uniform_point(random, -1, 1));
    add(uniform_point(random, -1e5, 1e5) * scale, inside());
    if (empty) continue;

    // Towards the corners of an object's bounds, and from a point on it.
    const auto object = std::uniform_int_distribution<std::uint32_t>(0, geometry.size() - 1)(random);
    const Box<Real> bounds = geometry.bounds(object);
    const Vec3d corner{double(i & 1 ? bounds.lo.x : bounds.hi.x), double(i & 2 ? bounds.lo.y : bounds.hi.y),
                       double(i & 4 ? bounds.lo.z : bounds.hi.z)};
    const Vec3d eye = uniform_point(random, -9, 9) * scale;
    add(eye, corner - eye);
    add(corner, inside() - corner);
    Ray<Real> ray{.origin = Vec3<Real>(eye), .direction = Vec3<Real>(inside() - eye)};
    const Real t = geometry.hit_distance(object, ray);
    if (t != kMiss<Real>) {
      rays.push_back({.origin = ray.at(t),
                      .t_min = static_cast<Real>(1e-4),
                      .direction = Vec3<Real>(uniform_point(random, -1, 1))});
      ray.t_max = t;
      rays.push_back(ray);
      ray.t_min = t, ray.t_max = std::numeric_limits<Real>::max();
      rays.push_back(ray);
    }
  }
  constexpr double inf = Box<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  add({0, 0, 0}, {0, 0, 0}), add({nan, 0, 0}, {1, 0, 0}), add({0, 0, 0}, {nan, nan, nan}),
      add({0, 0, 0}, {inf, 0, 0});
  add({inf, 0, 0}, {1, 0, 0}), add({-inf, 0, 0}, {1, 0, 0}), add({0, 0, 0}, {1e-30, 1e-35, 1}),
      add({0, 0, 0}, {1e30, 1, 1});
  rays.push_back({.origin = {-5, 0, 0}, .t_min = 3, .direction = {1, 0, 0}, .t_max = 2});
  return rays;
}

}  // namespace rayshoot::nasty
