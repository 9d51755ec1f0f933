#pragma once

#include "accel/core/registry.h"
#include "accel/tests/nasty_scenes.h"

namespace rayshoot {

using Given = std::map<std::string, std::string>;

inline Scene soup_scene(int count) {
  SceneBuilder builder;
  nasty::Random random(5);
  nasty::soup(builder, random, count);
  return std::move(builder).finish();
}

template <class Real = double>
std::unique_ptr<Engine<Real>> build(const char* id, const Geometry<Real>& geometry, const Given& given = {}) {
  const TechniqueEntry& entry = technique_entry(id);
  return entry.build<Real>({geometry, Arguments(entry.info.parameters, given, id)});
}

/// What an engine did for some rays, and the hits.
template <class Real>
struct Counted {
  Work work;
  std::vector<Hit<Real>> hits;
};

template <class Real>
Counted<Real> counted(const Engine<Real>& engine, Query query, const std::vector<Ray<Real>>& rays) {
  Counted<Real> counted{.hits = std::vector<Hit<Real>>(rays.size())};
  counted.work = engine.count(query, rays, counted.hits, *engine.scratch()).total;
  return counted;
}

/// The distinct candidates of one ray.
template <class Real>
std::vector<std::uint32_t> candidates(const Engine<Real>& engine, Query query, const Ray<Real>& ray) {
  return engine.candidates(query, ray, *engine.scratch());
}

}  // namespace rayshoot
