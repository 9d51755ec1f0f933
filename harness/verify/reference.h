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

/// Engines over a geometry that know the answers, each built when it is first asked for and then kept.
template <class Real>
class References {
 public:
  /// `built` is a reference that there is already, with all parameters at their defaults; null for none. It outlives this.
  explicit References(const Geometry<Real>& geometry, const Engine<Real>* built = nullptr)
      : geometry_(geometry), reference_(built) {}

  const Geometry<Real>& geometry() const { return geometry_; }
  const Engine<Real>& exhaustive() {
    if (!exhaustive_) exhaustive_ = build_default(kExhaustiveTechnique, geometry_);
    return *exhaustive_;
  }
  const Engine<Real>& reference() {
    if (!reference_)
      own_reference_ = build_default(kReferenceTechnique, geometry_), reference_ = own_reference_.get();
    return *reference_;
  }

 private:
  const Geometry<Real>& geometry_;
  std::unique_ptr<Engine<Real>> exhaustive_, own_reference_;
  const Engine<Real>* reference_;
};

}  // namespace rayshoot
