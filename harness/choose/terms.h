#pragma once

#include <array>
#include <map>
#include <string>

#include "harness/verify/answers.h"

namespace rayshoot {

/// Terms of the time of a ray, in tests of objects: the same for all techniques. `far_test` is the part of the tests whose
/// object is expected outside of the second cache.
inline constexpr std::array kObjectTerms = {"triangle_test", "polygon_test", "polygon_vertex",
                                            "sphere_test",   "cone_test",    "far_test"};
/// The others, of which each technique has constants of its own. `ray` is 1, for what every ray costs; `object_test` is what
/// a test costs beyond its kind, where objects are met in no order.
inline constexpr std::array kTechniqueTerms = {"ray", "object_test", "volume_test", "step"};

/// What an engine does for a ray of the sample, by terms; those that are zero are left out.
template <class Real>
std::map<std::string, double> terms_of(const Engine<Real>& engine, const Geometry<Real>& geometry,
                                       const Batch<Real>& sample);

}  // namespace rayshoot
