#pragma once

#include <array>
#include <memory>
#include <vector>

#include "scenes/core/geometry.h"

namespace rayshoot {

/// What becomes of an answer that is held against exact arithmetic.
enum class AnswerClass {
  exact,         ///< the nearest object, or one at exactly the same distance; or a miss, and nothing is hit
  ambiguous,     ///< half an ulp of the inputs decides: a border, a tangent or an end of the ray is touched
  near,          ///< another object that is hit, hardly farther away
  wrong_object,  ///< another object, or one that is not hit, where something is hit
  false_miss,    ///< a miss, where something is hit
  false_hit,     ///< a hit, where nothing is hit
  not_a_number,  ///< the distance is not a number
  over_steps,    ///< the bound on work was exceeded; set by those who count
  crash,         ///< no answer at all; set by those who run
};
inline constexpr std::array kAnswerClassNames = {"exact",        "ambiguous",  "near",
                                                 "wrong_object", "false_miss", "false_hit",
                                                 "not_a_number", "over_steps", "crash"};

/// A judgement of one answer. Errors are measured from the exact contact with the object that was answered, or,
/// where the ray does not hit it, from the nearest; 0 where there is nothing to measure. Never not a number.
struct Grade {
  AnswerClass answer = AnswerClass::exact;
  /// |t - exact t| in units in the last place of the exact t.
  double ulps_of_t = 0;
  /// How far the point at t is from the exact one along the worst axis, in units in the last place of the
  /// object's largest coordinate.
  double ulps_of_point = 0;
};

/// The exact nearest hit of a ray.
template <class Real>
struct ExactHit {
  /// All objects at exactly the smallest distance, in increasing order; none for a miss.
  std::vector<std::uint32_t> objects;
  /// The distance rounded to nearest, or `kMiss`.
  Real t = kMiss<Real>;
  /// Whether half an ulp of the inputs may make the ray miss all of these there.
  bool borderline = false;
};

/// Knows the nearest hit of every ray exactly: coordinates are rational numbers, and so are the polynomials whose
/// signs decide; where double precision with its error bound cannot tell a sign, exact arithmetic does. Objects
/// are those of the geometry, which outlives the oracle. Triangles, polygons and cones include their borders. A
/// polygon lies in the plane through its first vertex across Newell's area vector and is what is inside its
/// projection along the geometry's axis. A ray in the plane of a triangle or polygon misses it, one with numbers
/// that are not finite or without direction misses everything. Const functions may be called by any thread.
template <class Real>
class ExactOracle {
 public:
  /// Another object is `near` up to `near_ulps` units in the last place of the exact nearest distance.
  explicit ExactOracle(const Geometry<Real>& geometry, double near_ulps = 4);
  ~ExactOracle();
  ExactOracle(ExactOracle&&) noexcept;

  Grade grade(const Ray<Real>& ray, const Hit<Real>& answer) const;
  ExactHit<Real> nearest(const Ray<Real>& ray) const;

 private:
  class Search;
  std::unique_ptr<const Search> search_;
};

extern template class ExactOracle<float>;
extern template class ExactOracle<double>;

}  // namespace rayshoot
