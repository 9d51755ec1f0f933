#include "harness/measure/tested_kinds.h"

#include <algorithm>
#include <ranges>

namespace rayshoot {

namespace {

/// The kinds of about so many candidates are looked up.
constexpr std::uint64_t kMostCandidates = 1'000'000;

/// Add the object of that number, in whatever part it is.
template <class Real>
void add(TestedKinds& kinds, const Geometry<Real>& geometry, std::uint32_t number) {
  const auto first_number = [&](std::uint32_t object) { return geometry.first_number(object); };
  const auto objects = std::views::iota(0u, geometry.size());
  const std::uint32_t object = *(std::ranges::upper_bound(objects, number, {}, first_number) - 1);
  if (geometry.kind(object) == ObjectKind::placed)
    return add(kinds, *geometry.placed(object).part, number - first_number(object));
  const ObjectKind kind = geometry.kind(object);
  ++kinds.objects[static_cast<std::size_t>(kind)];
  if (kind == ObjectKind::polygon) kinds.vertices += geometry.polygon(object).vertex_count;
}

}  // namespace

template <class Real>
TestedKinds tested_kinds(const Engine<Real>& engine, const Geometry<Real>& geometry, const Batch<Real>& batch,
                         std::uint64_t object_tests, EngineScratch& scratch) {
  TestedKinds kinds;
  const std::size_t stride = 1 + object_tests / kMostCandidates;
  for (std::size_t i = 0; i < batch.rays.size(); i += stride) {
    const Query query = i < batch.closest_rays ? Query::closest : Query::any;
    for (const std::uint32_t object : engine.candidates(query, batch.rays[i], scratch))
      add(kinds, geometry, object);
  }
  return kinds;
}

std::optional<report::TestedKinds> record(const TestedKinds& kinds) {
  if (!(kinds.all() > 0)) return std::nullopt;
  const auto share = [&](ObjectKind kind) {
    return kinds.objects[static_cast<std::size_t>(kind)] / kinds.all();
  };
  return report::TestedKinds{share(ObjectKind::triangle), share(ObjectKind::polygon),
                             share(ObjectKind::sphere), share(ObjectKind::cone),
                             kinds.vertices / kinds.all()};
}

template TestedKinds tested_kinds(const Engine<float>&, const Geometry<float>&, const Batch<float>&,
                                  std::uint64_t, EngineScratch&);
template TestedKinds tested_kinds(const Engine<double>&, const Geometry<double>&, const Batch<double>&,
                                  std::uint64_t, EngineScratch&);

}  // namespace rayshoot
