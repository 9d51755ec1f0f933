#pragma once

#include "harness/verify/exact/contact.h"

namespace rayshoot::exact {

/// What half an ulp of every input leaves open about a ray and an object: the parameter of the first contact
/// that is possible, and of the first that is certain.
struct Reading {
  std::optional<long double> possible, certain;
};

/// To first order in the movement of the inputs. The ray must be `usable`.
template <class Real>
Reading read(const ExactContacts<Real>& contacts, std::uint32_t object, const Ray<Real>& ray);

extern template Reading read(const ExactContacts<float>&, std::uint32_t, const Ray<float>&);
extern template Reading read(const ExactContacts<double>&, std::uint32_t, const Ray<double>&);

}  // namespace rayshoot::exact
