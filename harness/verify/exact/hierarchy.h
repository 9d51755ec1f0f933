#pragma once

#include <optional>
#include <vector>

#include "accel/parts/sah_build.h"

namespace rayshoot::exact {

/// A ray for conservative tests against boxes. Its direction is scaled by a power of two to about unit size, so
/// that reciprocals of all components that matter are ordinary numbers, and so are its parameters.
class SlabRay {
 public:
  SlabRay(const Vec3d& origin, const Vec3d& direction, double t_min);

  /// A lower bound of the parameter at which the ray enters the box, in the ray's own units; nothing where it
  /// certainly misses the box or enters it beyond `reach`. Each crossing is computed with three roundings, of
  /// difference, reciprocal and product, hence to within 4 units of roundoff of itself; 8 are allowed for.
  std::optional<double> entry(const Box<double>& box, double reach) const {
    double enter = t_min_, exit = reach;
    for (int axis = 0; axis < 3; ++axis) {
      if (parallel_[axis]) {
        if (origin_[axis] < box.lo[axis] || origin_[axis] > box.hi[axis]) return std::nullopt;
        continue;
      }
      if (unconstrained_[axis]) continue;
      const double one = (box.lo[axis] - origin_[axis]) * inverse_[axis];
      const double other = (box.hi[axis] - origin_[axis]) * inverse_[axis];
      const double near = std::min(one, other), far = std::max(one, other);
      enter = std::max(enter, near - slack(near));
      exit = std::min(exit, far + slack(far));
    }
    if (enter > exit) return std::nullopt;
    return enter;
  }

  /// An upper bound of a parameter in the ray's own units, and a lower bound in those of the caller.
  double scaled(double t) const { return next_up(std::ldexp(t, exponent_)); }
  double unscaled(double t) const { return next_down(std::ldexp(t, -exponent_)); }

 private:
  static double slack(double t) {
    constexpr double roundoff = std::numeric_limits<double>::epsilon() / 2;
    return 8 * roundoff * std::abs(t) + std::numeric_limits<double>::denorm_min();
  }
  static double next_up(double t) { return std::nextafter(t, std::numeric_limits<double>::infinity()); }
  static double next_down(double t) { return std::nextafter(t, -std::numeric_limits<double>::infinity()); }

  Vec3d origin_, inverse_;
  bool parallel_[3] = {}, unconstrained_[3] = {};
  int exponent_ = 0;
  double t_min_;
};

/// Objects in boxes, to be visited near to far. Independent of the techniques under test but for the choice of
/// what goes together.
class Hierarchy {
 public:
  explicit Hierarchy(std::vector<BoxedObject<double>> objects);

  /// Call `visit(object)`, which returns the parameter up to which objects are still of interest, for all
  /// objects whose boxes the ray may meet up to that parameter.
  template <class Visit>
  void visit(const SlabRay& ray, double reach, const Visit& visit_object) const;

 private:
  struct Pending {
    ChildReference node;
    double enter;
  };

  template <class Visit>
  double visit_leaf(const SlabRay& ray, const ChildReference& leaf, double reach,
                    const Visit& visit_object) const {
    for (std::uint32_t place = leaf.first; place < leaf.first + leaf.count; ++place)
      if (ray.entry(objects_[place].box, reach)) reach = ray.scaled(visit_object(objects_[place].object));
    return reach;
  }

  std::vector<BoxedObject<double>> objects_;
  PairTree<double> tree_;
};

template <class Visit>
void Hierarchy::visit(const SlabRay& ray, double reach, const Visit& visit_object) const {
  if (objects_.empty()) return;
  Pending stack[kMaxSahDepth + 2];
  int size = 0;
  reach = ray.scaled(reach);
  stack[size++] = {tree_.root, -std::numeric_limits<double>::infinity()};
  while (size > 0) {
    const Pending next = stack[--size];
    if (next.enter > reach) continue;
    if (next.node.leaf()) {
      reach = visit_leaf(ray, next.node, reach, visit_object);
      continue;
    }
    const PairNode<double>& node = tree_.nodes[next.node.first];
    const auto left = ray.entry(node.boxes.box(0), reach), right = ray.entry(node.boxes.box(1), reach);
    const bool left_first = left && (!right || *left <= *right);
    if (left && !left_first) stack[size++] = {node.child[0], *left};
    if (right) stack[size++] = {node.child[1], *right};
    if (left && left_first) stack[size++] = {node.child[0], *left};
  }
}

}  // namespace rayshoot::exact
