#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "accel/core/batch.h"
#include "accel/core/registry.h"

/// What every technique owes: the answers of exhaustive search, bit for bit, from every query. Written once,
/// run over the registry by accel/tests and, with the baselines, by harness/tests.
namespace rayshoot::conformance {

/// A configuration of a technique to be checked.
struct Variant {
  const TechniqueEntry* entry;
  std::map<std::string, std::string> given;

  std::string name() const {
    std::string text = entry->info.id;
    for (const auto& [key, value] : given) text += fmt::format(" {}={}", key, value);
    return text;
  }
  Arguments arguments() const { return {entry->info.parameters, given, entry->info.id}; }
};

/// The default configuration and every word of every choice, one at a time.
inline std::vector<Variant> variants(const TechniqueEntry& entry) {
  std::vector<Variant> all{{&entry, {}}};
  for (const Parameter& parameter : entry.info.parameters) {
    std::vector<std::string> words = parameter.choices;
    if (parameter.type == Parameter::Type::boolean) words = {"on", "off"};
    for (const std::string& word : words)
      if (word != parameter.default_value) all.push_back({&entry, {{parameter.name, word}}});
  }
  return all;
}

/// What is true of a ray, from a plain loop over the objects that shares no code with any technique.
template <class Real>
struct Truth {
  Hit<Real> nearest;
  std::vector<std::uint32_t> all;
};

template <class Real>
Truth<Real> truth(const Geometry<Real>& geometry, const Ray<Real>& ray) {
  Truth<Real> truth;
  for (std::uint32_t number = 0; number < geometry.numbers(); ++number) {
    const Real t = geometry.hit_distance_of_number(number, ray);
    if (t == kMiss<Real>) continue;
    truth.all.push_back(number);
    if (t < truth.nearest.t) truth.nearest = {t, number};
  }
  return truth;
}

template <class Real>
std::string describe(const Ray<Real>& r) {
  return fmt::format("ray origin ({}, {}, {}) direction ({}, {}, {}) interval ({}, {}] time {}", r.origin.x,
                     r.origin.y, r.origin.z, r.direction.x, r.direction.y, r.direction.z, r.t_min, r.t_max,
                     r.time);
}

/// Sorted ranges: whether every element of `part` is in `whole`.
inline bool within(const std::vector<std::uint32_t>& part, const std::vector<std::uint32_t>& whole) {
  return std::includes(whole.begin(), whole.end(), part.begin(), part.end());
}

/// Candidates and counts of one ray: A(r, s) holds the nearest hit (11), the strict optimizer every hit (10).
template <class Real>
void check_candidates(const Engine<Real>& engine, const Ray<Real>& ray, const Truth<Real>& truth,
                      EngineScratch& scratch) {
  const auto candidates = engine.candidates(Query::closest, ray, scratch);
  const auto strict = engine.candidates(Query::strict, ray, scratch);
  if (truth.nearest.object != kNoObject) {
    EXPECT_TRUE(within({truth.nearest.object}, candidates)) << describe(ray);
  }
  EXPECT_TRUE(within(truth.all, strict)) << describe(ray);
  EXPECT_TRUE(within(candidates, strict)) << describe(ray);
  Hit<Real> hit;
  const Work work = engine.count(Query::closest, {&ray, 1}, {&hit, 1}, scratch).total;
  EXPECT_EQ(hit, truth.nearest) << describe(ray);
  EXPECT_EQ(work.distinct_objects, candidates.size()) << describe(ray);
  EXPECT_GE(work.object_tests, work.distinct_objects) << describe(ray);
  engine.count(Query::any, {&ray, 1}, {&hit, 1}, scratch);
  EXPECT_EQ(hit.object != kNoObject, !truth.all.empty()) << describe(ray);
}

template <class Real>
std::vector<Truth<Real>> truths(const Geometry<Real>& geometry, std::span<const Ray<Real>> rays) {
  std::vector<Truth<Real>> all;
  for (const Ray<Real>& ray : rays) all.push_back(truth(geometry, ray));
  return all;
}

/// All queries of a built engine on all rays. Stops at the first ray that fails: one is enough to look into.
template <class Real>
void check_engine(const Engine<Real>& engine, std::span<const Ray<Real>> rays,
                  std::span<const Truth<Real>> truths) {
  const auto scratch = engine.scratch();
  std::vector<Hit<Real>> hits(rays.size());
  std::vector<std::uint8_t> blocked(rays.size());
  engine.closest(rays, hits, *scratch);
  engine.any(rays, blocked, *scratch);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(hits[i].object, truths[i].nearest.object) << describe(rays[i]);
    EXPECT_EQ(hits[i].t, truths[i].nearest.t) << describe(rays[i]);
    EXPECT_EQ(blocked[i] != 0, !truths[i].all.empty()) << describe(rays[i]);
    if (engine.countable()) check_candidates(engine, rays[i], truths[i], *scratch);
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace rayshoot::conformance
