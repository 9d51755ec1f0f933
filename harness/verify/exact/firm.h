#pragma once

#include "harness/verify/exact/reading.h"
#include "harness/verify/exact/sensitive.h"

/// Conditions that hold whatever half an ulp of the inputs does.
namespace rayshoot::exact {

/// Conditions for a contact, each 1, 0 or `kUnknown`, folded into one.
class Conditions {
 public:
  void require(int condition) {
    possible_ &= condition != 0;
    certain_ &= condition == 1;
  }
  bool possible() const { return possible_; }
  void add_to(Reading& reading, long double t) const {
    if (possible_ && !reading.possible) reading.possible = t;
    if (certain_ && !reading.certain) reading.certain = t;
  }

 private:
  bool possible_ = true, certain_ = true;
};

inline int condition(int firm_sign, int wanted) {
  return firm_sign == kUnknown ? kUnknown : firm_sign == wanted;
}

/// The line of a ray in exact numbers and in sensitive ones, which are the first six inputs.
template <class Real>
struct Lines {
  Line<Dyadic> exact;
  Inputs inputs;
  Line<Sensitive> sensitive;

  explicit Lines(const Ray<Real>& ray)
      : exact(line_of<Dyadic>(ray)), sensitive{inputs(ray.origin), inputs(ray.direction)} {}
};

/// A lower bound of the parameters at which a ray that runs within half an ulp of an object's surface may touch
/// it; nothing where it stays out of the object's bounds, even when these move apart by half an ulp of everything.
template <class Real>
std::optional<double> entry(const ExactContacts<Real>& contacts, std::uint32_t object, const Ray<Real>& ray);

/// The readings of triangles and polygons, and of spheres and cones.
template <class Real>
Reading read_flat(const ExactContacts<Real>& contacts, std::uint32_t object, const Ray<Real>& ray);
template <class Real>
Reading read_quadric(const ExactContacts<Real>& contacts, std::uint32_t object, const Ray<Real>& ray);

}  // namespace rayshoot::exact
