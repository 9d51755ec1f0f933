#include "harness/measure/work_map.h"

namespace rayshoot {

template <class Real>
report::WorkMap work_map(const Engine<Real>& engine, const Batch<Real>& batch, std::uint64_t resolution,
                         EngineScratch& scratch) {
  report::WorkMap map{.resolution = resolution, .tile = (resolution + kMapColumns - 1) / kMapColumns};
  const std::uint64_t columns = map.columns();
  map.object_tests.resize(columns * columns);
  map.volume_tests.resize(columns * columns);
  std::vector<Hit<Real>> hits(map.tile);
  for (std::uint64_t row = 0; row < resolution; ++row)
    for (std::uint64_t column = 0; column < columns; ++column) {
      const std::uint64_t first = column * map.tile, length = std::min(map.tile, resolution - first);
      const Work work = engine
                            .count(Query::closest, batch.all().subspan(row * resolution + first, length),
                                   std::span(hits).first(length), scratch)
                            .total;
      map.object_tests[row / map.tile * columns + column] += work.object_tests;
      map.volume_tests[row / map.tile * columns + column] += work.volume_tests;
    }
  return map;
}

template report::WorkMap work_map<float>(const Engine<float>&, const Batch<float>&, std::uint64_t,
                                         EngineScratch&);
template report::WorkMap work_map<double>(const Engine<double>&, const Batch<double>&, std::uint64_t,
                                          EngineScratch&);

}  // namespace rayshoot
