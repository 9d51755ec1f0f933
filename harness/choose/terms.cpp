#include "harness/choose/terms.h"

#include <algorithm>
#include <ranges>

namespace rayshoot {

namespace {

/// The second cache of the machine that the constants were fitted on.
constexpr double kNearBytes = 1 << 20;

/// The kinds of about so many candidates are looked up.
constexpr std::uint64_t kMostCandidates = 1'000'000;

/// The part of equally likely accesses to so many bytes that misses a cache.
double far_part(double bytes) { return bytes > kNearBytes ? 1 - kNearBytes / bytes : 0; }

/// Candidates by kind of object, and vertices of polygons among them.
struct Kinds {
  std::array<double, kObjectKindNames.size()> objects{};
  double vertices = 0;

  double all() const { return objects[0] + objects[1] + objects[2] + objects[3]; }
};

/// Add the object of that number, in whatever part it is.
template <class Real>
void add(Kinds& kinds, const Geometry<Real>& geometry, std::uint32_t number) {
  const auto first_number = [&](std::uint32_t object) { return geometry.first_number(object); };
  const auto objects = std::views::iota(0u, geometry.size());
  const std::uint32_t object = *(std::ranges::upper_bound(objects, number, {}, first_number) - 1);
  if (geometry.kind(object) == ObjectKind::placed)
    return add(kinds, *geometry.placed(object).part, number - first_number(object));
  const ObjectKind kind = geometry.kind(object);
  ++kinds.objects[static_cast<std::size_t>(kind)];
  if (kind == ObjectKind::polygon) kinds.vertices += geometry.polygon(object).vertex_count;
}

template <class Real>
Kinds kinds_of(const Engine<Real>& engine, const Geometry<Real>& geometry, const Batch<Real>& sample,
               std::size_t stride, EngineScratch& scratch) {
  Kinds kinds;
  for (std::size_t i = 0; i < sample.rays.size(); i += stride) {
    const Query query = i < sample.closest_rays ? Query::closest : Query::any;
    for (const std::uint32_t object : engine.candidates(query, sample.rays[i], scratch))
      add(kinds, geometry, object);
  }
  return kinds;
}

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
  const Kinds kinds = kinds_of(engine, geometry, sample, 1 + work.object_tests / kMostCandidates, *scratch);
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
