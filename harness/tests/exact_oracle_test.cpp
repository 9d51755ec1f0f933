#include "harness/verify/exact_oracle.h"

#include <gtest/gtest.h>

#include "accel/tests/nasty_scenes.h"
#include "harness/verify/exact/bounded.h"
#include "rational_tracer.h"

namespace rayshoot::test {
namespace {

using nasty::lattice_point;
using nasty::Random;
using nasty::uniform;

template <class Real>
class ExactOracleTest : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(ExactOracleTest, Scalars);

int integer(Random& random, int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(random); }

/// Objects of all kinds with small integer coordinates, so that borders, tangents and equal distances are met
/// exactly and often.
Scene lattice_soup(Random& random) {
  SceneBuilder builder;
  for (int i = 0; i < 4; ++i) {
    const auto point = [&] { return lattice_point(random, -3, 3); };
    builder.triangle(point(), point(), point());
    builder.sphere(point(), integer(random, 1, 3));
    builder.cone(point(), integer(random, 0, 2), point(), integer(random, 0, 2));
    const Vec3d corner = point(), u = point(), v = point();
    builder.polygon(std::array{corner, corner + 2 * u, corner + 2 * u + v, corner + u + v, corner + u + 2 * v,
                               corner + 2 * v});
    // One that is not flat.
    const auto lifted = [&](double x, double y) { return corner + Vec3d{x, y, 1.0 * integer(random, 0, 3)}; };
    builder.polygon(std::array{lifted(0, 0), lifted(3, -1), lifted(4, 3), lifted(1, 2), lifted(-1, 3)});
  }
  return std::move(builder).finish();
}

template <class Real>
std::vector<Ray<Real>> lattice_rays(Random& random, int count) {
  std::vector<Ray<Real>> rays;
  for (int i = 0; i < count; ++i) {
    const Vec3d origin = lattice_point(random, -6, 6);
    const Vec3d direction = i % 2 == 0 ? lattice_point(random, -3, 3) - origin : lattice_point(random, -2, 2);
    Ray<Real> ray{.origin = Vec3<Real>(origin), .direction = Vec3<Real>(direction)};
    if (i % 5 == 0) ray.t_min = static_cast<Real>(0.5 * integer(random, 0, 2));
    if (i % 11 == 0) ray.direction[i % 3] *= std::numeric_limits<Real>::denorm_min();
    if (i % 7 == 0) ray.t_max = static_cast<Real>(0.5 * integer(random, 1, 4));
    rays.push_back(ray);
  }
  return rays;
}

/// Rays for a scene that is `size` times as large, with directions `stride` times as long.
template <class Real>
std::vector<Ray<Real>> scaled(std::vector<Ray<Real>> rays, double size, double stride) {
  const auto scaled_end = [&](Real t) {
    return static_cast<Real>(std::min<double>(t * size / stride, std::numeric_limits<Real>::max()));
  };
  for (Ray<Real>& ray : rays) {
    ray.origin *= static_cast<Real>(size), ray.direction *= static_cast<Real>(stride);
    ray.t_min = scaled_end(ray.t_min), ray.t_max = scaled_end(ray.t_max);
  }
  return rays;
}

template <class Real>
bool rounded_to_nearest(Real t, const mpf_class& right) {
  const auto apart = [&](Real x) {
    return mpf_class(abs(mpf_class(static_cast<double>(x), rational::kBits) - right));
  };
  const mpf_class own = apart(t);
  return own <= apart(std::nextafter(t, kMiss<Real>)) && own <= apart(std::nextafter(t, -kMiss<Real>));
}

template <class Real>
std::string described(const Ray<Real>& ray) {
  std::ostringstream text;
  text << std::hexfloat << ray.origin.x << ' ' << ray.origin.y << ' ' << ray.origin.z << " along "
       << ray.direction.x << ' ' << ray.direction.y << ' ' << ray.direction.z << " in (" << ray.t_min << ", "
       << ray.t_max << "]";
  return text.str();
}

/// Hold the oracle against the textbook on all pairs of rays and objects; returns their number.
template <class Real>
std::size_t compare(const Geometry<Real>& geometry, const std::vector<Ray<Real>>& rays) {
  const ExactOracle<Real> oracle(geometry);
  std::size_t pairs = 0;
  for (const Ray<Real>& ray : rays) {
    if (!is_finite(ray.origin) || !is_finite(ray.direction)) continue;
    pairs += geometry.size();
    const rational::Nearest right = rational::nearest(geometry, ray);
    const ExactHit<Real> hit = oracle.nearest(ray);
    EXPECT_EQ(hit.objects, right.objects) << described(ray);
    if (hit.objects != right.objects) continue;
    const AnswerClass missed = oracle.grade(ray, {}).answer;
    if (right.objects.empty()) {
      EXPECT_EQ(missed, AnswerClass::exact) << described(ray);
      continue;
    }
    EXPECT_TRUE(rounded_to_nearest(hit.t, *right.t)) << described(ray);
    EXPECT_TRUE(missed == AnswerClass::false_miss || missed == AnswerClass::ambiguous) << described(ray);
    for (const std::uint32_t object : right.objects) {
      const Grade grade = oracle.grade(ray, {hit.t, object});
      EXPECT_EQ(grade.answer, AnswerClass::exact) << described(ray);
      EXPECT_LE(grade.ulps_of_t, 0.502) << described(ray);
    }
  }
  return pairs;
}

TEST(ExactFilter, BoundsHoldTheExactNumber) {
  Random random(8);
  const auto number = [&] { return std::ldexp(uniform(random, -1, 1), integer(random, -3, 3)); };
  const auto bound = [](double x) { return exact::Bounded<double>(x); };
  for (int i = 0; i < 20'000; ++i) {
    // Differences of nearly equal numbers make the errors of operands matter.
    const double a = number(), b = a * (1 + 1e-14 * number()), c = number(), d = c * (1 + 1e-9 * number());
    const exact::Bounded<double> small = bound(a) * bound(c) - bound(b) * bound(d),
                                 e = bound(b) * bound(c) + bound(d);
    const mpq_class exact_small = mpq_class(a) * c - mpq_class(b) * d, exact_e = mpq_class(b) * c + d;
    const auto holds = [](const exact::Bounded<double>& x, const mpf_class& right) {
      return std::isinf(x.error) || (mpf_class(x.lowest()) <= right && right <= mpf_class(x.highest()));
    };
    EXPECT_TRUE(holds(small * e, rational::precise(exact_small * exact_e)));
    if (exact_small != 0) {
      EXPECT_TRUE(holds(e / small, rational::precise(exact_e / exact_small)));
    }
    if (exact_small > 0) {
      EXPECT_TRUE(holds(sqrt(small), sqrt(rational::precise(exact_small))));
    }
    if (const int s = sign(small); s != exact::kUnknown) {
      EXPECT_EQ(s, sgn(exact_small));
    }
  }
}

TYPED_TEST(ExactOracleTest, AgreesWithRationalArithmeticOnTheLattice) {
  Random random(3);
  std::size_t pairs = 0;
  for (int scene = 0; scene < 60; ++scene) {
    const ConeSides sides = scene % 2 == 0 ? ConeSides::both : ConeSides::outside;
    pairs += compare(Geometry<TypeParam>(lattice_soup(random), sides), lattice_rays<TypeParam>(random, 150));
  }
  EXPECT_GT(pairs, 100'000u);
}

TYPED_TEST(ExactOracleTest, AgreesWithRationalArithmeticOnNastyScenes) {
  std::size_t pairs = 0;
  for (const auto& [name, scene] : nasty::scenes())
    for (const double scale : nasty::kScales) {
      SCOPED_TRACE(name + " times " + std::to_string(scale));
      const Geometry<TypeParam> geometry(nasty::scaled(scene, scale));
      pairs += compare(geometry, nasty::rays<TypeParam>(geometry, scale, 6));
    }
  EXPECT_GT(pairs, 100'000u);
}

TYPED_TEST(ExactOracleTest, AgreesWithRationalArithmeticAtAllScales) {
  Random random(4);
  constexpr int range = std::is_same_v<TypeParam, float> ? 60 : 500;
  for (const int size : {-2 * range, -range, 0, range})
    for (const int stride :
         {std::ilogb(std::numeric_limits<TypeParam>::denorm_min()), -range, range, 2 * range}) {
      SCOPED_TRACE("size 2^" + std::to_string(size) + ", direction 2^" + std::to_string(stride));
      const Scene scene = nasty::scaled(lattice_soup(random), std::ldexp(1, size));
      const auto rays = lattice_rays<TypeParam>(random, 30);
      compare(Geometry<TypeParam>(scene), scaled(rays, std::ldexp(1, size), std::ldexp(1, stride)));
    }
}

TYPED_TEST(ExactOracleTest, AgreesWithRationalArithmeticFarFromTheOrigin) {
  Random random(6);
  for (const int shift : {4, 12, 20}) {
    SceneBuilder builder;
    nasty::soup(builder, random, 80);
    Scene scene = std::move(builder).finish();
    const Vec3d far = Vec3d{1, -0.75, 0.5} * std::ldexp(1, shift);
    for (auto& t : scene.triangles) t.a += far, t.b += far, t.c += far;
    for (auto& v : scene.polygon_vertices) v += far;
    for (auto& s : scene.spheres) s.centre += far;
    for (auto& c : scene.cones) c.base += far, c.apex += far;
    const Geometry<TypeParam> geometry(scene);
    EXPECT_GT(compare(geometry, nasty::rays<TypeParam>(geometry, 1, 20)), 8'000u);
  }
}

}  // namespace
}  // namespace rayshoot::test
