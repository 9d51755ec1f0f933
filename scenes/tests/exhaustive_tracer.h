#pragma once

#include "scenes/rays/distribution.h"

namespace rayshoot {

/// Traces a small scene object by object.
class ExhaustiveTracer final : public Tracer {
 public:
  explicit ExhaustiveTracer(const Scene& scene, ConeSides sides = ConeSides::both)
      : geometry_(scene, sides) {}

  void closest(std::span<const Ray<double>> rays, std::span<Hit<double>> hits) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = nearest(rays[i]);
  }
  void any(std::span<const Ray<double>> rays, std::span<std::uint8_t> blocked) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) blocked[i] = nearest(rays[i]).object != kNoObject;
  }

 private:
  Hit<double> nearest(const Ray<double>& ray) const {
    Hit<double> hit;
    for (std::uint32_t object = 0; object < geometry_.size(); ++object)
      if (const double t = geometry_.hit_distance(object, ray); t < hit.t)
        hit = {t, geometry_.scene_number(object)};
    return hit;
  }

  Geometry<double> geometry_;
};

}  // namespace rayshoot
