#pragma once

#include "accel/core/registry.h"

namespace rayshoot {

/// The technique that answers where exhaustive search is out of reach. The conformance tests hold it to
/// exhaustive search, and every run does on a sample.
inline constexpr const char* kReferenceTechnique = "bvh_sah";
inline constexpr const char* kExhaustiveTechnique = "exhaustive";

/// A technique with all parameters at their defaults.
template <class Real>
std::unique_ptr<Engine<Real>> build_default(const char* id, const Geometry<Real>& geometry) {
  const TechniqueEntry& entry = technique_entry(id);
  return entry.build<Real>({geometry, Arguments(entry.info.parameters, {}, id)});
}

}  // namespace rayshoot
