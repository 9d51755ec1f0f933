#pragma once

#include "accel/parts/branch.h"
#include "accel/parts/pair_tree.h"

namespace rayshoot {

/// The leaves of a binary hierarchy that a ray meets: descend into the nearer child first and come back to the farther
/// one while it can still matter.
///   visit(first, count)  is called with the objects of each leaf, by place in the tree's order; true ends the walk
///   reach()              is the distance at which the walk may end; leaves that begin there are still visited
template <class Tree, class Real, class Counter, class Reach, class Visit>
void walk_pairs(const Tree& tree, const Ray<Real>& ray, Counter count, const Reach& reach,
                const Visit& visit) {
  // Leave out rays that miss everything.
  if (tree.empty()) return;
  count.volume_tests();
  const Interval<Real> whole = Crossings<Real>(ray).inside(tree.bounds);
  if (!(std::max(whole.enter, ray.t_min) <= std::min(whole.exit, ray.t_max))) return;

  struct Postponed {
    ChildReference child;
    Real enter;
  };
  Postponed stack[kMaxSahDepth];
  int postponed = 0;
  const PairCrossings<Real> crossings(ray);
  ChildReference current = tree.root;
  while (true) {
    current = tree.at_time(current, ray.time);
    if (current.leaf()) {
      if (visit(current.first, current.count)) return;
    } else {
      // Test both children's volumes and enter the nearer of those that are hit; meanwhile fetch both children.
      const PairNode<Real>& node = tree.nodes[current.first];
      __builtin_prefetch(tree.nodes.data() + node.child[0].first);
      __builtin_prefetch(tree.nodes.data() + node.child[1].first);
      count.step(), count.volume_tests(2);
      const Real end = reach();
      const Lanes<Real> inside = crossings.inside(node.boxes, Lanes<Real>{ray.t_min, ray.t_min, -end, -end});
      const bool hits_first = inside[0] <= -inside[2], hits_second = inside[1] <= -inside[3];
      if (hits_first && hits_second) {
        if (inside[1] < inside[0]) {
          keep_branch();
          stack[postponed++] = {node.child[0], inside[0]};
          current = node.child[1];
        } else {
          keep_branch();
          stack[postponed++] = {node.child[1], inside[1]};
          current = node.child[0];
        }
        continue;
      }
      if (hits_first) {
        keep_branch();
        current = node.child[0];
        continue;
      }
      if (hits_second) {
        keep_branch();
        current = node.child[1];
        continue;
      }
    }
    // Return to the nearest postponed node that no hit has made pointless; one at equal distance may still hold a lower
    // object.
    do {
      if (postponed == 0) return;
      --postponed;
    } while (stack[postponed].enter > reach());
    current = stack[postponed].child;
  }
}

}  // namespace rayshoot
