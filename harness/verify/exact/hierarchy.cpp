#include "harness/verify/exact/hierarchy.h"

namespace rayshoot::exact {

SlabRay::SlabRay(const Vec3d& origin, const Vec3d& direction, double t_min)
    : origin_(origin),
      exponent_(std::ilogb(max_abs(direction))),
      t_min_(next_down(std::ldexp(t_min, exponent_))) {
  // A component so small that scaling may round it, or its reciprocal overflow, constrains nothing.
  constexpr double smallest = 0x1p-1000;
  for (int axis = 0; axis < 3; ++axis) {
    const double component = std::ldexp(direction[axis], -exponent_);
    parallel_[axis] = direction[axis] == 0;
    unconstrained_[axis] = !parallel_[axis] && std::abs(component) < smallest;
    inverse_[axis] = 1 / component;
  }
}

Hierarchy::Hierarchy(std::vector<BoxedObject<double>> objects)
    : objects_(std::move(objects)), tree_(sah_tree<double>(objects_, {})) {}

}  // namespace rayshoot::exact
