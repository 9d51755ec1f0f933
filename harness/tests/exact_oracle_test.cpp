#include "harness/verify/exact_oracle.h"

#include <gtest/gtest.h>

#include "accel/tests/nasty_scenes.h"
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
    if (i % 7 == 0) ray.t_max = static_cast<Real>(0.5 * integer(random, 1, 4));
    rays.push_back(ray);
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

}  // namespace
}  // namespace rayshoot::test
