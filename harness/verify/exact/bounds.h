#pragma once

#include "harness/verify/exact/contact.h"

namespace rayshoot::exact {

/// A box in double precision that contains every exact contact with an object. Rounding is outwards.
template <class Real>
Box<double> exact_bounds(const ExactContacts<Real>& contacts, std::uint32_t object);

extern template Box<double> exact_bounds(const ExactContacts<float>&, std::uint32_t);
extern template Box<double> exact_bounds(const ExactContacts<double>&, std::uint32_t);

}  // namespace rayshoot::exact
