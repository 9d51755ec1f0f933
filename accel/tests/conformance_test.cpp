#include "accel/tests/conformance.h"

#include "accel/tests/nasty_scenes.h"

namespace rayshoot {
namespace {

class Conformance : public ::testing::TestWithParam<const TechniqueEntry*> {};

template <class Real>
void check(const TechniqueEntry& entry, const Geometry<Real>& geometry, const std::vector<Ray<Real>>& rays) {
  const auto truths = conformance::truths<Real>(geometry, rays);
  for (const conformance::Variant& variant : conformance::variants(entry)) {
    SCOPED_TRACE(variant.name());
    const Arguments arguments = variant.arguments();
    conformance::check_engine<Real>(*entry.build<Real>({geometry, arguments}), rays, truths);
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

/// Hits and counts may not depend on who traced which ray.
TEST_P(Conformance, ThreadsChangeNothing) {
  SceneBuilder builder;
  nasty::Random random(3);
  nasty::soup(builder, random, 300);
  const Scene scene = std::move(builder).finish();
  const Geometry<float> geometry(scene);
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
  }
}

INSTANTIATE_TEST_SUITE_P(Techniques, Conformance,
                         ::testing::ValuesIn(technique_entries().begin(), technique_entries().end()),
                         [](const auto& technique) { return technique.param->info.id; });

}  // namespace
}  // namespace rayshoot
