#pragma once

#include <functional>

#include "accel/core/registry.h"
#include "scenes/core/scene_builder.h"

namespace rayshoot::test {

/// Exhaustive search whose answers are altered on the way out: a technique with a fault of our choice.
template <class Real>
class AlteredEngine final : public Engine<Real> {
 public:
  using Alter = std::function<void(const Ray<Real>&, Hit<Real>&)>;

  AlteredEngine(const EngineInput<Real>& input, Alter alter)
      : inner_(technique_entry("exhaustive").build<Real>(input)), alter_(std::move(alter)) {}

  std::unique_ptr<EngineScratch> scratch() const override { return inner_->scratch(); }
  void closest(std::span<const Ray<Real>> rays, std::span<Hit<Real>> hits,
               EngineScratch& scratch) const override {
    inner_->closest(rays, hits, scratch);
    for (std::size_t i = 0; i < rays.size(); ++i) alter_(rays[i], hits[i]);
  }
  void any(std::span<const Ray<Real>> rays, std::span<std::uint8_t> blocked,
           EngineScratch& scratch) const override {
    std::vector<Hit<Real>> hits(rays.size());
    closest(rays, hits, scratch);
    for (std::size_t i = 0; i < rays.size(); ++i) blocked[i] = hits[i].object != kNoObject;
  }
  CountedWork count(Query query, std::span<const Ray<Real>> rays, std::span<Hit<Real>> hits,
                    EngineScratch& scratch) const override {
    return inner_->count(query, rays, hits, scratch);
  }
  std::vector<std::uint32_t> candidates(Query query, const Ray<Real>& ray,
                                        EngineScratch& scratch) const override {
    std::vector<std::uint32_t> all = inner_->candidates(query, ray, scratch);
    Hit<Real> before, after;
    inner_->closest({&ray, 1}, {&before, 1}, scratch), closest({&ray, 1}, {&after, 1}, scratch);
    if (after.object != before.object) std::erase(all, before.object);
    return all;
  }
  StructureStats structure() const override { return inner_->structure(); }

 private:
  std::unique_ptr<Engine<Real>> inner_;
  Alter alter_;
};

/// Every hit lies a little farther than it should.
template <float Factor>
TechniqueEntry shifting_technique(const std::string& id) {
  return {.info = {.id = id, .title = id},
          .build_float = [](const EngineInput<float>& input) -> std::unique_ptr<Engine<float>> {
            return std::make_unique<AlteredEngine<float>>(
                input, [](const Ray<float>&, Hit<float>& hit) { hit.t *= Factor; });
          }};
}

/// Loses the hits of rays that lead to one side.
inline TechniqueEntry losing_technique(const std::string& id) {
  return {.info = {.id = id, .title = id},
          .build_float = [](const EngineInput<float>& input) -> std::unique_ptr<Engine<float>> {
            return std::make_unique<AlteredEngine<float>>(input, [](const Ray<float>& ray, Hit<float>& hit) {
              if (ray.direction.x > 0) hit = {};
            });
          }};
}

inline TechniqueEntry failing_technique(const std::string& id) {
  return {.info = {.id = id, .title = id},
          .build_float = [](const EngineInput<float>&) -> std::unique_ptr<Engine<float>> {
            throw InputError("a and b exclude each other");
          }};
}

}  // namespace rayshoot::test
