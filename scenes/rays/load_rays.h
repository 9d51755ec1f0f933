#pragma once

#include <map>
#include <string>

#include "scenes/rays/distribution.h"

namespace rayshoot {

/// A specification of rays, understood.
struct RaySpec {
  const RayDistribution* distribution = nullptr;
  Arguments arguments;
  /// Canonical: "whitted@513", "whitted(rules=havran)@65", "chords(rays=100000)". It is itself a
  /// specification.
  std::string id;

  /// Which sides of cones the rays are made for, and must be traced with.
  ConeSides cone_sides() const { return distribution->cone_sides(arguments); }
};

/// Understand `name`, `name(key=value,…)` or `name(…)@resolution`. `defaults` replaces the distribution's own
/// defaults for those of its keys that the distribution has. Throws InputError.
RaySpec resolve_rays(const std::string& text, const std::map<std::string, std::string>& defaults = {});

/// Why a scene cannot have these rays, in words; empty when it can.
std::string why_left_out(const RaySpec& spec, const Scene& scene);

/// Generate the rays. The tracer must see the scene with `spec.cone_sides()`. Throws InputError for rays that
/// the scene cannot have.
RaySet make_rays(const RaySpec& spec, const Scene& scene, const Tracer& tracer, std::uint64_t seed);
RaySet make_rays(const std::string& spec, const Scene& scene, const Tracer& tracer, std::uint64_t seed);

}  // namespace rayshoot
