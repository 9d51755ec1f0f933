#include "accel/tests/conformance.h"

#include "accel/tests/built_engine.h"
#include "accel/tests/expressions.h"

namespace rayshoot {
namespace {

class Conformance : public ::testing::TestWithParam<const TechniqueEntry*> {};

/// Every kth element from the first on.
template <class Element>
std::vector<Element> strided(const std::vector<Element>& all, std::size_t first, std::size_t k) {
  std::vector<Element> some;
  for (std::size_t i = first; i < all.size(); i += k) some.push_back(all[i]);
  return some;
}

/// The default configuration on all rays, each of the others on a third of them.
template <class Real>
void check(const TechniqueEntry& entry, const Geometry<Real>& geometry, const std::vector<Ray<Real>>& rays) {
  const auto truths = conformance::truths<Real>(geometry, rays);
  const std::vector<conformance::Variant> variants = conformance::variants(entry);
  for (std::size_t i = 0; i < variants.size(); ++i) {
    SCOPED_TRACE(variants[i].name());
    const Arguments arguments = variants[i].arguments();
    const auto engine = entry.build<Real>({geometry, arguments});
    const std::size_t first = i == 0 ? 0 : i % 3, k = i == 0 ? 1 : 3;
    conformance::check_engine<Real>(*engine, strided(rays, first, k), strided(truths, first, k));
    if (::testing::Test::HasFailure()) return;
  }
}

template <class Real>
void check_nasty_scenes(const TechniqueEntry& entry) {
  for (const nasty::NamedScene& named : nasty::scenes())
    for (const double scale : nasty::kScales)
      for (const Intersector intersector : {Intersector::fast, Intersector::watertight, Intersector::exact}) {
        SCOPED_TRACE(fmt::format("'{}' scaled by {}, {}", named.name, scale,
                                 kIntersectorNames[static_cast<std::size_t>(intersector)]));
        const Geometry<Real> geometry(nasty::scaled(named.scene, scale), ConeSides::both, intersector);
        check(entry, geometry, nasty::rays(geometry, scale, intersector == Intersector::exact ? 25 : 120));
        if (::testing::Test::HasFailure()) return;
      }
}

TEST_P(Conformance, EqualsExhaustiveSearchInFloat) { check_nasty_scenes<float>(*GetParam()); }

TEST_P(Conformance, EqualsExhaustiveSearchInDouble) { check_nasty_scenes<double>(*GetParam()); }

/// A ray begins at 0 at the earliest: one that is said to begin before, or at what is no number, has the answers of one
/// that begins there.
TEST_P(Conformance, RaysBeginAtZero) {
  const Geometry<double> geometry(soup_scene(200));
  const Arguments arguments(GetParam()->info.parameters, {}, GetParam()->info.id);
  const auto engine = GetParam()->build<double>({geometry, arguments});
  std::vector<Ray<double>> early, begun;
  for (const Ray<double>& ray : nasty::rays(geometry, 1, 40))
    for (const double t_min :
         {-1e-9, -3.0, -Box<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
      begun.push_back(ray), early.push_back(ray);
      begun.back().t_min = 0, early.back().t_min = t_min;
    }
  for (const Query query : {Query::closest, Query::any, Query::strict}) {
    const Counted<double> of_early = counted(*engine, query, early),
                          of_begun = counted(*engine, query, begun);
    EXPECT_EQ(of_early.hits, of_begun.hits);
    EXPECT_EQ(of_early.work, of_begun.work);
  }
  const auto scratch = engine->scratch();
  std::vector<Hit<double>> hits(early.size()), expected(early.size());
  std::vector<std::uint8_t> blocked(early.size()), expected_blocked(early.size());
  engine->closest(early, hits, *scratch), engine->closest(begun, expected, *scratch);
  engine->any(early, blocked, *scratch), engine->any(begun, expected_blocked, *scratch);
  EXPECT_EQ(hits, expected);
  EXPECT_EQ(blocked, expected_blocked);
}

/// Hits and counts may not depend on who traced which ray.
TEST_P(Conformance, ThreadsChangeNothing) {
  const Geometry<float> geometry(soup_scene(300));
  const std::vector<Ray<float>> rays = nasty::rays(geometry, 1, 4000);
  const Arguments arguments(GetParam()->info.parameters, {}, GetParam()->info.id);
  const auto engine = GetParam()->build<float>({geometry, arguments});
  ThreadScratch<float> scratch(*engine);
  std::vector<Hit<float>> alone(rays.size()), together(rays.size()), counted(rays.size());
  trace_closest<float>(*engine, rays, alone, scratch, 1);
  const CountedWork work_alone = count_work<float>(*engine, Query::closest, rays, counted, scratch, 1);
  EXPECT_EQ(alone, counted);
  for (const int threads : {2, 3}) {
    trace_closest<float>(*engine, rays, together, scratch, threads);
    EXPECT_EQ(alone, together);
    const CountedWork work = count_work<float>(*engine, Query::closest, rays, counted, scratch, threads);
    EXPECT_EQ(work.total, work_alone.total);
    EXPECT_EQ(work.distinct_squares, work_alone.distinct_squares);
    EXPECT_EQ(work.distinct_differences, work_alone.distinct_differences);
  }
}

INSTANTIATE_TEST_SUITE_P(Techniques, Conformance,
                         ::testing::ValuesIn(technique_entries().begin(), technique_entries().end()),
                         [](const auto& technique) { return technique.param->info.id; });

INSTANTIATE_TEST_SUITE_P(Compositions, Conformance, ::testing::ValuesIn(composed_entries()),
                         [](const auto& composition) { return fmt::format("number_{}", composition.index); });

}  // namespace
}  // namespace rayshoot
