#pragma once

#include "accel/core/technique.h"
#include "accel/parts/lattice.h"

namespace rayshoot {

/// surface: to every leaf that the object's surface penetrates (Glassner 1984); box: to every leaf that its
/// bounds touch.
enum class Assignment { surface, box };

/// Where a cell is divided. centre: in its middle. cost: on each axis by itself, at that of ten planes from the middle to the
/// median of the objects for which the surfaces of the two parts, each times the objects that are in it, sum up to the least
/// (V. Havran, statistics of the SPD with octrees, 1999).
enum class OctreeSplit { centre, cost };

/// When to stop dividing, and where to divide.
struct OctreeLimits {
  /// Divisions between the root and the smallest cell, 18 at most; 0 for `suitable_depth`.
  int max_depth = 0;
  /// A cell with that many objects or fewer is a leaf.
  std::uint32_t max_objects = 8;
  Assignment assignment = Assignment::surface;
  OctreeSplit split = OctreeSplit::centre;
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
/// Where there is no parameter `assignment`.
OctreeLimits octree_limits(const Arguments& arguments, Assignment assignment);
/// Depth at which the cells of a surface cut into that many objects are about as large as the objects, and
/// two levels more for scenes that are not even.
int suitable_depth(std::uint32_t objects);

/// An octree over a scene, before any technique has put it into the form it works with. A cell is divided by a plane on
/// each axis; octant bit k tells the upper side on axis k.
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

  /// A node's cell, and the planes that divide it.
  struct Place {
    LatticeCell cell;
    Layers planes{};
  };

  /// Divided at centres, as deep as the deepest leaf: its step is the edge of the smallest cells. Otherwise so fine that any
  /// plane is near one of its planes.
  Lattice<Real> lattice;
  /// Divisions down to the deepest leaf.
  int depth = 0;
  /// Level by level from the root, nodes[0].
  std::vector<Node> nodes;
  /// The leaves' objects, in increasing order within a leaf.
  std::vector<std::uint32_t> references;
  /// By node, where planes were chosen by cost; empty where cells are divided at their centres.
  std::vector<Place> places;

  std::span<const std::uint32_t> objects(const Node& leaf) const {
    return std::span(references).subspan(leaf.first, leaf.count);
  }
  /// The planes that divide the interior node of that number, and its cell, as a ray sees them.
  Layers dividing(std::size_t node, const LatticeCell& cell, const LatticeRay<Real>& path) const {
    return places.empty() ? cell.centre() : path.mirrored(places[node].planes);
  }
  /// The planes that divide the interior node of that number.
  Layers dividing(std::size_t node, const LatticeCell& cell) const {
    return places.empty() ? cell.centre() : places[node].planes;
  }
  /// Call visit(box, key, objects) for each leaf with objects.
  template <class Visit>
  void for_each_cell(const Visit& visit) const {
    if (!nodes.empty()) for_each_cell_below(0, lattice.whole(), visit);
  }

  std::size_t bytes() const {
    return nodes.size() * sizeof(Node) + references.size() * sizeof(references[0]) +
           places.size() * sizeof(Place);
  }

 private:
  template <class Visit>
  void for_each_cell_below(std::size_t number, const LatticeCell& cell, const Visit& visit) const {
    const Node& node = nodes[number];
    if (node.interior()) {
      const Layers planes = dividing(number, cell);
      for (unsigned octant = 0; octant < 8; ++octant)
        for_each_cell_below(node.first + octant, cell.child(octant, planes), visit);
    } else if (node.count > 0) {
      visit(lattice.cell(cell), objects(node).data(), objects(node));
    }
  }
};

/// Divide the scene's bounds until the limits are reached. Levels are built in parallel; the result does not depend on the
/// number of threads.
template <class Real>
Octree<Real> build_octree(const Geometry<Real>& geometry, const OctreeLimits& limits);

extern template Octree<float> build_octree(const Geometry<float>&, const OctreeLimits&);
extern template Octree<double> build_octree(const Geometry<double>&, const OctreeLimits&);

}  // namespace rayshoot
