#pragma once

#include <array>

#include "harness/report/report.h"
#include "harness/verify/answers.h"

namespace rayshoot {

/// Candidates by kind of object, and vertices of polygons among them.
struct TestedKinds {
  std::array<double, kObjectKindNames.size()> objects{};
  double vertices = 0;

  double all() const { return objects[0] + objects[1] + objects[2] + objects[3]; }
};

/// Of the distinct candidates of rays of the batch, as many as are looked up when `object_tests` are made in all of them:
/// every ray, or one in so many that about a million candidates are.
template <class Real>
TestedKinds tested_kinds(const Engine<Real>& engine, const Geometry<Real>& geometry, const Batch<Real>& batch,
                         std::uint64_t object_tests, EngineScratch& scratch);

/// The shares of kinds; absent where no object was tested.
std::optional<report::TestedKinds> record(const TestedKinds& kinds);

extern template TestedKinds tested_kinds(const Engine<float>&, const Geometry<float>&, const Batch<float>&,
                                         std::uint64_t, EngineScratch&);
extern template TestedKinds tested_kinds(const Engine<double>&, const Geometry<double>&, const Batch<double>&,
                                         std::uint64_t, EngineScratch&);

}  // namespace rayshoot
