#include "harness/choose/terms.h"

#include "harness/measure/tested_kinds.h"

namespace rayshoot {

namespace {

/// The second cache of the machine that the constants were fitted on.
constexpr double kNearBytes = 1 << 20;

/// The part of equally likely accesses to so many bytes that misses a cache.
double far_part(double bytes) { return bytes > kNearBytes ? 1 - kNearBytes / bytes : 0; }

}  // namespace

template <class Real>
std::map<std::string, double> terms_of(const Engine<Real>& engine, const Geometry<Real>& geometry,
                                       const Batch<Real>& sample) {
  const auto scratch = engine.scratch();
  std::vector<Hit<Real>> hits(sample.rays.size());
  const std::span<Hit<Real>> all(hits);
  CountedWork counted =
      engine.count(Query::closest, sample.closest(), all.first(sample.closest_rays), *scratch);
  counted += engine.count(Query::any, sample.any(), all.subspan(sample.closest_rays), *scratch);
  const Work& work = counted.total;
  const auto per_ray = [rays = static_cast<double>(sample.rays.size())](double count) {
    return count / rays;
  };
  const auto tests = static_cast<double>(work.object_tests);

  std::map<std::string, double> terms{{"ray", 1},
                                      {"object_test", per_ray(tests)},
                                      {"volume_test", per_ray(static_cast<double>(work.volume_tests))},
                                      {"step", per_ray(static_cast<double>(work.steps))}};
  // Tests are taken to be of kinds in the shares that candidates have, each looked up once a ray.
  const TestedKinds kinds = tested_kinds(engine, geometry, sample, work.object_tests, *scratch);
  const double repeated = kinds.all() > 0 ? tests / kinds.all() : 0;
  const std::array names = {"triangle_test", "polygon_test", "sphere_test", "cone_test"};
  for (std::size_t kind = 0; kind < names.size(); ++kind)
    terms[names[kind]] = per_ray(kinds.objects[kind] * repeated);
  terms["polygon_vertex"] = per_ray(kinds.vertices * repeated);

  const double far = far_part(static_cast<double>(engine.structure().bytes + geometry.bytes()));
  terms["far_test"] = far * per_ray(tests);
  std::erase_if(terms, [](const auto& term) { return term.second == 0; });
  return terms;
}

template std::map<std::string, double> terms_of(const Engine<float>&, const Geometry<float>&,
                                                const Batch<float>&);
template std::map<std::string, double> terms_of(const Engine<double>&, const Geometry<double>&,
                                                const Batch<double>&);

}  // namespace rayshoot
