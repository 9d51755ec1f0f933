#pragma once

#include "accel/core/technique.h"
#include "accel/parts/lattice.h"

namespace rayshoot {

/// surface: to every leaf that the object's surface penetrates (Glassner 1984); box: to every leaf that its
/// bounds touch.
enum class Assignment { surface, box };

/// When to stop dividing.
struct OctreeLimits {
  /// Divisions between the root and the smallest cell, 18 at most; 0 for `suitable_depth`.
  int max_depth = 0;
  /// A cell with that many objects or fewer is a leaf.
  std::uint32_t max_objects = 8;
  Assignment assignment = Assignment::surface;
  /// A cell is also a leaf where neither the division that made it nor the next would separate anything, all eight
  /// children getting all of its objects: what meets in a point cannot be told apart however deep.
  bool separating = true;
  /// Glassner's storage limitation: no level is begun that would bring the references beyond this many per
  /// object and `kSpareReferences`.
  std::uint64_t references_per_object = 64;
};

inline constexpr int kMaxOctreeDepth = 18;
inline constexpr std::uint64_t kSpareReferences = 1u << 24;

std::vector<Parameter> octree_parameters();
OctreeLimits octree_limits(const Arguments& arguments);
/// Depth at which the cells of a surface cut into that many objects are about as large as the objects, and
/// two levels more for scenes that are not even.
int suitable_depth(std::uint32_t objects);

/// An octree over a scene, before any technique has put it into the form it works with. A cell is divided at
/// its centre on all three axes; octant bit k tells the upper half on axis k.
template <class Real>
struct Octree {
  struct Node {
    static constexpr std::uint32_t kInterior = UINT32_MAX;
    /// Of an interior node its first child, seven more following; of a leaf the first of its references.
    std::uint32_t first = 0;
    /// Number of objects of a leaf, `kInterior` for an interior node.
    std::uint32_t count = 0;
    bool interior() const { return count == kInterior; }
  };

  /// As deep as the deepest leaf: its step is the edge of the smallest cells.
  Lattice<Real> lattice;
  /// Level by level from the root, nodes[0].
  std::vector<Node> nodes;
  /// The leaves' objects, in increasing order within a leaf.
  std::vector<std::uint32_t> references;

  std::span<const std::uint32_t> objects(const Node& leaf) const {
    return std::span(references).subspan(leaf.first, leaf.count);
  }
};

/// Divide the scene's bounds until the limits are reached. Levels are built in parallel; the result does not depend on the
/// number of threads.
template <class Real>
Octree<Real> build_octree(const Geometry<Real>& geometry, const OctreeLimits& limits);

extern template Octree<float> build_octree(const Geometry<float>&, const OctreeLimits&);
extern template Octree<double> build_octree(const Geometry<double>&, const OctreeLimits&);

}  // namespace rayshoot
